// The measured functions of anti_alias.
#include "engine/effects/anti_alias/anti_alias_reference.h"
#include "perf/accuracy/function_list.h"
#include "perf/accuracy/samples.h"

namespace halfframe::accuracy {
namespace {

constexpr const char* kSameFormula = "the same formula: what differs is the rounding of double, and of fp32 constants";
constexpr const char* kFloatRounding = "a dozen roundings of 6e-8";

FunctionEntry entry_of(const char* effect, const char* function, std::vector<std::string> files, const char* domain) {
    FunctionEntry made;
    made.effect = effect;
    made.function = function;
    made.files = std::move(files);
    made.domain = domain;
    made.method = {1e-6, kSameFormula};
    made.in_float = {2e-6, kFloatRounding};
    return made;
}

}  // namespace

std::vector<FunctionEntry> anti_alias_functions() {
    const std::vector<std::string> files = {"anti_alias/anti_alias_limits.h", "anti_alias/anti_alias.glsl"};
    FunctionEntry luma = entry_of("anti_alias", "edge_luma", files, "display 0..1");
    luma.arguments = [] { return std::vector<Argument>{{"display", unit_cube(3)}}; };
    luma.reference = [](const Lane& in, std::size_t) { return reference::luma(in(0, 0), in(0, 1), in(0, 2)); };
    luma.half = {2e-3, "three products and two sums of at most 1, and their inputs, rounded to 2^-12"};
    luma.flushed = {2e-3, "as half"};

    FunctionEntry share = entry_of("anti_alias", "edge_share", files, "ends 0.5 to 8.5 pixels away");
    share.arguments = [] {
        std::vector<std::vector<double>> u = unit_cube(2);
        for (std::vector<double>& end : u) {
            for (double& pixels : end) pixels = 0.5 + 8.0 * pixels;
        }
        return std::vector<Argument>{{"near_end", {u[0]}}, {"far_end", {u[1]}}};
    };
    share.reference = [](const Lane& in, std::size_t) { return reference::run_coverage(in(0), in(1)); };
    share.method = {0.13, "the pixel in the middle of its run is cut diagonally: an eighth in a run of one pixel"};
    share.half = {1e-3, "a quotient of at most 1 and three roundings before it, 2^-12 each"};
    share.flushed = {1e-3, "as half"};
    return {luma, share};
}

}  // namespace halfframe::accuracy
