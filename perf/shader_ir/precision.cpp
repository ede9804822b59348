// Rounding to fp32, binary16 and the GLSL ES minimum.
#include "perf/shader_ir/precision.h"

#include <bit>
#include <cmath>
#include <limits>

namespace halfframe::shader_ir {
namespace {

constexpr double kSmallestNormalFloat = 0x1p-126;
constexpr double kSmallestNormalHalf = 0x1p-14;
constexpr double kLargestHalf = 65504.0;
constexpr double kLargestMinimum = 0x1p14 - 0x1p3;  // 16376: all ones below 2^14

/// Keeps 10 of double's 52 fraction bits, to nearest even. For finite x.
double ten_fraction_bits(double x) {
    constexpr std::uint64_t kDropped = 42;
    auto bits = std::bit_cast<std::uint64_t>(x);
    const std::uint64_t odd = (bits >> kDropped) & 1u;
    bits += ((std::uint64_t{1} << (kDropped - 1)) - 1) + odd;
    bits &= ~((std::uint64_t{1} << kDropped) - 1);
    return std::bit_cast<double>(bits);
}

double rounded_to_float(double x) {
    const auto narrow = static_cast<double>(static_cast<float>(x));
    return std::fabs(narrow) < kSmallestNormalFloat ? std::copysign(0.0, x) : narrow;
}

double rounded_to_half(double x) {
    if (!std::isfinite(x)) return x;
    if (std::fabs(x) < kSmallestNormalHalf) {
        // Adding a number whose last bit is worth 2^-24 rounds to multiples of that, the spacing of half's subnormals.
        constexpr double kSpacing24 = 0x1.8p28;
        return std::copysign((x + kSpacing24) - kSpacing24, x);
    }
    const double near = ten_fraction_bits(x);
    return std::fabs(near) > kLargestHalf ? std::copysign(std::numeric_limits<double>::infinity(), x) : near;
}

double flushed(double x) { return std::fabs(x) < kSmallestNormalHalf ? std::copysign(0.0, x) : x; }

double rounded_to_minimum(double x) {
    if (std::isnan(x)) return x;
    if (std::fabs(x) >= kLargestMinimum) return std::copysign(kLargestMinimum, x);
    const double near = flushed(ten_fraction_bits(x));
    return std::fabs(near) > kLargestMinimum ? std::copysign(kLargestMinimum, x) : near;
}

}  // namespace

const char* name(Model model) {
    switch (model) {
        case Model::in_double: return "double";
        case Model::in_float: return "float";
        case Model::half: return "half";
        case Model::half_flushed: return "half_flushed";
        case Model::es_minimum: return "es_minimum";
    }
    return "";
}

double rounded(Model model, double x) {
    switch (model) {
        case Model::in_double: return x;
        case Model::in_float: return rounded_to_float(x);
        case Model::half: return rounded_to_half(x);
        case Model::half_flushed: return flushed(rounded_to_half(x));
        case Model::es_minimum: return rounded_to_minimum(x);
    }
    return x;
}

std::uint16_t half_bits(double x) {
    const double near = rounded_to_half(x);
    const std::uint16_t sign = std::signbit(x) ? 0x8000u : 0u;
    if (std::isnan(x)) return 0x7e00;
    if (std::isinf(near)) return sign | 0x7c00u;
    const double size = std::fabs(near);
    if (size < kSmallestNormalHalf) return sign | static_cast<std::uint16_t>(size * 0x1p24);
    int exponent = 0;
    const double fraction = std::frexp(size, &exponent);  // [0.5, 1)
    const auto significand = static_cast<std::uint16_t>((fraction * 2.0 - 1.0) * 1024.0);
    return static_cast<std::uint16_t>(sign | ((exponent + 14) << 10) | significand);
}

double value_of_half(std::uint16_t bits) {
    const double sign = (bits & 0x8000u) != 0 ? -1.0 : 1.0;
    const int exponent = (bits >> 10) & 0x1f;
    const int significand = bits & 0x3ff;
    if (exponent == 0x1f) {
        return significand != 0 ? std::numeric_limits<double>::quiet_NaN()
                                : sign * std::numeric_limits<double>::infinity();
    }
    if (exponent == 0) return sign * significand * 0x1p-24;
    return sign * std::ldexp(1024 + significand, exponent - 25);
}

}  // namespace halfframe::shader_ir
