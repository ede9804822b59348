// Every GLSL ES 3.00 built-in function in double against the C++ library, and what GLSL says at the edges.
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/shader_ir/run.h"

namespace halfframe::shader_ir {
namespace {

using std::numbers::pi;

// 1e-14: a few roundings of double on each side.
constexpr double kTolerance = 1e-14;

void expect_near(double found, double wanted, const std::string& what) {
    if (std::isnan(wanted)) {
        EXPECT_TRUE(std::isnan(found)) << what << ": " << found;
    } else if (std::isinf(wanted)) {
        EXPECT_EQ(found, wanted) << what;
    } else {
        EXPECT_NEAR(found, wanted, kTolerance * std::max(1.0, std::fabs(wanted))) << what;
    }
}

struct Unary {
    const char* name;
    std::function<double(double)> wanted;
    std::vector<double> inputs;
};

const std::vector<double> kAll{-7.5, -2.5, -1.0, -0.5, -0.1, 0.0, 0.3, 0.5, 1.0, 1.5, 2.5, 3.7, 100.25};
const std::vector<double> kPositive{0.001, 0.5, 1.0, 2.0, 7.7, 1e5};
const std::vector<double> kUnit{-1.0, -0.7, 0.0, 0.2, 1.0};

double even(double x) {
    const double down = std::floor(x);
    return x - down == 0.5 ? 2.0 * std::round(x / 2.0) : std::round(x);
}

const std::vector<Unary>& unaries() {
    static const std::vector<Unary> kUnaries{
        {"radians", [](double x) { return x * pi / 180.0; }, kAll},
        {"degrees", [](double x) { return x * 180.0 / pi; }, kAll},
        {"sin", [](double x) { return std::sin(x); }, kAll},
        {"cos", [](double x) { return std::cos(x); }, kAll},
        {"tan", [](double x) { return std::tan(x); }, kAll},
        {"asin", [](double x) { return std::asin(x); }, kUnit},
        {"acos", [](double x) { return std::acos(x); }, kUnit},
        {"atan", [](double x) { return std::atan(x); }, kAll},
        {"sinh", [](double x) { return std::sinh(x); }, kUnit},
        {"cosh", [](double x) { return std::cosh(x); }, kUnit},
        {"tanh", [](double x) { return std::tanh(x); }, kAll},
        {"asinh", [](double x) { return std::asinh(x); }, kAll},
        {"acosh", [](double x) { return std::acosh(x); }, {1.0, 1.5, 20.0}},
        {"atanh", [](double x) { return std::atanh(x); }, {-0.9, 0.0, 0.5}},
        {"exp", [](double x) { return std::exp(x); }, kUnit},
        {"log", [](double x) { return std::log(x); }, kPositive},
        {"exp2", [](double x) { return std::exp2(x); }, kAll},
        {"log2", [](double x) { return std::log2(x); }, kPositive},
        {"sqrt", [](double x) { return std::sqrt(x); }, kPositive},
        {"inversesqrt", [](double x) { return 1.0 / std::sqrt(x); }, kPositive},
        {"abs", [](double x) { return x < 0.0 ? -x : x; }, kAll},
        {"sign", [](double x) { return (x > 0.0) - (x < 0.0); }, kAll},
        {"floor", [](double x) { return std::floor(x); }, kAll},
        {"trunc", [](double x) { return x < 0.0 ? std::ceil(x) : std::floor(x); }, kAll},
        {"round", even, kAll},
        {"roundEven", even, kAll},
        {"ceil", [](double x) { return -std::floor(-x); }, kAll},
        {"fract", [](double x) { return x - std::floor(x); }, kAll},
    };
    return kUnaries;
}

TEST(StandardFunctions, OneArgument) {
    std::string text;
    for (const Unary& one : unaries()) {
        text += std::string("vec3 try_") + one.name + "(vec3 x) { return " + one.name + "(x); }\n";
    }
    const Module module = module_of(text);
    for (const Unary& one : unaries()) {
        const std::vector<Columns> inputs{{one.inputs, {0.5}, one.inputs}};
        const Columns found = evaluate(module, std::string("try_") + one.name, inputs, Model::in_double).returned;
        for (std::size_t i = 0; i < one.inputs.size(); ++i) {
            expect_near(found[0].at(i), one.wanted(one.inputs[i]), one.name + std::to_string(one.inputs[i]));
            expect_near(found[2].at(i), one.wanted(one.inputs[i]), one.name);
        }
    }
}

TEST(StandardFunctions, TwoAndThreeArguments) {
    const Module module = module_of(
        "vec2 powers(vec2 x, vec2 y) { return pow(x, y); }\n"
        "float modulus(float x, float y) { return mod(x, y); }\n"
        "float angle(float y, float x) { return atan(y, x); }\n"
        "vec2 least(vec2 x, float y) { return min(x, y); }\n"
        "vec2 most(vec2 x, float y) { return max(x, y); }\n"
        "vec2 between(vec2 x, float a, float b) { return clamp(x, a, b); }\n"
        "vec2 blend(vec2 x, vec2 y, float a) { return mix(x, y, a); }\n"
        "vec2 choice(vec2 x, vec2 y, bvec2 a) { return mix(x, y, a); }\n"
        "vec2 steps(float e, vec2 x) { return step(e, x); }\n"
        "vec2 smooth_steps(float a, float b, vec2 x) { return smoothstep(a, b, x); }\n");
    EXPECT_NEAR(result_of(module, "powers", {{2.0, 0.3}, {3.5, -2.0}})[0], std::pow(2.0, 3.5), 1e-13);
    EXPECT_NEAR(result_of(module, "powers", {{2.0, 0.3}, {3.5, -2.0}})[1], 1.0 / 0.09, 1e-13);
    EXPECT_TRUE(std::isnan(result_of(module, "powers", {{-2.0, 1.0}, {2.0, 1.0}})[0]));
    EXPECT_NEAR(number_of(module, "modulus", {{-5.5}, {3.0}}), 0.5, kTolerance);
    EXPECT_NEAR(number_of(module, "modulus", {{5.5}, {-3.0}}), -0.5, kTolerance);
    EXPECT_NEAR(number_of(module, "angle", {{1.0}, {-2.0}}), std::atan2(1.0, -2.0), kTolerance);
    EXPECT_EQ(result_of(module, "least", {{1.0, 3.0}, {2.0}}), (std::vector{1.0, 2.0}));
    EXPECT_EQ(result_of(module, "most", {{1.0, NAN}, {2.0}}), (std::vector{2.0, 2.0}));
    EXPECT_EQ(result_of(module, "between", {{-4.0, NAN}, {-1.0}, {1.0}}), (std::vector{-1.0, -1.0}));
    EXPECT_EQ(result_of(module, "blend", {{0.0, 4.0}, {2.0, 8.0}, {0.25}}), (std::vector{0.5, 5.0}));
    EXPECT_EQ(result_of(module, "choice", {{1.0, 2.0}, {3.0, 4.0}, {0.0, 1.0}}), (std::vector{1.0, 4.0}));
    EXPECT_EQ(result_of(module, "steps", {{0.5}, {0.5, 0.49}}), (std::vector{1.0, 0.0}));
    EXPECT_EQ(result_of(module, "smooth_steps", {{0.0}, {2.0}, {0.5, 9.0}})[0], 0.15625);  // t = 1/4
    EXPECT_EQ(result_of(module, "smooth_steps", {{0.0}, {2.0}, {0.5, 9.0}})[1], 1.0);
}

TEST(StandardFunctions, Geometry) {
    const Module module = module_of(
        "float far(vec3 a, vec3 b) { return distance(a, b); }\n"
        "float size(vec2 a) { return length(a); }\n"
        "float scalar_size(float a) { return length(a); }\n"
        "float product(vec4 a, vec4 b) { return dot(a, b); }\n"
        "vec3 turn(vec3 a, vec3 b) { return cross(a, b); }\n"
        "vec3 unit(vec3 a) { return normalize(a); }\n"
        "vec3 face(vec3 n, vec3 i, vec3 g) { return faceforward(n, i, g); }\n"
        "vec3 mirror(vec3 i, vec3 n) { return reflect(i, n); }\n"
        "vec2 bend(vec2 i, vec2 n, float eta) { return refract(i, n, eta); }\n");
    EXPECT_NEAR(number_of(module, "far", {{1, 2, 3}, {3, 5, 9}}), 7.0, kTolerance);
    EXPECT_NEAR(number_of(module, "size", {{3, 4}}), 5.0, kTolerance);
    EXPECT_EQ(number_of(module, "scalar_size", {{-3}}), 3.0);
    EXPECT_EQ(number_of(module, "product", {{1, 2, 3, 4}, {5, 6, 7, 8}}), 70.0);
    EXPECT_EQ(result_of(module, "turn", {{1, 2, 3}, {-4, 5, 7}}), (std::vector{-1.0, -19.0, 13.0}));
    const std::vector<double> unit = result_of(module, "unit", {{2, -3, 6}});
    expect_near(unit[0], 2.0 / 7.0, "normalize");
    expect_near(unit[1], -3.0 / 7.0, "normalize");
    EXPECT_TRUE(std::isnan(result_of(module, "unit", {{0, 0, 0}})[0]));
    EXPECT_EQ(result_of(module, "face", {{1, 2, 3}, {0, 0, -1}, {0, 0, 1}}), (std::vector{1.0, 2.0, 3.0}));
    EXPECT_EQ(result_of(module, "face", {{1, 2, 3}, {0, 0, 1}, {0, 0, 1}}), (std::vector{-1.0, -2.0, -3.0}));
    EXPECT_EQ(result_of(module, "mirror", {{1, -1, 0.5}, {0, 1, 0}}), (std::vector{1.0, 1.0, 0.5}));
    // Snell: sin(out) = eta sin(in); the vector stays a unit one, and beyond the critical angle there is none.
    const double angle = 0.6;
    const std::vector<double> bent =
        result_of(module, "bend", {{std::sin(angle), -std::cos(angle)}, {0, 1}, {1.0 / 1.5}});
    expect_near(bent[0], std::sin(angle) / 1.5, "refract");
    expect_near(std::hypot(bent[0], bent[1]), 1.0, "refract");
    EXPECT_EQ(result_of(module, "bend", {{std::sin(angle), -std::cos(angle)}, {0, 1}, {2.0}}), (std::vector{0.0, 0.0}));
}

TEST(StandardFunctions, Matrices) {
    const Module module = module_of(
        "vec2 forward(mat3x2 m, vec3 v) { return m * v; }\n"
        "vec3 backward(vec2 v, mat3x2 m) { return v * m; }\n"
        "mat2 both(mat3x2 a, mat2x3 b) { return a * b; }\n"
        "mat2x3 turned(mat3x2 m) { return transpose(m); }\n"
        "mat3x2 outer(vec2 a, vec3 b) { return outerProduct(a, b); }\n"
        "mat2 parts(mat2 a, mat2 b) { return matrixCompMult(a, b) + a * 2.0; }\n"
        "float area(mat2 m) { return determinant(m); }\n"
        "float volume(mat4 m) { return determinant(m); }\n"
        "mat4 undone(mat4 m) { return inverse(m) * m; }\n"
        "mat3 undone3(mat3 m) { return m * inverse(m); }\n"
        "mat3 smaller(mat4 m) { return mat3(m); }\n");
    const std::vector<double> m{1, 2, 3, 4, 5, 6};  // columns (1,2) (3,4) (5,6)
    EXPECT_EQ(result_of(module, "forward", {m, {7, 8, 9}}), (std::vector{76.0, 100.0}));
    EXPECT_EQ(result_of(module, "backward", {{7, 8}, m}), (std::vector{23.0, 53.0, 83.0}));
    EXPECT_EQ(result_of(module, "both", {m, {1, 0, 2, 0, 1, 3}}), (std::vector{11.0, 14.0, 18.0, 22.0}));
    EXPECT_EQ(result_of(module, "turned", {m}), (std::vector{1.0, 3.0, 5.0, 2.0, 4.0, 6.0}));
    EXPECT_EQ(result_of(module, "outer", {{1, 2}, {3, 4, 5}}), (std::vector{3.0, 6.0, 4.0, 8.0, 5.0, 10.0}));
    EXPECT_EQ(result_of(module, "parts", {{1, 2, 3, 4}, {5, 6, 7, 8}}), (std::vector{7.0, 16.0, 27.0, 40.0}));
    EXPECT_EQ(number_of(module, "area", {{1, 2, 3, 4}}), -2.0);
    const std::vector<double> four{2, 0, 1, 0, 1, 3, 0, 0, 0, 1, 4, 1, 5, 0, 0, 1};
    EXPECT_EQ(number_of(module, "volume", {four}), 40.0);  // Leibniz' sum of 24 products
    const std::vector<double> one = result_of(module, "undone", {four});
    for (std::size_t i = 0; i < 16; ++i) EXPECT_NEAR(one[i], i % 5 == 0 ? 1.0 : 0.0, 1e-14) << i;
    const std::vector<double> three = result_of(module, "undone3", {{2, 1, 0, 0, 3, 1, 1, 0, 4}});
    for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(three[i], i % 4 == 0 ? 1.0 : 0.0, 1e-14) << i;
    EXPECT_EQ(result_of(module, "smaller", {four}), (std::vector{2.0, 0.0, 1.0, 1.0, 3.0, 0.0, 0.0, 1.0, 4.0}));
}

TEST(StandardFunctions, BitsAndPacking) {
    const Module module = module_of(
        "int bits(float x) { return floatBitsToInt(x); }\n"
        "float back(uint x) { return uintBitsToFloat(x); }\n"
        "vec2 halves(vec2 x) { return unpackHalf2x16(packHalf2x16(x)); }\n"
        "uint packed_half(vec2 x) { return packHalf2x16(x); }\n"
        "uint packed_snorm(vec2 x) { return packSnorm2x16(x); }\n"
        "vec2 snorm(uint x) { return unpackSnorm2x16(x); }\n"
        "uint packed_unorm(vec2 x) { return packUnorm2x16(x); }\n"
        "vec2 unorm(uint x) { return unpackUnorm2x16(x); }\n"
        "vec2 split(float x) { float whole; float rest = modf(x, whole); return vec2(whole, rest); }\n"
        "vec2 tests(float x) { return vec2(isnan(x), isinf(x)); }\n");
    EXPECT_EQ(number_of(module, "bits", {{-1.0}}), -1082130432.0);
    EXPECT_EQ(number_of(module, "back", {{1065353216.0}}), 1.0);
    EXPECT_EQ(result_of(module, "halves", {{0.1, 1e6}}), (std::vector<double>{0.0999755859375, INFINITY}));
    EXPECT_EQ(number_of(module, "packed_half", {{1.0, -2.0}}), double{0xc0003c00u});
    EXPECT_EQ(number_of(module, "packed_snorm", {{1.0, -1.0}}), double{0x80017fffu});
    EXPECT_EQ(result_of(module, "snorm", {{double{0x80007fffu}}}), (std::vector{1.0, -1.0}));
    EXPECT_EQ(number_of(module, "packed_unorm", {{2.0, 0.5}}), double{0x8000ffffu});
    EXPECT_EQ(result_of(module, "unorm", {{double{0xffff0000u}}}), (std::vector{0.0, 1.0}));
    EXPECT_EQ(result_of(module, "split", {{-3.25}}), (std::vector{-3.0, -0.25}));
    EXPECT_EQ(result_of(module, "tests", {{NAN}}), (std::vector{1.0, 0.0}));
    EXPECT_EQ(result_of(module, "tests", {{-INFINITY}}), (std::vector{0.0, 1.0}));
}

TEST(StandardFunctions, IntegersAndBooleans) {
    const Module module = module_of(
        "int sums(int a, int b) { return a * b + a / b - a % b; }\n"
        "int quotient(int a, int b) { return a / b; }\n"
        "uint waves(uint a, uint b) { return (a << 3u) ^ (a >> b) | (~a & b); }\n"
        "int shifts(int a) { return a >> 2; }\n"
        "uint wraps(uint a) { return a + 1u; }\n"
        "uint unsigned_quotient(uint a, uint b) { return a / b * 10u + a % b; }\n"
        "ivec2 ends(ivec2 a) { return clamp(abs(a) * sign(a), ivec2(-3), max(ivec2(1, 2), min(a, ivec2(3)))); }\n"
        "bvec4 orders(vec2 a, vec2 b) { return bvec4(lessThan(a, b), greaterThanEqual(a, b)); }\n"
        "bvec4 integers(ivec2 a, ivec2 b) { return bvec4(equal(a, b), lessThanEqual(a, b)); }\n"
        "bvec3 logic(bvec2 a) { return bvec3(any(a), all(a), (not(a)).x ^^ a.y); }\n"
        "vec4 casts(float x) { return vec4(int(x), uint(x * x), float(bool(x)), float(int(x) == -2)); }\n");
    EXPECT_EQ(number_of(module, "sums", {{17}, {5}}), 85 + 3 - 2);
    // Division truncates towards zero; the remainder of a negative number is undefined in GLSL ES 3.00, 5.9.
    EXPECT_EQ(number_of(module, "quotient", {{-17}, {5}}), -3.0);
    const std::uint32_t a = 0x80000123u;
    EXPECT_EQ(number_of(module, "waves", {{double{a}}, {4}}), double{((a << 3) ^ (a >> 4)) | (~a & 4u)});
    EXPECT_EQ(number_of(module, "shifts", {{-9}}), -3.0);
    EXPECT_EQ(number_of(module, "wraps", {{double{0xffffffffu}}}), 0.0);
    EXPECT_EQ(number_of(module, "unsigned_quotient", {{double{0xfffffff7u}}, {10}}), 4294967288.0 - 1.0);
    EXPECT_EQ(result_of(module, "ends", {{-7, 9}}), (std::vector{-3.0, 3.0}));
    EXPECT_EQ(result_of(module, "orders", {{1, 5}, {2, 5}}), (std::vector{1.0, 0.0, 0.0, 1.0}));
    EXPECT_EQ(result_of(module, "integers", {{1, 5}, {2, 5}}), (std::vector{0.0, 1.0, 1.0, 1.0}));
    EXPECT_EQ(result_of(module, "logic", {{1, 0}}), (std::vector{1.0, 0.0, 0.0}));
    EXPECT_EQ(result_of(module, "casts", {{-2.9}}), (std::vector{-2.0, 8.0, 1.0, 1.0}));
}

}  // namespace
}  // namespace halfframe::shader_ir
