// Whether the half model is the truth: the same functions on a real context with mediump, to the bit.
//
// Each function is drawn by perf/accuracy/function_bench. Inputs of mediump parameters are halves, so that it does not
// matter whether the driver narrows them before or after a lone operation; what comes back is rounded to half, since a
// mediump result may be handed on in 32 bits (Mesa runs a lone mediump operation between 32-bit values in 32 bits).
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "perf/accuracy/function_bench.h"
#include "perf/measure/precision_probe.h"
#include "tests/harness/gl_fixture.h"
#include "tests/shader_ir/run.h"

namespace halfframe::shader_ir {
namespace {

constexpr int kSide = 128;
constexpr std::size_t kLanes = kSide * kSide;

/// How a parameter's values are drawn.
enum class Draw {
    any_half,               ///< every half is as likely: infinities, NaN and subnormals too
    unit,                   ///< halves in [0, 1], with 0 and 1
    wide,                   ///< halves in [-2, 10]
    positive,               ///< halves in [2^-10, 2048]
    direction,              ///< fp32 unit vectors
    near_direction,         ///< the same vectors, moved by up to 0.1
    metres_squared,         ///< fp32 in [0.001, 120]
    inverse_range_squared,  ///< fp32 in [0.005, 0.05]
    one,
};

struct Parameter {
    const char* type;
    Draw draw;
};

struct Probe {
    std::string function;  ///< as Module::function wants it
    const char* returns;
    std::vector<Parameter> parameters;
    /// Where the driver computes something else than the text says: the function that says what it does compute, which
    /// the model runs instead. nullptr: as written.
    const char* as_compiled = nullptr;
};

int components(const std::string& type) { return type == "float" ? 1 : type.back() - '0'; }

bool is_full(Draw draw) {
    return draw == Draw::direction || draw == Draw::near_direction || draw == Draw::metres_squared ||
           draw == Draw::inverse_range_squared;
}

double drawn(Draw draw, std::mt19937& random) {
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    switch (draw) {
        case Draw::any_half: return value_of_half(static_cast<std::uint16_t>(random()));
        case Draw::unit: return rounded(Model::half, std::clamp(between(-0.05, 1.05), 0.0, 1.0));
        case Draw::wide: return rounded(Model::half, between(-2.0, 10.0));
        case Draw::positive: return rounded(Model::half, std::exp2(between(-10.0, 11.0)));
        case Draw::direction:
        case Draw::near_direction: return between(-1.0, 1.0);
        case Draw::metres_squared: return static_cast<float>(between(0.001, 120.0));
        case Draw::inverse_range_squared: return static_cast<float>(between(0.005, 0.05));
        case Draw::one: return 1.0;
    }
    return 0.0;
}

/// Directions of one seed are one set of vectors.
Columns columns_of(const Parameter& parameter, std::size_t place) {
    const bool moved = parameter.draw == Draw::near_direction;
    const bool is_direction = moved || parameter.draw == Draw::direction;
    std::mt19937 random(is_direction ? 5 : 10 + static_cast<std::uint32_t>(place));
    std::mt19937 shift(6);
    Columns result(static_cast<std::size_t>(components(parameter.type)));
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        std::vector<double> value;
        double square = 0.0;
        for (std::size_t s = 0; s < result.size(); ++s) {
            value.push_back(drawn(parameter.draw, random));
            if (moved) value.back() += std::uniform_real_distribution<double>(-0.1, 0.1)(shift);
            square += value.back() * value.back();
        }
        for (std::size_t s = 0; s < result.size(); ++s) {
            result[s].push_back(is_direction ? static_cast<float>(value[s] / std::sqrt(square)) : value[s]);
        }
    }
    return result;
}

/// RGBA of every lane, in half arithmetic at the console tier.
std::vector<float> drawn_by(harness::Ground& ground, const std::vector<std::string>& files, const std::string& text,
                            const Probe& probe, const std::vector<Columns>& inputs) {
    accuracy::DrawnFunction function{.function = probe.function,
                                     .files = files,
                                     .more_text = text,
                                     .arithmetic = gl::Arithmetic::half,
                                     .defines = {{"TIER_CONSOLE", "1"}},
                                     .returned = components(probe.returns)};
    for (const Parameter& parameter : probe.parameters) {
        function.parameters.push_back({.components = components(parameter.type), .full = is_full(parameter.draw)});
    }
    return accuracy::draw_function(ground.gl, ground.caps, function, inputs);
}

/// Equal as halves; any NaN equals any other, and GLSL leaves the sign of zero open.
bool agree(double model, double driver) {
    const std::uint16_t one = half_bits(model);
    const std::uint16_t other = half_bits(driver);
    return one == other || ((one | other) & 0x7fffu) == 0;
}

class HalfOnTheDriver : public harness::GlFixture {
protected:
    void SetUp() override {
        GlFixture::SetUp();
        if (IsSkipped()) return;
        if (const std::string obstacle = accuracy::LaneCanvas::obstacle(caps()); !obstacle.empty())
            GTEST_SKIP() << obstacle;
        if (caps().renderer.find("llvmpipe") == std::string::npos) {
            GTEST_SKIP() << "the half model is llvmpipe's, this is " << caps().renderer;
        }
        const perf::PrecisionProbe probe = perf::probe_precision(gl(), caps());
        if (!probe.mediump.is_half() || probe.mediump.overflow != perf::Overflow::to_infinity ||
            !probe.mediump.keeps_subnormals) {
            GTEST_SKIP() << "not the arithmetic of the half model here: " << probe.sentence;
        }
    }

    /// Each probe against the model; prints and bounds how many lanes differ.
    void expect_agreement(const std::vector<std::string>& files, const std::string& text,
                          const std::vector<Probe>& probes) {
        const Module module = compile(FunctionFiles{
            .paths = files, .arithmetic = gl::Arithmetic::half, .defines = {{"TIER_CONSOLE", "1"}}, .more_text = text});
        ASSERT_FALSE(probes.empty());
        for (const Probe& probe : probes) {
            std::vector<Columns> inputs;
            for (std::size_t i = 0; i < probe.parameters.size(); ++i) {
                inputs.push_back(columns_of(probe.parameters[i], i));
            }
            const std::vector<float> pixels = drawn_by(ground(), files, text, probe, inputs);
            const std::size_t as_written = mismatches(probe, inputs, module, probe.function, pixels);
            if (probe.as_compiled == nullptr) continue;
            // The list is that of Mesa 22.3; another version may compute as written.
            const bool same_compiler = caps().version.find("Mesa 22.3") != std::string::npos;
            if (!same_compiler && as_written == 0) continue;
            EXPECT_GT(as_written, 0u) << probe.function << " is computed as written after all";
            EXPECT_EQ(mismatches(probe, inputs, module, probe.as_compiled, pixels), 0u) << probe.function;
        }
    }

private:
    /// Counts and prints where the model's `function` differs from the driver's picture. A failure for any, if the
    /// probe names no rewriting.
    static std::size_t mismatches(const Probe& probe, const std::vector<Columns>& inputs, const Module& module,
                                  const std::string& function, const std::vector<float>& pixels) {
        const Columns model = evaluate(module, function, inputs, Model::half).returned;
        std::size_t count = 0;
        std::size_t finite = 0;
        std::string first;
        for (std::size_t lane = 0; lane < kLanes; ++lane) {
            for (std::size_t s = 0; s < model.size(); ++s) {
                const auto driver = static_cast<double>(pixels[lane * 4 + s]);
                if (std::isfinite(driver) && driver != 0.0) ++finite;
                if (agree(model[s][lane], driver)) continue;
                if (++count > 1) continue;
                first = fmt::format("; scalar {}: model {:.9g}, driver {:.9g}, inputs", s, model[s][lane], driver);
                for (const Columns& one : inputs) {
                    for (const std::vector<double>& column : one) first += fmt::format(" {:.9g}", column[lane]);
                }
            }
        }
        const std::size_t all = kLanes * model.size();
        fmt::print("{} by the model's {}: {} of {} differ\n", probe.function, function, count, all);
        EXPECT_GT(finite, all / 50) << probe.function << ": hardly anything was compared";
        if (probe.as_compiled == nullptr && count > 0) ADD_FAILURE() << probe.function << first;
        return count;
    }
};

TEST_F(HalfOnTheDriver, AgreesOnTheEnginesFunctions) {
    const std::vector<std::string> files{"surface/surface_limits.h", "common/maths.glsl",      "common/colour.glsl",
                                         "common/packing.glsl",      "tone_map/tone_map.glsl", "sky/sky.glsl",
                                         "surface/surface.glsl"};
    expect_agreement(
        files, "",
        {
            {"saturate", "float", {{"float", Draw::any_half}}},
            {"pow5", "float", {{"float", Draw::wide}}},
            {"storable(vf3;f1;", "vec3", {{"vec3", Draw::any_half}, {"float", Draw::positive}}},
            {"tone_map", "vec3", {{"vec3", Draw::any_half}}},
            {"inverse_tone_map", "vec3", {{"vec3", Draw::wide}}},
            {"inverse_tone_map", "vec3", {{"vec3", Draw::unit}}},
            {"packed_scene_color", "vec3", {{"vec3", Draw::any_half}}},
            {"unpacked_scene_color", "vec3", {{"vec3", Draw::any_half}}},
            {"linear_from_srgb(vf3;", "vec3", {{"vec3", Draw::unit}}},
            {"sky_gradient",
             "vec3",
             {{"float", Draw::wide}, {"vec3", Draw::unit}, {"vec3", Draw::unit}, {"vec3", Draw::unit}}},
            {"sky_gradient",
             "vec3",
             {{"float", Draw::unit}, {"vec3", Draw::unit}, {"vec3", Draw::unit}, {"vec3", Draw::unit}}},
            {"fresnel_schlick", "vec3", {{"vec3", Draw::unit}, {"float", Draw::unit}}},
            {"fresnel_glossy", "vec3", {{"vec3", Draw::unit}, {"float", Draw::unit}, {"float", Draw::unit}}},
            {"power_from_roughness", "float", {{"float", Draw::unit}}},
            {"smoothness_from_power", "float", {{"float", Draw::positive}}},
            {"blinn_lobe",
             "float",
             {{"vec3", Draw::direction}, {"vec3", Draw::near_direction}, {"float", Draw::positive}}},
            {"distance_falloff", "float", {{"float", Draw::metres_squared}, {"float", Draw::inverse_range_squared}}},
            {"cone_falloff", "float", {{"float", Draw::unit}, {"float", Draw::unit}, {"float", Draw::wide}}},
            {"direct_light",
             "vec3",
             {{"vec3", Draw::unit},
              {"vec3", Draw::unit},
              {"float", Draw::positive},
              {"vec3", Draw::direction},
              {"vec3", Draw::near_direction},
              {"vec3", Draw::direction},
              {"vec3", Draw::unit}}},
        });
}

TEST_F(HalfOnTheDriver, AgreesOnBuiltInFunctions) {
    // `one` is 1: a product keeps the driver from running the function behind it alone, in 32 bits.
    const std::string text =
        "float try_exp2(float x, float one) { return exp2(x * one); }\n"
        "float try_log2(float x, float one) { return log2(x * one); }\n"
        "float try_exp(float x, float one) { return exp(x * one); }\n"
        "float try_log(float x, float one) { return log(x * one); }\n"
        "float try_pow(float x, float y, float one) { return pow(x * one, y * one); }\n"
        "float try_sqrt(float x, float one) { return sqrt(x * one); }\n"
        "float try_inversesqrt(float x, float one) { return inversesqrt(x * one); }\n"
        "float try_sin(float x, float one) { return sin(x * one); }\n"
        "float try_cos(float x, float one) { return cos(x * one); }\n"
        "float try_floor(float x, float one) { return floor(x * one); }\n"
        "float try_fract(float x, float one) { return fract(x * one); }\n"
        "float try_round(float x, float one) { return roundEven(x * one); }\n"
        "float try_mod(float x, float y, float one) { return mod(x * one, y * one); }\n"
        "float try_divide(float x, float y, float one) { return (x * one) / (y * one); }\n"
        "float try_mix(float x, float y, float a, float one) { return mix(x * one, y * one, a * one); }\n"
        "vec3 try_mix3(vec3 x, vec3 y, float a) { return mix(x, y, a); }\n"
        "vec3 try_mix33(vec3 x, vec3 y, vec3 a) { return mix(x, y, a); }\n"
        "vec4 try_matrix4(vec4 x, vec4 y, vec4 z, vec4 w, vec4 v) { return mat4(x, y, z, w) * v; }\n"
        "vec2 try_matrix2(vec2 x, vec2 y, vec2 v) { return mat2(x, y) * v; }\n"
        "vec3 try_matrices(vec3 x, vec3 y, vec3 z, vec3 u, vec3 v) { mat3 m = mat3(x, y, z) * mat3(u, v, u); return "
        "vec3(m[0].x, m[1].y, m[2].z); }\n"
        "float try_smoothstep(float a, float b, float x, float one) { return smoothstep(a * one, b * one, x * one); }\n"
        "float try_dot(vec3 x, vec3 y) { return dot(x, y); }\n"
        "float try_dot4(vec4 x, vec4 y) { return dot(x, y); }\n"
        "float try_length(vec3 x) { return length(x); }\n"
        "float try_distance(vec3 x, vec3 y) { return distance(x, y); }\n"
        "vec3 try_normalize(vec3 x) { return normalize(x); }\n"
        "vec3 try_cross(vec3 x, vec3 y) { return cross(x, y); }\n"
        "vec3 try_reflect(vec3 x, vec3 y) { return reflect(x, y); }\n"
        "vec3 try_refract(vec3 x, vec3 y, float eta) { return refract(x, y, eta); }\n"
        "vec3 try_matrix(vec3 x, vec3 y, vec3 z, vec3 v) { return mat3(x, y, z) * v; }\n"
        "vec3 try_row(vec3 x, vec3 y, vec3 z, vec3 v) { return v * mat3(x, y, z); }\n"
        "float try_clamp(float x, float a, float one) { return clamp(x * one, -a, a); }\n";
    const auto unary = [](const char* name, Draw draw) {
        return Probe{name, "float", {{"float", draw}, {"float", Draw::one}}};
    };
    const Parameter any{"vec3", Draw::any_half};
    const Parameter wide{"vec3", Draw::wide};
    const Parameter four{"vec4", Draw::wide};
    expect_agreement(
        {}, text,
        {
            unary("try_exp2", Draw::any_half),
            unary("try_exp2", Draw::wide),
            unary("try_log2", Draw::any_half),
            unary("try_exp", Draw::wide),
            unary("try_log", Draw::any_half),
            unary("try_sqrt", Draw::any_half),
            unary("try_inversesqrt", Draw::any_half),
            unary("try_sin", Draw::wide),
            unary("try_cos", Draw::wide),
            unary("try_floor", Draw::any_half),
            unary("try_fract", Draw::any_half),
            unary("try_round", Draw::any_half),
            {"try_pow", "float", {{"float", Draw::positive}, {"float", Draw::wide}, {"float", Draw::one}}},
            {"try_pow", "float", {{"float", Draw::unit}, {"float", Draw::wide}, {"float", Draw::one}}},
            {"try_mod", "float", {{"float", Draw::wide}, {"float", Draw::positive}, {"float", Draw::one}}},
            {"try_divide", "float", {{"float", Draw::any_half}, {"float", Draw::any_half}, {"float", Draw::one}}},
            {"try_mix",
             "float",
             {{"float", Draw::wide}, {"float", Draw::wide}, {"float", Draw::unit}, {"float", Draw::one}}},
            {"try_mix3", "vec3", {wide, wide, {"float", Draw::unit}}},
            {"try_mix33", "vec3", {wide, wide, {"vec3", Draw::unit}}},
            {"try_matrix4", "vec4", {four, four, four, four, four}},
            {"try_matrix2", "vec2", {{"vec2", Draw::wide}, {"vec2", Draw::wide}, {"vec2", Draw::wide}}},
            {"try_matrices", "vec3", {wide, wide, wide, wide, wide}},
            {"try_smoothstep",
             "float",
             {{"float", Draw::unit}, {"float", Draw::wide}, {"float", Draw::wide}, {"float", Draw::one}}},
            {"try_dot", "float", {wide, any}},
            {"try_dot", "float", {any, any}},
            {"try_dot4", "float", {{"vec4", Draw::wide}, {"vec4", Draw::wide}}},
            {"try_length", "float", {wide}},
            {"try_length", "float", {any}},
            {"try_distance", "float", {wide, wide}},
            {"try_normalize", "vec3", {wide}},
            {"try_normalize", "vec3", {any}},
            {"try_cross", "vec3", {wide, wide}},
            {"try_reflect", "vec3", {wide, wide}},
            {"try_refract", "vec3", {{"vec3", Draw::unit}, {"vec3", Draw::unit}, {"float", Draw::unit}}},
            {"try_matrix", "vec3", {wide, wide, wide, wide}},
            {"try_row", "vec3", {wide, wide, wide, wide}},
            {"try_clamp", "float", {{"float", Draw::any_half}, {"float", Draw::positive}, {"float", Draw::one}}},
        });
}

// Every expression that Mesa is known to rewrite so that halves show it, with what it becomes. A formula whose
// stability rests on one of the left forms has to be written in another way.
TEST_F(HalfOnTheDriver, RewritesTheseExpressionsAsNamed) {
    const std::string text =
        // A sum with constants: 0.0275 + (1 - y) becomes 1.0275 - y, which loses the bits that the first form keeps.
        "vec3 sum_of_constants(vec3 y) { return 1.0 / (0.0275 + (1.0 - y)); }\n"
        "vec3 sum_of_constants_compiled(vec3 y) { return 1.0 / (1.0275 - y); }\n"
        // A product with a constant: the constant moves to the inner factor.
        "vec3 product(vec3 x) { return x * x * 8.0; }\n"
        "vec3 product_compiled(vec3 x) { return x * (x * 8.0); }\n"
        // Two products with a common factor.
        "vec3 common_factor(vec3 x, vec3 y) { return x * y + x * x; }\n"
        "vec3 common_factor_compiled(vec3 x, vec3 y) { return x * (y + x); }\n"
        // mix with a constant end or share; otherwise it is x + a (y - x).
        "vec3 mix_from_constant(vec3 x, float a) { return mix(vec3(0.0437), x, a); }\n"
        "vec3 mix_from_constant_compiled(vec3 x, float a) { return 0.0437 * (1.0 - a) + x * a; }\n"
        "vec3 mix_to_constant(vec3 x, float a) { return mix(x, vec3(0.0437), a); }\n"
        "vec3 mix_to_constant_compiled(vec3 x, float a) { return x * (1.0 - a) + 0.0437 * a; }\n"
        "vec3 mix_by_constant(vec3 x, vec3 y) { return mix(x, y, 0.3); }\n"
        "vec3 mix_by_constant_compiled(vec3 x, vec3 y) { return x * 0.7 + y * 0.3; }\n"
        "vec3 mix_from_one(vec3 x, float a) { return mix(vec3(1.0), x, a); }\n"
        "vec3 mix_from_one_compiled(vec3 x, float a) { return (1.0 - a) + x * a; }\n";
    const Parameter wide{"vec3", Draw::wide};
    const Parameter unit{"vec3", Draw::unit};
    const Parameter share{"float", Draw::unit};
    expect_agreement({}, text,
                     {
                         {"sum_of_constants", "vec3", {unit}, "sum_of_constants_compiled"},
                         {"product", "vec3", {{"vec3", Draw::any_half}}, "product_compiled"},
                         {"common_factor", "vec3", {wide, wide}, "common_factor_compiled"},
                         {"mix_from_constant", "vec3", {wide, share}, "mix_from_constant_compiled"},
                         {"mix_to_constant", "vec3", {wide, share}, "mix_to_constant_compiled"},
                         {"mix_by_constant", "vec3", {wide, wide}, "mix_by_constant_compiled"},
                         {"mix_from_one", "vec3", {wide, share}, "mix_from_one_compiled"},
                     });
}

TEST_F(HalfOnTheDriver, SeesAPlantedDifference) {
    // The sum taken the other way round differs in some lanes: the comparison can tell.
    const std::string text = "float sum(vec3 x, vec3 y) { return (x.x * y.x + x.y * y.y) + x.z * y.z; }\n";
    const Probe probe{"sum", "float", {{"vec3", Draw::wide}, {"vec3", Draw::wide}}};
    const std::vector<Columns> inputs{columns_of(probe.parameters[0], 0), columns_of(probe.parameters[1], 1)};
    const std::vector<float> pixels = drawn_by(ground(), {}, text, probe, inputs);
    const Module module = module_of("float sum(vec3 x, vec3 y) { return dot(x, y); }\n", gl::Arithmetic::half);
    const Columns model = evaluate(module, "sum", inputs, Model::half).returned;
    std::size_t mismatches = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) mismatches += agree(model[0][lane], pixels[lane * 4]) ? 0 : 1;
    EXPECT_GT(mismatches, kLanes / 50);
}

}  // namespace
}  // namespace halfframe::shader_ir
