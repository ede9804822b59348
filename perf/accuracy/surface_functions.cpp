// The measured functions of the surface: direct light and its parts.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/effects/surface/surface_reference.h"
#include "perf/accuracy/function_list.h"
#include "perf/accuracy/samples.h"

namespace halfframe::accuracy {
namespace {

using reference::Vector;
using shader_ir::Columns;

constexpr double kPi = std::numbers::pi;
constexpr const char* kSameFormula = "the same formula: what differs is the rounding of double, and of fp32 constants";
constexpr const char* kFloatRounding = "a dozen roundings of 6e-8";

Vector vector_of(const Lane& in, std::size_t argument) { return {in(argument, 0), in(argument, 1), in(argument, 2)}; }

/// The unit vector at `angle_rad` from the unit vector `axis`, `turn` 0..1 around it.
Vector tilted(const Vector& axis, double angle_rad, double turn) {
    // Any vector that is not nearly parallel spans the plane across the axis.
    const Vector other = std::fabs(axis[2]) < 0.7 ? Vector{0.0, 0.0, 1.0} : Vector{1.0, 0.0, 0.0};
    Vector across{axis[1] * other[2] - axis[2] * other[1], axis[2] * other[0] - axis[0] * other[2],
                  axis[0] * other[1] - axis[1] * other[0]};
    const double length = std::hypot(across[0], across[1], across[2]);
    for (double& part : across) part /= length;
    const Vector third{axis[1] * across[2] - axis[2] * across[1], axis[2] * across[0] - axis[0] * across[2],
                       axis[0] * across[1] - axis[1] * across[0]};
    Vector result{};
    for (std::size_t s = 0; s < 3; ++s) {
        result[s] = std::cos(angle_rad) * axis[s] + std::sin(angle_rad) * (std::cos(2.0 * kPi * turn) * across[s] +
                                                                           std::sin(2.0 * kPi * turn) * third[s]);
    }
    return result;
}

/// A unit vector for two numbers 0..1.
Vector direction(double height, double turn) {
    const double z = 2.0 * height - 1.0;
    const double radius = std::sqrt(std::max(1.0 - z * z, 0.0));
    return {radius * std::cos(2.0 * kPi * turn), radius * std::sin(2.0 * kPi * turn), z};
}

void add(Columns& columns, const Vector& value) {
    columns.resize(3);
    for (std::size_t s = 0; s < 3; ++s) columns[s].push_back(value[s]);
}

std::vector<double> mapped(std::vector<double> values, double (*map)(double)) {
    for (double& value : values) value = map(value);
    return values;
}

/// 2..2048, evenly in its logarithm.
double power_of(double u) { return std::exp2(1.0 + 10.0 * u); }
/// 0 to 90 degrees, most of them inside the narrowest highlight.
double tilt_of(double u) { return 0.5 * kPi * u * u * u; }

FunctionEntry entry(const char* function, const char* domain) {
    FunctionEntry made;
    made.effect = "surface";
    made.function = function;
    made.files = {"surface/surface_limits.h", "common/maths.glsl", "surface/surface.glsl"};
    made.domain = domain;
    made.method = {1e-6, kSameFormula};
    made.in_float = {2e-6, kFloatRounding};
    return made;
}

std::vector<FunctionEntry> fresnel() {
    FunctionEntry direct = entry("fresnel_schlick", "specular 0..1, cosine 0..1");
    direct.arguments = [] {
        const Columns u = unit_cube(3);
        return std::vector<Argument>{{"specular", {u[0], mapped(u[0], [](double x) { return 0.1 * x; }), u[2]}},
                                     {"l_dot_h", {u[1]}}};
    };
    direct.reference = [](const Lane& in, std::size_t s) { return reference::fresnel_schlick(in(0, s), in(1)); };
    direct.half = {3e-3, "the fifth power multiplies the rounding of 1 - cosine, 2^-12, by five; five more follow"};
    direct.flushed = {3e-3, "as half"};

    FunctionEntry glossy = entry("fresnel_glossy", "specular 0..1, smoothness 0..1, cosine 0..1");
    glossy.arguments = [] {
        const Columns u = unit_cube(4);
        return std::vector<Argument>{{"specular", {u[0], mapped(u[0], [](double x) { return 0.1 * x; }), u[3]}},
                                     {"smoothness", {u[2]}},
                                     {"n_dot_v", {u[1]}}};
    };
    glossy.reference = [](const Lane& in, std::size_t s) { return reference::fresnel_glossy(in(0, s), in(1), in(2)); };
    glossy.half = direct.half;
    glossy.flushed = direct.flushed;
    return {direct, glossy};
}

std::vector<FunctionEntry> power() {
    FunctionEntry from_roughness = entry("power_from_roughness", "roughness 0..1");
    from_roughness.arguments = [] { return std::vector<Argument>{{"roughness", unit_cube(1)}}; };
    from_roughness.reference = [](const Lane& in, std::size_t) { return reference::power_from_roughness(in(0)); };
    from_roughness.unit = Unit::of_peak;
    from_roughness.peak = from_roughness.reference;
    from_roughness.half = {8e-3, "the fourth power multiplies the rounding of the input by four, and 2 is taken off"};
    from_roughness.flushed = {8e-3, "as half: 2 / 2050 is above the smallest normal half"};

    FunctionEntry smoothness = entry("smoothness_from_power", "power 2..2048");
    smoothness.arguments = [] { return std::vector<Argument>{{"power", {mapped(unit_cube(1)[0], power_of)}}}; };
    smoothness.reference = [](const Lane& in, std::size_t) { return reference::smoothness_from_power(in(0)); };
    smoothness.half = {1e-3,
                       "log2 up to 11 has steps of 2^-7, 4e-4 after the tenth; 0.1 itself is off by 2e-4 in half"};
    smoothness.flushed = {1e-3, "as half"};
    return {from_roughness, smoothness};
}

std::vector<FunctionEntry> lobes() {
    FunctionEntry chord = entry("blinn_lobe", "n.h 0..1, power 2..2048");
    chord.arguments = [] {
        const Columns u = unit_cube(5);
        std::vector<Argument> arguments{{"n", {}}, {"h", {}}, {"power", {mapped(u[4], power_of)}}};
        for (std::size_t i = 0; i < u[0].size(); ++i) {
            const Vector n = direction(u[0][i], u[1][i]);
            add(arguments[0].values, n);
            add(arguments[1].values, tilted(n, tilt_of(u[2][i]), u[3][i]));
        }
        return arguments;
    };
    chord.reference = [](const Lane& in, std::size_t) {
        return reference::blinn_lobe(vector_of(in, 0), vector_of(in, 1), in(2));
    };
    chord.method = {0.03, "the logarithm's series ends at its fourth term: 2.4 % at a power of 2 and n.h = 0.13"};
    chord.in_float = {1e-5, "a rounding of the exponent, up to 100 where the lobe is not 0 yet"};
    chord.half = {1.5e-3, "x e^-x, at most 0.37, times some eight roundings of 2^-12 in the exponent x"};
    chord.flushed = {6e-3, "as half"};

    FunctionEntry written = chord;
    written.tier = Tier::reference;
    written.arithmetic = Arithmetic::full;
    written.method = {1e-6, kSameFormula};
    written.in_float = {5e-4, "fp32 rounds n.h near 1 to 6e-8, which the power of 2048 multiplies; pow() adds its own"};
    written.half = {5e-4, "full arithmetic: nothing is mediump, as float"};
    written.flushed = written.half;

    FunctionEntry mirrored = entry("mirrored_root", "r.l -1..1 in the plane of the normal, power 2..2048");
    mirrored.arguments = [] {
        const Columns u = unit_cube(5);
        std::vector<Argument> arguments{{"mirrored", {}}, {"l", {}}, {"power", {mapped(u[4], power_of)}}};
        for (std::size_t i = 0; i < u[0].size(); ++i) {
            const Vector ray = direction(u[0][i], u[1][i]);
            add(arguments[0].values, ray);
            add(arguments[1].values, tilted(ray, 2.0 * tilt_of(u[2][i]), u[3][i]));
        }
        return arguments;
    };
    mirrored.reference = [](const Lane& in, std::size_t) {
        const Vector r = vector_of(in, 0), l = vector_of(in, 1);
        const Vector sum{r[0] + l[0], r[1] + l[1], r[2] + l[2]};
        const double length = std::hypot(sum[0], sum[1], sum[2]);
        if (length < 1e-12) return 0.0;
        return reference::blinn_lobe(r, {sum[0] / length, sum[1] / length, sum[2] / length}, 0.5 * in(2));
    };
    mirrored.method = {0.4, "the logarithm's series ends at its third term: where the sun is behind what is mirrored"};
    mirrored.in_float = {1e-5, "as blinn_lobe"};
    mirrored.half = {1.5e-3, "as blinn_lobe"};
    mirrored.flushed = {6e-3, "as half"};
    return {chord, written, mirrored};
}

std::vector<FunctionEntry> falloffs() {
    FunctionEntry distance = entry("distance_falloff", "range 1..256 m, distance 0.01 m to 1.2 ranges");
    distance.arguments = [] {
        const Columns u = unit_cube(2);
        std::vector<Argument> arguments{{"distance_squared", {{}}}, {"inverse_range_squared", {{}}}};
        for (std::size_t i = 0; i < u[0].size(); ++i) {
            const double range_m = std::exp2(8.0 * u[0][i]);
            const double distance_m = 0.01 * std::pow(1.2 * range_m / 0.01, u[1][i]);
            arguments[0].values[0].push_back(distance_m * distance_m);
            arguments[1].values[0].push_back(1.0 / (range_m * range_m));
        }
        return arguments;
    };
    distance.reference = [](const Lane& in, std::size_t) {
        return reference::distance_falloff(std::sqrt(in(0)), 1.0 / std::sqrt(in(1)));
    };
    distance.unit = Unit::of_peak;
    distance.peak = [](const Lane& in, std::size_t) { return 1.0 / std::max(in(0), 1e-5 / in(1)); };
    distance.half = {2.5e-3, "one rounding of the result; past 128 m 1/d^2 is subnormal and keeps 8 bits"};
    distance.flushed = {1.0, "past 128 m 1/d^2 is below the smallest normal half, and all of it is lost"};

    FunctionEntry cone = entry("cone_falloff", "outer angle 10..90 degrees, inner 0..0.8 of it, cosine -1..1");
    cone.arguments = [] {
        const Columns u = unit_cube(3);
        std::vector<Argument> arguments{{"cosine", {{}}}, {"cos_outer", {{}}}, {"cos_scale", {{}}}};
        for (std::size_t i = 0; i < u[0].size(); ++i) {
            const double outer_rad = (10.0 + 80.0 * u[1][i]) * kPi / 180.0;
            const double cos_outer = std::cos(outer_rad);
            const double cos_inner = std::cos(0.8 * u[2][i] * outer_rad);
            // Half of the cosines fall on the cone's soft edge, where all of the change is.
            const double edge = 2.0 * u[0][i];
            const double cosine = edge < 1.0 ? cos_outer + edge * (cos_inner - cos_outer) : 2.0 * edge - 3.0;
            arguments[0].values[0].push_back(cosine);
            arguments[1].values[0].push_back(cos_outer);
            arguments[2].values[0].push_back(1.0 / (cos_inner - cos_outer));
        }
        return arguments;
    };
    cone.reference = [](const Lane& in, std::size_t) {
        return reference::cone_falloff(in(0), in(1), in(1) + 1.0 / in(2));
    };
    cone.in_float = {1e-4, "two cosines rounded to 3e-8, over the narrowest edge of 0.0055, times a slope of 1.5"};
    cone.half = {0.15, "two cosines rounded to 2^-12, over the narrowest edge of 0.0055, times a slope of 1.5"};
    cone.flushed = {0.15, "as half"};
    return {distance, cone};
}

FunctionEntry light() {
    FunctionEntry direct = entry(
        "direct_light", "albedo, specular 0..1, power 2..2048, radiance 0..8, n.h 0..1, v to 89.7 degrees from n");
    direct.arguments = [] {
        const Columns u = unit_cube(10);
        const std::size_t lanes = u[0].size();
        const std::vector<double> zero(lanes, 0.0);
        const std::vector<double> dielectric(lanes, 0.0437);
        std::vector<Argument> arguments{{"albedo", {u[0], u[1], zero}},
                                        {"specular", {u[1], dielectric, u[0]}},
                                        {"power", {mapped(u[2], power_of)}},
                                        {"n", {}},
                                        {"v", {}},
                                        {"l", {}},
                                        {"radiance", {u[3], u[3], u[3]}}};
        for (std::vector<double>& channel : arguments[6].values) {
            for (double& value : channel) value *= 8.0;
        }
        for (std::size_t i = 0; i < lanes; ++i) {
            const Vector n = direction(u[4][i], u[5][i]);
            const Vector h = tilted(n, tilt_of(u[6][i]), u[7][i]);
            const Vector v = tilted(n, u[8][i] * 89.7 * kPi / 180.0, u[9][i]);
            const double v_dot_h = v[0] * h[0] + v[1] * h[1] + v[2] * h[2];
            add(arguments[3].values, n);
            add(arguments[4].values, v);
            // The light that h mirrors towards v; many are behind the surface and give nothing.
            add(arguments[5].values,
                {2.0 * v_dot_h * h[0] - v[0], 2.0 * v_dot_h * h[1] - v[1], 2.0 * v_dot_h * h[2] - v[2]});
        }
        return arguments;
    };
    direct.reference = [](const Lane& in, std::size_t s) {
        return reference::direct_light(in(0, s), in(1, s), in(2), vector_of(in, 3), vector_of(in, 4), vector_of(in, 5),
                                       in(6, s));
    };
    direct.unit = Unit::light_codes;
    direct.method = {12.0, "the lobe's series at powers under 10: its flank is too bright, where little else lights"};
    direct.in_float = {5e-3, "roundings of 6e-8, times 1191 codes per unit of light near black"};
    direct.half = {1.0, "the half lobe's error, times (power + 2) / 8 and the curve's slope where the highlight fades"};
    direct.flushed = {10.0, "the lobe is 0 below 6e-5, and the factor before it is up to 256: a faint rim goes dark"};
    return direct;
}

FunctionEntry widened_power() {
    FunctionEntry widened = entry("area_power", "power 2..2048, radius over distance 0..1");
    widened.arguments = [] {
        const Columns u = unit_cube(2);
        return std::vector<Argument>{{"power", {mapped(u[0], power_of)}},
                                     {"ratio", {mapped(u[1], [](double x) { return x * x; })}}};
    };
    widened.reference = [](const Lane& in, std::size_t) { return reference::area_power(in(0), in(1)); };
    widened.unit = Unit::of_peak;
    widened.peak = widened.reference;
    widened.method = {0.09, "u + 1 / (1 + u/2) stands for u / (1 - e^-u), 7.6 % apart where u is 1.3"};
    widened.half = {4e-3, "some seven roundings of 2^-12"};
    widened.flushed = {4e-3, "as half"};
    return widened;
}

/// Lights of 0 to 30 degrees, wholly above the horizon, near the mirror direction and away from it; highlight alone.
std::vector<Argument> sphere_lights() {
    const Columns u = unit_cube(7);
    const auto all = [&](double (*value)(double)) { return mapped(u[6], value); };
    const std::vector<double> zero = all([](double) { return 0.0; });
    const std::vector<double> one = all([](double) { return 1.0; });
    std::vector<Argument> arguments{
        {"albedo", {zero, zero, zero}},
        {"specular", {one, all([](double x) { return 0.04 + 0.96 * x; }), all([](double) { return 0.0437; })}},
        {"power", {mapped(u[0], power_of)}},
        {"n", {}},
        {"v", {}},
        {"l", {}},
        {"radiance", {one, one, one}},
        {"ratio", {mapped(u[5], [](double x) { return 0.5 * x * x; })}}};
    for (std::size_t i = 0; i < u[0].size(); ++i) {
        // View and light 0 to 45 degrees from the half vector, n up to three widths of the smeared lobe from it.
        const Vector h = direction(u[1][i], u[2][i]);
        const double half_angle_rad = 0.25 * kPi * u[3][i];
        const double ratio = arguments[7].values[0][i];
        const double width_rad = std::sqrt(1.0 / arguments[2].values[0][i] + ratio * ratio / 8.0);
        add(arguments[3].values, tilted(h, std::min(3.0 * width_rad, 0.14 * kPi) * u[4][i], u[6][i]));
        const Vector v = tilted(h, half_angle_rad, 0.25);
        add(arguments[4].values, v);
        const double v_dot_h = std::cos(half_angle_rad);
        add(arguments[5].values,
            {2.0 * v_dot_h * h[0] - v[0], 2.0 * v_dot_h * h[1] - v[1], 2.0 * v_dot_h * h[2] - v[2]});
    }
    return arguments;
}

FunctionEntry spheres() {
    FunctionEntry sphere = entry("sphere_light",
                                 "highlight alone, power 2..2048, radius over distance 0..0.5, light and view to 45 "
                                 "degrees from h, n to 3 widths of the lobe from h");
    sphere.arguments = sphere_lights;
    sphere.reference = [](const Lane& in, std::size_t s) {
        return reference::sphere_light(in(0, s), in(1, s), in(2), vector_of(in, 3), vector_of(in, 4), vector_of(in, 5),
                                       in(6, s), in(7));
    };
    sphere.unit = Unit::of_peak;
    sphere.peak = [](const Lane& in, std::size_t s) {  // the highlight where it is highest: n = h
        const Vector v = vector_of(in, 4);
        const Vector l = vector_of(in, 5);
        Vector h{l[0] + v[0], l[1] + v[1], l[2] + v[2]};
        const double length = std::hypot(h[0], h[1], h[2]);
        for (double& part : h) part /= length;
        return reference::sphere_light(in(0, s), in(1, s), in(2), h, v, l, in(6, s), in(7));
    };
    sphere.method = {0.65, "a mirror shows a disc with a rim; a lobe of its height is 1/e there: 1 - 1/e of the peak"};
    sphere.in_float = {1e-5, "roundings of 6e-8, times exponents up to 20"};
    sphere.half = {6e-3, "the half lobe's error twice over: of the lobe, and of the power that widens it"};
    sphere.flushed = {6e-3, "as half"};
    return sphere;
}

}  // namespace

std::vector<FunctionEntry> surface_functions() {
    std::vector<FunctionEntry> list;
    for (const std::vector<FunctionEntry>& part :
         {fresnel(), power(), lobes(), falloffs(), surface_material_functions()}) {
        list.insert(list.end(), part.begin(), part.end());
    }
    list.push_back(light());
    list.push_back(widened_power());
    list.push_back(spheres());
    return list;
}

}  // namespace halfframe::accuracy
