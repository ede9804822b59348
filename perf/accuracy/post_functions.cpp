// The measured functions of bloom and of anti_alias.
#include "engine/effects/anti_alias/anti_alias_reference.h"
#include "engine/effects/bloom/bloom_reference.h"
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

FunctionEntry bloom_entry(const char* function, const char* domain) {
    return entry_of(
        "bloom", function,
        {"common/maths.glsl", "common/packing_limits.h", "common/packing.glsl", "tone_map/tone_map_limits.h",
         "tone_map/tone_map.glsl", "bloom/bloom_limits.h", "bloom/bloom.glsl"},
        domain);
}

// The console's kernel, as bloom_limits.h has it from the variance of the whole.
constexpr int kRadius = 8;
constexpr double kSigma = 3.022601;

}  // namespace

std::vector<FunctionEntry> bloom_functions() {
    FunctionEntry excess = bloom_entry("light_above_threshold", "light 0..65504");
    excess.arguments = [] {
        std::vector<std::vector<double>> u = unit_cube(3);
        // Round the threshold, over the talk's range, and all that a half target stores.
        for (std::size_t i = 0; i < u[0].size(); ++i) {
            u[0][i] *= 2.0;
            u[1][i] *= 8.0;
            u[2][i] *= 65504.0 * u[2][i] * u[2][i] * u[2][i] * u[2][i] * u[2][i];
        }
        return std::vector<Argument>{{"light", u}};
    };
    excess.reference = [](const Lane& in, std::size_t s) {
        return reference::blooming_light({in(0, 0), in(0, 1), in(0, 2)})[s];
    };
    excess.method = {1e-12, "the same formula"};
    excess.in_float = {2e-6, "light up to 8, a few roundings of 6e-8"};
    excess.half = {8e-3, "light up to 8 has steps of 2^-8; the input, the quotient and the product are rounded"};
    excess.flushed = {8e-3, "as half"};

    FunctionEntry weight = bloom_entry("blur_weight", "0..8 taps");
    weight.arguments = [] {
        std::vector<std::vector<double>> u = unit_cube(1);
        for (double& tap : u[0]) tap *= kRadius;
        return std::vector<Argument>{{"texels", u}};
    };
    weight.reference = [](const Lane& in, std::size_t) { return reference::tap_weight(in(0), kRadius, kSigma); };
    weight.half = {2e-4, "a peak of 0.13, and an exponent up to 5 with eight roundings of 2^-12"};
    weight.flushed = {2e-4, "as half"};

    FunctionEntry pair = bloom_entry("blur_pair_at", "1..7 taps");
    pair.arguments = [] {
        std::vector<std::vector<double>> u = unit_cube(1);
        for (double& tap : u[0]) tap = 1.0 + 6.0 * tap;
        return std::vector<Argument>{{"texels", u}};
    };
    // Where the centre of gravity of two taps lies.
    pair.reference = [](const Lane& in, std::size_t) {
        const double first = reference::tap_weight(in(0), kRadius, kSigma);
        const double second = reference::tap_weight(in(0) + 1.0, kRadius, kSigma);
        return (in(0) * first + (in(0) + 1.0) * second) / (first + second);
    };
    pair.in_float = {1e-5, "a place up to 8 has steps of 5e-7; a quotient of weights follows"};
    pair.half = {8e-3, "a place up to 8 has steps of 2^-7, and two weights are rounded"};
    pair.flushed = {8e-3, "as half"};
    return {excess, weight, pair};
}

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
