// The measured functions of glTF's material extensions.
#include <cmath>

#include "engine/effects/surface/surface_material_reference.h"
#include "perf/accuracy/function_list.h"
#include "perf/accuracy/samples.h"

namespace halfframe::accuracy {
namespace {

using shader_ir::Columns;

FunctionEntry entry(const char* function, const char* domain) {
    FunctionEntry made;
    made.effect = "surface";
    made.function = function;
    made.files = {"common/maths.glsl", "surface/surface_material.glsl"};
    made.domain = domain;
    made.method = {1e-6, "the same formula: what differs is the rounding of double"};
    made.in_float = {1e-6, "three roundings of 6e-8"};
    made.half = {1e-3, "three roundings of 2^-12"};
    made.flushed = {1e-3, "as half"};
    return made;
}

}  // namespace

std::vector<FunctionEntry> surface_material_functions() {
    FunctionEntry dielectric = entry("dielectric_specular", "reflectance 0..1 (ior to infinity), tint and share 0..1");
    dielectric.arguments = [] {
        const Columns u = unit_cube(5);
        return std::vector<Argument>{{"specular", {u[0], u[0], u[0]}}, {"tint", {u[1], u[2], u[3]}}, {"share", {u[4]}}};
    };
    dielectric.reference = [](const Lane& in, std::size_t s) {
        const double root = std::sqrt(in(0, s));  // the ior of this reflectance
        const double ior = root < 1.0 ? (1.0 + root) / (1.0 - root) : 0.0;
        return reference::dielectric_specular(ior, in(1, s), in(2));
    };

    FunctionEntry albedo = entry("albedo_beside", "diffuse and specular 0..1");
    albedo.arguments = [] {
        const Columns u = unit_cube(6);
        return std::vector<Argument>{{"diffuse", {u[0], u[1], u[2]}}, {"specular", {u[3], u[4], u[5]}}};
    };
    albedo.reference = [](const Lane& in, std::size_t s) {
        return reference::albedo_beside(in(0, s), {in(1, 0), in(1, 1), in(1, 2)});
    };

    FunctionEntry occlusion = entry("occlusion_share", "texel and strength 0..1");
    occlusion.arguments = [] {
        const Columns u = unit_cube(2);
        return std::vector<Argument>{{"texel", {u[0]}}, {"strength", {u[1]}}};
    };
    occlusion.reference = [](const Lane& in, std::size_t) { return reference::occlusion_share(in(0), in(1)); };
    return {dielectric, albedo, occlusion};
}

}  // namespace halfframe::accuracy
