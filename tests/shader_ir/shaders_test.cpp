// The engine's own shaders: their functions in double against the formulas written again here, and what mediump does.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "tests/shader_ir/run.h"

namespace halfframe::shader_ir {
namespace {

// 3e-7: constants of a shader are fp32 (half a step: 6e-8 relative), and a few of them multiply.
constexpr double kConstants = 3e-7;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

const std::vector<std::string> kFiles{"surface/surface_limits.h", "common/maths.glsl",      "common/colour.glsl",
                                      "common/packing.glsl",      "tone_map/tone_map.glsl", "sky/sky.glsl",
                                      "surface/surface.glsl"};

Module functions(gl::Arithmetic arithmetic, const std::vector<gl::Define>& defines = {{"TIER_CONSOLE", "1"}}) {
    return compile(FunctionFiles{.paths = kFiles, .arithmetic = arithmetic, .defines = defines, .more_text = ""});
}

std::vector<double> uniform_numbers(std::uint32_t seed, double low, double high, std::size_t count = 2000) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> among(low, high);
    std::vector<double> values(count);
    for (double& value : values) value = among(random);
    return values;
}

Columns columns(std::uint32_t seed, std::size_t scalars, double low, double high) {
    Columns result;
    for (std::size_t s = 0; s < scalars; ++s) {
        result.push_back(uniform_numbers(seed + 100 * static_cast<std::uint32_t>(s), low, high));
    }
    return result;
}

/// Unit vectors; `near`: at most about that far [rad] from those of the same seed with near = 0.
Columns unit_vectors(std::uint32_t seed, double near = 0.0) {
    Columns result = columns(seed, 3, -1.0, 1.0);
    const Columns shift = columns(seed + 7, 3, -near, near);
    for (std::size_t i = 0; i < result[0].size(); ++i) {
        for (const bool moved : {false, true}) {
            if (moved && near == 0.0) break;
            double square = 0.0;
            for (std::size_t s = 0; s < 3; ++s) {
                if (moved) result[s][i] += shift[s][i];
                square += result[s][i] * result[s][i];
            }
            for (std::size_t s = 0; s < 3; ++s) result[s][i] /= std::sqrt(square);
        }
    }
    return result;
}

using Wanted = std::function<double(std::size_t lane, std::size_t scalar)>;

/// Every lane and scalar of what `function` returns in double, against `wanted`.
void expect_function(const std::string& function, const std::vector<Columns>& inputs, const Wanted& wanted,
                     double relative = kConstants) {
    static const Module kModule = functions(gl::Arithmetic::full);
    const Columns found = evaluate(kModule, function, inputs, Model::in_double).returned;
    ASSERT_FALSE(found.empty());
    double worst = 0.0;
    for (std::size_t s = 0; s < found.size(); ++s) {
        for (std::size_t i = 0; i < found[s].size(); ++i) {
            const double truth = wanted(i, s);
            worst = std::max(worst, std::fabs(found[s][i] - truth) / std::max(1.0, std::fabs(truth)));
        }
    }
    EXPECT_LE(worst, relative) << function;
}

double clamped(double x) { return x < 0.0 ? 0.0 : x > 1.0 ? 1.0 : x; }

TEST(Shaders, ToneMapAndItsInverse) {
    const Columns light = columns(1, 3, 0.0, 20.0);
    expect_function("tone_map", {light}, [&](std::size_t i, std::size_t s) {
        const double x = light[s][i] > 8.0 ? 8.0 : light[s][i];
        return 1.0275 * x / (x + 0.22);
    });
    const Columns display = columns(2, 3, -0.2, 1.2);
    // 1e-5: at 1 the curve has a slope of 299, which multiplies the constants' error of 3e-8.
    expect_function(
        "inverse_tone_map", {display},
        [&](std::size_t i, std::size_t s) {
            const double y = clamped(display[s][i]);
            return 0.22 * y / (1.0275 - y);
        },
        1e-5);
}

TEST(Shaders, PackingStorableAndColour) {
    const Columns light = columns(3, 3, 0.0, 8.0);
    expect_function("packed_scene_color", {light},
                    [&](std::size_t i, std::size_t s) { return std::sqrt(light[s][i] / 8.0); });
    expect_function("unpacked_scene_color", {light},
                    [&](std::size_t i, std::size_t s) { return 8.0 * light[s][i] * light[s][i]; });
    const Columns wild = columns(4, 3, -10.0, 30.0);
    expect_function("storable(vf3;f1;", {wild, {{20.0}}},
                    [&](std::size_t i, std::size_t s) { return std::clamp(wild[s][i], 0.0, 20.0); });
    const Columns nothing{{NAN, INFINITY, -INFINITY}};
    const Columns stored = evaluate(functions(gl::Arithmetic::half), "storable(f1;f1;",
                                    std::vector{nothing, Columns{{65504.0}}}, Model::half)
                               .returned;
    EXPECT_EQ(stored[0], (std::vector{0.0, 65504.0, 0.0}));
    const Columns srgb = columns(5, 3, 0.0, 1.0);
    // 0.0018: the cubic's stated distance from IEC 61966-2-1.
    expect_function(
        "linear_from_srgb(vf3;", {srgb},
        [&](std::size_t i, std::size_t s) {
            const double v = srgb[s][i];
            return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        },
        0.0018);
}

TEST(Shaders, SkyGradient) {
    const std::vector<Columns> inputs{columns(6, 1, -1.0, 1.0), columns(7, 3, 0.0, 1.0), columns(8, 3, 0.0, 1.0),
                                      columns(9, 3, 0.0, 1.0)};
    expect_function("sky_gradient", inputs, [&](std::size_t i, std::size_t s) {
        const double height = inputs[0][0][i];
        const double above = 1.0 - std::pow(1.0 - clamped(height), 3.0);
        const double sky = inputs[2][s][i] + (inputs[1][s][i] - inputs[2][s][i]) * above;
        const double below = clamped(-8.0 * height);
        const double share = 3.0 * below * below - 2.0 * below * below * below;
        return sky + (inputs[3][s][i] - sky) * share;
    });
}

TEST(Shaders, FresnelRoughnessAndSmoothness) {
    const Columns specular = columns(10, 3, 0.0, 1.0);
    const Columns cosine = columns(11, 1, 0.0, 1.1);
    const Columns smoothness = columns(12, 1, 0.0, 1.0);
    const auto fifth = [&](std::size_t i) { return std::pow(clamped(1.0 - cosine[0][i]), 5.0); };
    expect_function("fresnel_schlick", {specular, cosine},
                    [&](std::size_t i, std::size_t s) { return specular[s][i] + (1.0 - specular[s][i]) * fifth(i); });
    expect_function("fresnel_glossy", {specular, smoothness, cosine}, [&](std::size_t i, std::size_t s) {
        return specular[s][i] + (std::max(smoothness[0][i], specular[s][i]) - specular[s][i]) * fifth(i);
    });
    const Columns roughness = columns(13, 1, 0.0, 1.0);
    expect_function("power_from_roughness", {roughness}, [&](std::size_t i, std::size_t) {
        return std::clamp(2.0 / std::pow(roughness[0][i], 4.0) - 2.0, 2.0, 2048.0);
    });
    const Columns power = columns(14, 1, 2.0, 2048.0);
    expect_function("smoothness_from_power", {power},
                    [&](std::size_t i, std::size_t) { return (std::log(power[0][i]) / std::log(2.0) - 1.0) / 10.0; });
}

TEST(Shaders, LobeFalloffAndLight) {
    const Columns n = unit_vectors(15);
    const Columns h = unit_vectors(15, 0.1);
    const Columns power = columns(16, 1, 2.0, 2048.0);
    const auto dot = [](const Columns& a, const Columns& b, std::size_t i) {
        return a[0][i] * b[0][i] + a[1][i] * b[1][i] + a[2][i] * b[2][i];
    };
    // 6e-3: the error that the chord's series states, of a peak of 1.
    expect_function(
        "blinn_lobe", {n, h, power}, [&](std::size_t i, std::size_t) { return std::pow(dot(n, h, i), power[0][i]); },
        6e-3);
    const Columns square = columns(17, 1, 0.001, 120.0);
    const Columns range = columns(18, 1, 0.01, 0.04);
    expect_function(
        "distance_falloff", {square, range},
        [&](std::size_t i, std::size_t) {
            const double ratio = square[0][i] * range[0][i];
            const double window = std::max(1.0 - ratio * ratio, 0.0);
            return window * window / std::max(square[0][i], 1e-5 / range[0][i]);
        },
        1e-6);
    const Columns cosine = columns(19, 1, -1.0, 1.0);
    expect_function("cone_falloff", {cosine, {{0.2}}, {{2.0}}}, [&](std::size_t i, std::size_t) {
        const double t = clamped((cosine[0][i] - 0.2) * 2.0);
        return t * t * (3.0 - 2.0 * t);
    });
}

TEST(Shaders, DirectLightOfALambertSurfaceIsTheCosine) {
    const Columns n = unit_vectors(20);
    const Columns l = unit_vectors(22);
    const Columns albedo = columns(23, 3, 0.0, 1.0);
    const Columns none{{0.0}, {0.0}, {0.0}};
    // Without specular, what is left of the lobe is Fresnel's rise at grazing angles: at most (p + 2) / 8 = 0.5 of
    // the radiance, and 0 where half vector and light meet. So take light and view to be the same direction.
    expect_function("direct_light", {albedo, none, {{2.0}}, n, l, l, {{2.0}, {2.0}, {2.0}}},
                    [&](std::size_t i, std::size_t s) {
                        const double cosine = n[0][i] * l[0][i] + n[1][i] * l[1][i] + n[2][i] * l[2][i];
                        return 2.0 * albedo[s][i] * std::max(cosine, 0.0);
                    });
}

gl::ProgramDescription tone_map_program(gl::Dialect dialect) {
    gl::ProgramDescription description;
    description.name = "tone_map";
    description.vertex = "tone_map/tone_map.vert";
    description.fragment = "tone_map/tone_map.frag";
    description.dialect = dialect;
    description.arithmetic = gl::Arithmetic::half;
    description.defines = {{"TIER_CONSOLE", "1"}};
    return description;
}

TEST(Shaders, MainOfTheToneMapWithATextureOnTheCpu) {
    const Sampler scene{.sample =
                            [](const SampleRequest& at) {
                                return std::array{at.at[0] * 10.0, kNaN, -1.0, 1.0};
                            },
                        .size = {}};
    const Bindings bindings{.variables = {{"vertex_uv", {{0.0, 0.125, 0.5, 1.0}, {0.5}}}},
                            .samplers = {{"scene_color", scene}}};
    const Module module = compile(tone_map_program(gl::Dialect::es100), gl::Stage::fragment);
    EXPECT_TRUE(module.up_converted);
    EXPECT_FALSE(compile(tone_map_program(gl::Dialect::es300), gl::Stage::fragment).up_converted);
    const Columns color = evaluate(module, "main", {}, Model::in_double, bindings).outputs.at("fragment_color");
    for (std::size_t i = 0; i < 4; ++i) {
        const double light = std::min(bindings.variables.at("vertex_uv")[0][i] * 10.0, 8.0);
        EXPECT_NEAR(color[0][i], 1.0275 * light / (light + 0.22), kConstants);
        EXPECT_EQ(color[1][i], 0.0) << "a NaN reached the target";
        EXPECT_EQ(color[2][i], 0.0);
        EXPECT_EQ(color[3][i], 1.0);
    }
    // 2e-3: three roundings of at most 2^-11 each, and a slope below 1 behind the division.
    const Columns half = evaluate(module, "main", {}, Model::half, bindings).outputs.at("fragment_color");
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(half[0][i], color[0][i], 2e-3);
    EXPECT_NE(half[0], color[0]);
}

TEST(Shaders, EveryFileCompilesInEveryTierAndArithmetic) {
    int compiled = 0;
    for (const gl::ShaderFile& file : gl::shader_files()) {
        const std::string path = file.path;
        const bool vertex = path.ends_with(".vert");
        if (!vertex && !path.ends_with(".frag")) continue;
        for (const char* tier : {"TIER_LOW", "TIER_CONSOLE", "TIER_REFERENCE"}) {
            for (const gl::Arithmetic arithmetic : {gl::Arithmetic::half, gl::Arithmetic::full}) {
                gl::ProgramDescription description;
                description.name = path;
                description.vertex = path;
                description.fragment = path;
                description.arithmetic = arithmetic;
                description.defines = {{tier, "1"}};
                const Module module = compile(description, vertex ? gl::Stage::vertex : gl::Stage::fragment);
                EXPECT_EQ(module.function("main").parameters.size(), 0u) << path;
                ++compiled;
            }
        }
    }
    EXPECT_GE(compiled, 6 * 12);  // twelve stages when this was written
}

TEST(Shaders, MainOfTheSurfaceIsEvaluatedInEveryModelAsWrittenAndCleaned) {
    gl::ProgramDescription surface;
    surface.name = "surface";
    surface.vertex = "surface/surface.vert";
    surface.fragment = "surface/surface.frag";
    surface.arithmetic = gl::Arithmetic::half;
    surface.defines = {{"TIER_CONSOLE", "1"},   {"SUN", "1"},       {"LOCAL_LIGHTS", "1"}, {"NORMAL_MAP", "1"},
                       {"BASE_COLOR_MAP", "1"}, {"ALPHA_MASK", "1"}};
    const Sampler grey{.sample = [](const SampleRequest&) { return std::array{0.5, 0.5, 1.0, 1.0}; }, .size = {}};
    Bindings bindings;
    bindings.samplers = {{"base_color_map", grey}, {"normal_map", grey}};
    const auto repeat = [](std::vector<double> once, int times) {
        Columns result;
        for (int i = 0; i < times; ++i) {
            for (const double value : once) result.push_back({value});
        }
        return result;
    };
    bindings.variables = {{"vertex_to_eye", {{0}, {0}, {3}}},         {"vertex_uv", {{0.5}, {0.5}}},
                          {"vertex_normal", {{0}, {0}, {1}}},         {"vertex_tangent", {{1}, {0}, {0}, {1}}},
                          {"base_color", {{0.8}, {0.8}, {0.8}, {1}}}, {"emissive", {{0}, {0}, {0}, {0.5}}},
                          {"factors", {{0}, {0.5}, {1}, {0}}},        {"ambient", {{0.1}, {0.1}, {0.1}, {0}}},
                          {"parallel_eye", {{0}, {0}, {0}, {1}}},     {"sun_direction", {{0}, {0}, {1}, {0}}},
                          {"sun_color", {{1}, {1}, {1}, {0}}},        {"light_position", repeat({0, 0, -2, 0.01}, 8)},
                          {"light_color", repeat({1, 1, 1, 0}, 8)},   {"light_direction", repeat({0, 0, 1, 0}, 8)},
                          {"light_count", {{1}, {0}, {0}, {0}}}};
    for (const Cleaning cleaning : {Cleaning::none, Cleaning::inlined}) {
        const Module module = compile(surface, gl::Stage::fragment, cleaning);
        const double exact =
            evaluate(module, "main", {}, Model::in_double, bindings).outputs.at("fragment_color")[0][0];
        EXPECT_GT(exact, 0.5);
        for (const Model model : kModels) {
            const Evaluation run = evaluate(module, "main", {}, model, bindings);
            // 1e-2: some twenty roundings of at most 2^-10.
            EXPECT_NEAR(run.outputs.at("fragment_color")[0][0], exact, 1e-2 * exact) << name(model);
            EXPECT_FALSE(run.discarded[0]);
        }
    }
}

/// Largest error of the reference tier's lobe at a power of 2048 inside its highlight, in the half model.
double lobe_error(gl::Arithmetic arithmetic, const std::vector<gl::Define>& defines, Model model) {
    const Columns n = unit_vectors(31);
    const Columns h = unit_vectors(31, 0.03);
    const Module module = functions(arithmetic, defines);
    const std::vector<Columns> inputs{n, h, {{2048.0}}};
    const Columns found = evaluate(module, "blinn_lobe", inputs, model).returned;
    double worst = 0.0;
    for (std::size_t i = 0; i < n[0].size(); ++i) {
        // 1 - n.h as half the squared distance, which loses nothing near 1.
        double square = 0.0;
        for (std::size_t s = 0; s < 3; ++s) square += (n[s][i] - h[s][i]) * (n[s][i] - h[s][i]);
        worst = std::max(worst, std::fabs(found[0][i] - std::exp(2048.0 * std::log1p(-0.5 * square))));
    }
    return worst;
}

TEST(MixedPrecision, DecidesPerOperation) {
    const std::vector<gl::Define> console{{"TIER_CONSOLE", "1"}};
    // The word highp erased by a macro: everything is mediump, the default of half arithmetic.
    const std::vector<gl::Define> erased{{"TIER_CONSOLE", "1"}, {"highp", ""}};
    const double mixed = lobe_error(gl::Arithmetic::half, console, Model::half);
    const double all_half = lobe_error(gl::Arithmetic::half, erased, Model::half);
    const double all_float = lobe_error(gl::Arithmetic::full, console, Model::half);
    RecordProperty("mixed", std::to_string(mixed));
    RecordProperty("all_half", std::to_string(all_half));
    RecordProperty("all_float", std::to_string(all_float));
    // The chord is highp and the rest mediump: under the 0.6 % of the peak that the shader states.
    EXPECT_LT(mixed, 0.006);
    // All in half, n and h themselves have steps of 2^-11 where the highlight is 0.02 wide.
    EXPECT_GT(all_half, 5.0 * mixed);
    // All in float, what is left is the series, so mixed is not float in disguise.
    EXPECT_LT(all_float, 0.1 * mixed);
    EXPECT_EQ(lobe_error(gl::Arithmetic::half, console, Model::in_float), all_float);
}

TEST(MixedPrecision, HalfIsWhereTheTextSaysMediump) {
    const Module module = module_of(
        "struct Held { mediump float a; highp float b; };\n"
        "uniform mediump float u;\n"
        "uniform Held held;\n"
        "highp float from_structure() { return held.a; }\n"
        "highp vec2 through_structure(highp float x) { Held h = Held(x, x); h.b += 0.0; return vec2(h.a, h.b); }\n"
        "mediump float narrow(mediump float x) { return x + 1.0; }\n"
        "highp float wide(highp float x) { return x + 1.0; }\n"
        "highp float passed(mediump float x, highp float y) { return x + y; }\n"
        "highp float kept(highp float x) { mediump float y = x; return y; }\n"
        "highp float by_out(highp float x) { mediump float y; { y = x * 3.0; } highp float z = y * 1.0; return z; }\n"
        "highp float from_uniform() { return u + 0.0 * u; }\n"
        "highp float straight_from_uniform() { return u; }\n"
        "bool compared(mediump float x) { return u == x; }\n");
    const double fine = 1.0 + 0x1p-12;
    for (const Model model : kModels) {
        const bool narrow = is_narrow(model);
        const double x = 0x1p-12;
        EXPECT_EQ(number_of(module, "narrow", {{x}}, model), narrow ? 1.0 : 1.0 + x) << name(model);
        EXPECT_EQ(number_of(module, "wide", {{x}}, model), 1.0 + x) << name(model);
        EXPECT_EQ(number_of(module, "passed", {{fine}, {fine}}, model), narrow ? 1.0 + fine : 2.0 * fine)
            << name(model);
        EXPECT_EQ(number_of(module, "kept", {{fine}}, model), narrow ? 1.0 : fine) << name(model);
        EXPECT_EQ(number_of(module, "by_out", {{fine}}, model), narrow ? 3.0 : 3.0 * fine) << name(model);
        // A uniform keeps its 32 bits until a mediump operation uses it.
        const Bindings bindings{.variables = {{"u", {{fine}}}}, .samplers = {}};
        EXPECT_EQ(number_of(module, "from_uniform", {}, model, bindings), narrow ? 1.0 : fine) << name(model);
        EXPECT_EQ(number_of(module, "straight_from_uniform", {}, model, bindings), fine) << name(model);
        const Bindings structure{.variables = {{"held", {{fine}, {fine}}}}, .samplers = {}};
        EXPECT_EQ(number_of(module, "from_structure", {}, model, structure), fine) << name(model);
        const std::vector<double> both = result_of(module, "through_structure", {{fine}}, model);
        EXPECT_EQ(both, (std::vector{narrow ? 1.0 : fine, fine})) << name(model);
        EXPECT_EQ(number_of(module, "compared", {{1.0}}, model, bindings), narrow ? 1.0 : 0.0) << name(model);
    }
}

TEST(MixedPrecision, TheFiveModelsDisagreeWhereTheyShould) {
    const Module module = module_of(
        "mediump float f(mediump float x) { return (x * x) * 0.001; }\n"
        "mediump float g(mediump float x) { return (x * 0.03125) * 1024.0; }\n"
        "mediump float zero(mediump float x) { return pow(x, 0.0); }\n");
    const auto all = [&](const char* function, double x) {
        std::vector<double> values;
        for (const Model model : kModels) values.push_back(number_of(module, function, {{x}}, model));
        return values;
    };
    const std::vector<double> large = all("f", 300.0);
    EXPECT_NEAR(large[0], 90.0, 1e-5);
    EXPECT_NEAR(large[1], 90.0, 1e-5);
    EXPECT_TRUE(std::isinf(large[2]) && std::isinf(large[3]));
    EXPECT_NEAR(large[4], 16.376, 0.01);  // 16376 after clamping
    EXPECT_EQ(all("g", 0x1p-14), (std::vector{0x1p-9, 0x1p-9, 0x1p-9, 0.0, 0.0}));
    EXPECT_EQ(all("zero", 0.0), (std::vector{1.0, 0.0, 0.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace halfframe::shader_ir
