// The rounding models against every half, hard values, and roundings written another way.
#include "perf/shader_ir/precision.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

namespace halfframe::shader_ir {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

bool same(double a, double b) {
    return (std::isnan(a) && std::isnan(b)) || std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

/// The nearest finite half by trying: its two neighbours on the grid that x's exponent has, even last bit at a tie.
double nearest_half_by_search(double x) {
    const double size = std::fabs(x);
    const double step = std::ldexp(1.0, std::max(size > 0.0 ? std::ilogb(size) : -24, -14) - 10);
    const double below = std::floor(size / step);
    const double rest = size / step - below;
    const bool up = rest > 0.5 || (rest == 0.5 && std::fmod(below, 2.0) == 1.0);
    const double near = (below + (up ? 1.0 : 0.0)) * step;
    return std::copysign(near > 65504.0 ? kInfinity : near, x);
}

TEST(Precision, EveryHalfComesBack) {
    int checked = 0;
    for (std::uint32_t bits = 0; bits < 0x10000u; ++bits) {
        const double value = value_of_half(static_cast<std::uint16_t>(bits));
        ASSERT_TRUE(same(rounded(Model::half, value), value)) << bits;
        if (std::isnan(value)) {
            EXPECT_EQ(half_bits(value), 0x7e00);
            continue;
        }
        ASSERT_EQ(half_bits(value), bits);
        const bool subnormal = (bits & 0x7c00u) == 0;
        const double flushed = subnormal ? std::copysign(0.0, value) : value;
        ASSERT_TRUE(same(rounded(Model::half_flushed, value), flushed)) << value;
        const double minimum = std::fabs(flushed) >= 0x1p14 ? std::copysign(16376.0, value) : flushed;
        ASSERT_TRUE(same(rounded(Model::es_minimum, value), minimum)) << value;
        ++checked;
    }
    EXPECT_EQ(checked, 65536 - 2 * 1023);
}

TEST(Precision, BetweenTwoHalvesTheNearestAndAtTheMiddleTheEven) {
    for (std::uint16_t bits = 0; bits < 0x7bff; ++bits) {
        const double low = value_of_half(bits);
        const double high = value_of_half(static_cast<std::uint16_t>(bits + 1));
        const double middle = (low + high) / 2.0;
        const double even = bits % 2 == 0 ? low : high;
        ASSERT_EQ(rounded(Model::half, middle), even) << bits;
        ASSERT_EQ(rounded(Model::half, -middle), -even) << bits;
        ASSERT_EQ(rounded(Model::half, std::nextafter(middle, 0.0)), low) << bits;
        ASSERT_EQ(rounded(Model::half, std::nextafter(middle, kInfinity)), high) << bits;
    }
}

TEST(Precision, HalfAgreesWithASearch) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> exponent(-27.0, 17.0);
    std::uniform_real_distribution<double> significand(-1.0, 1.0);
    for (int i = 0; i < 200000; ++i) {
        const double x = significand(random) * std::exp2(exponent(random));
        ASSERT_TRUE(same(rounded(Model::half, x), nearest_half_by_search(x))) << x;
    }
}

TEST(Precision, HardValuesOfHalf) {
    EXPECT_EQ(rounded(Model::half, 65504.0), 65504.0);
    EXPECT_EQ(rounded(Model::half, 65519.99), 65504.0);
    EXPECT_EQ(rounded(Model::half, 65520.0), kInfinity);
    EXPECT_EQ(rounded(Model::half, -65520.0), -kInfinity);
    EXPECT_EQ(rounded(Model::half, 1e300), kInfinity);
    EXPECT_EQ(rounded(Model::half, 0x1p-24), 0x1p-24);
    EXPECT_TRUE(same(rounded(Model::half, 0x1p-25), 0.0));
    EXPECT_TRUE(same(rounded(Model::half, -0x1p-25), -0.0));
    EXPECT_EQ(rounded(Model::half, std::nextafter(0x1p-25, 1.0)), 0x1p-24);
    EXPECT_TRUE(same(rounded(Model::half, -0.0), -0.0));
    EXPECT_TRUE(std::isnan(rounded(Model::half, kNaN)));
    EXPECT_EQ(rounded(Model::half, -kInfinity), -kInfinity);
    EXPECT_EQ(half_bits(0x1p-14 - 0x1p-26), 0x0400);  // rounds up out of the subnormals
}

TEST(Precision, HardValuesOfFlushedHalf) {
    EXPECT_EQ(rounded(Model::half_flushed, 0x1p-14), 0x1p-14);
    EXPECT_EQ(rounded(Model::half_flushed, 0x1p-14 - 0x1p-26), 0x1p-14);
    EXPECT_TRUE(same(rounded(Model::half_flushed, 0x1p-14 - 0x1p-24), 0.0));
    EXPECT_TRUE(same(rounded(Model::half_flushed, -0x1p-20), -0.0));
    EXPECT_EQ(rounded(Model::half_flushed, 65520.0), kInfinity);
}

TEST(Precision, HardValuesOfTheMinimum) {
    EXPECT_EQ(rounded(Model::es_minimum, 16376.0), 16376.0);
    EXPECT_EQ(rounded(Model::es_minimum, 16375.9), 16376.0);
    EXPECT_EQ(rounded(Model::es_minimum, 16384.0), 16376.0);
    EXPECT_EQ(rounded(Model::es_minimum, -1e9), -16376.0);
    EXPECT_EQ(rounded(Model::es_minimum, kInfinity), 16376.0);
    EXPECT_TRUE(std::isnan(rounded(Model::es_minimum, kNaN)));
    EXPECT_EQ(rounded(Model::es_minimum, 0x1p-14), 0x1p-14);
    EXPECT_TRUE(same(rounded(Model::es_minimum, 0x1p-15), 0.0));
    EXPECT_EQ(rounded(Model::es_minimum, 1.0 + 0x1p-11), 1.0);
    EXPECT_EQ(rounded(Model::es_minimum, 1.0 + 0x1.8p-11), 1.0 + 0x1p-10);
}

TEST(Precision, FloatIsTheMachinesWithSubnormalsFlushed) {
    std::mt19937_64 random(2);
    for (int i = 0; i < 200000; ++i) {
        const double x = std::bit_cast<double>((random() & 0x8fffffffffffffffu) | 0x3800000000000000u);
        const auto machine = static_cast<float>(x);
        const double wanted = std::fpclassify(machine) == FP_SUBNORMAL ? std::copysign(0.0, x) : machine;
        ASSERT_TRUE(same(rounded(Model::in_float, x), wanted)) << x;
    }
    EXPECT_TRUE(same(rounded(Model::in_float, -0x1p-127), -0.0));
    EXPECT_EQ(rounded(Model::in_float, 0x1p-126), 0x1p-126);
    EXPECT_EQ(rounded(Model::in_float, 1e39), kInfinity);
    EXPECT_EQ(rounded(Model::in_double, 0.1), 0.1);
}

}  // namespace
}  // namespace halfframe::shader_ir
