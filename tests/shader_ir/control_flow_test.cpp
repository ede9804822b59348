// Paths that lanes take apart, calls, memory, and what an Error says.
#include <array>
#include <cmath>

#include "tests/shader_ir/run.h"

namespace halfframe::shader_ir {
namespace {

constexpr std::size_t kLanes = 1000;  // four runs of the machine, the last not full

/// 0, 1, 2, ... one a lane.
std::vector<double> counting() {
    std::vector<double> values(kLanes);
    for (std::size_t i = 0; i < kLanes; ++i) values[i] = static_cast<double>(i);
    return values;
}

/// `function` of one float, against the same in C++, for a thousand lanes that part and meet.
template <typename Wanted>
void expect_function(const std::string& text, Wanted wanted) {
    const std::vector<Columns> inputs{{counting()}};
    const Columns found = evaluate(module_of(text), "f", inputs, Model::in_double).returned;
    ASSERT_EQ(found.at(0).size(), kLanes);
    for (std::size_t i = 0; i < kLanes; ++i) ASSERT_EQ(found[0][i], wanted(static_cast<double>(i))) << i;
    // The same as main, where SPIRV-Tools may turn variables into values and branches into phis.
    const gl::StageText stage{
        "#version 300 es\nprecision highp float;\nprecision highp int;\nin float x;\nout float y;\n" + text +
            "void main() { y = f(x); }\n",
        {"<test>"}};
    for (const Cleaning cleaning : {Cleaning::inlined, Cleaning::optimised}) {
        const Module cleaned = compile(stage, gl::Stage::fragment, cleaning);
        const Evaluation run =
            evaluate(cleaned, "main", {}, Model::in_double, {.variables = {{"x", {counting()}}}, .samplers = {}});
        for (std::size_t i = 0; i < kLanes; ++i)
            ASSERT_EQ(run.outputs.at("y")[0][i], found[0][i]) << i << " cleaned " << static_cast<int>(cleaning);
    }
}

TEST(ControlFlow, IfElseChains) {
    expect_function(
        "float f(float x) { float y = 1.0; if (x < 10.0) y = 2.0; else if (x < 300.0) { y = 3.0; if (mod(x, 2.0) == "
        "0.0) "
        "y = 4.0; } return x > 5.0 && x < 7.0 || x == 400.0 ? -y : y; }\n",
        [](double x) {
            double y = 1.0;
            if (x < 10.0) {
                y = 2.0;
            } else if (x < 300.0) {
                y = std::fmod(x, 2.0) == 0.0 ? 4.0 : 3.0;
            }
            return (x > 5.0 && x < 7.0) || x == 400.0 ? -y : y;
        });
}

TEST(ControlFlow, NestedLoopsWithBreakContinueAndReturn) {
    expect_function(
        "float f(float x) { float sum = 0.0;\n"
        "  for (int i = 0; i < 20; i++) { if (float(i) > x) break; if (i == 3) continue;\n"
        "    int j = 0; while (true) { j++; if (j > i) break; if (j == 2) continue; sum += float(j); if (sum > 500.0) "
        "return -x; }\n"
        "    do { sum += 0.5; j--; } while (j > 0);\n"
        "  } return sum; }\n",
        [](double x) {
            double sum = 0.0;
            for (int i = 0; i < 20; i++) {
                if (i > x) break;
                if (i == 3) continue;
                int j = 0;
                while (true) {
                    j++;
                    if (j > i) break;
                    if (j == 2) continue;
                    sum += j;
                    if (sum > 500.0) return -x;
                }
                do {
                    sum += 0.5;
                    j--;
                } while (j > 0);
            }
            return sum;
        });
}

TEST(ControlFlow, SwitchWithFallThroughInALoop) {
    expect_function(
        "float f(float x) { float y = 0.0; for (int i = 0; i < 3; i++) { switch (int(x) % 7 - 1) {\n"
        "    case -1: y += 1.0; break; case 0: y += 2.0; case 1: y += 4.0; break; case 4: continue;\n"
        "    case 5: return 99.0; default: y += 16.0; } y *= 2.0; } return y; }\n",
        [](double x) {
            double y = 0.0;
            for (int i = 0; i < 3; i++) {
                const int which = static_cast<int>(x) % 7 - 1;
                if (which == 4) continue;
                if (which == 5) return 99.0;
                if (which == -1) {
                    y += 1.0;
                } else if (which == 0) {
                    y += 6.0;
                } else {
                    y += which == 1 ? 4.0 : 16.0;
                }
                y *= 2.0;
            }
            return y;
        });
}

TEST(ControlFlow, PhisSwapAtOnce) {
    // Fibonacci numbers: cleaned, a and b are two phis that read each other.
    expect_function(
        "float f(float x) { float a = 0.0; float b = 1.0; int n = int(mod(x, 30.0));\n"
        "  for (int i = 0; i < n; i++) { float old = a; a = b; b = old + b; } return a; }\n",
        [](double x) {
            double a = 0.0;
            double b = 1.0;
            for (int i = 0; i < static_cast<int>(std::fmod(x, 30.0)); i++) {
                const double old = a;
                a = b;
                b = old + b;
            }
            return a;
        });
}

TEST(ControlFlow, DiscardEndsTheLaneEverywhere) {
    const gl::StageText stage{
        "#version 300 es\nprecision highp float;\nin float x;\nout float y;\nfloat count;\n"
        "float kept(float v) { for (int i = 0; i < 4; i++) { if (mod(v, 4.0) == float(i) && i == 2) discard; count += "
        "1.0; } "
        "return v; }\n"
        "void main() { count = 0.0; y = 7.0; y = kept(x) + 1.0; y += count; }\n",
        {"<test>"}};
    const Evaluation run = evaluate(compile(stage, gl::Stage::fragment), "main", {}, Model::in_double,
                                    {.variables = {{"x", {counting()}}}, .samplers = {}});
    for (std::size_t i = 0; i < kLanes; ++i) {
        ASSERT_EQ(run.discarded[i], i % 4 == 2) << i;
        ASSERT_EQ(run.outputs.at("y")[0][i], i % 4 == 2 ? 7.0 : static_cast<double>(i) + 5.0) << i;
    }
}

TEST(Memory, OutAndInoutParametersAndSwizzles) {
    const Module module = module_of(
        "void inner(inout vec3 v, out float s) { v.zx = v.xy * 2.0; s = v.x + v.z; if (s > 100.0) return; v.y = -1.0; "
        "}\n"
        "float f(vec3 a, inout vec3 b, out float s) { vec4 w = vec4(a, 1.0); inner(w.wzy, s); b = w.yzw + b.zzx; "
        "return w.x; }\n");
    // w = (1,2,3,1): v = (w,z,y) = (1,3,2) becomes z=2, x=6: (6,3,2), s = 8, then y = -1: (6,-1,2): w = (1,2,-1,6).
    const Evaluation run =
        evaluate(module, "f", std::vector<Columns>{{{1}, {2}, {3}}, {{10}, {20}, {30}}, {}}, Model::in_double);
    EXPECT_EQ(first_lane(run.returned), (std::vector{1.0}));
    EXPECT_EQ(first_lane(run.parameters[1]), (std::vector{2.0 + 30.0, -1.0 + 30.0, 6.0 + 10.0}));
    EXPECT_EQ(first_lane(run.parameters[2]), (std::vector{8.0}));
}

TEST(Memory, ArraysStructuresAndIndicesThatDifferByLane) {
    const Module module = module_of(
        "struct Light { vec3 color; float power[3]; mat2 turn; };\n"
        "const float kTable[4] = float[4](1.0, 10.0, 100.0, 1000.0);\n"
        "float f(int i) { Light l[2]; l[0] = Light(vec3(1, 2, 3), float[3](4.0, 5.0, 6.0), mat2(7, 8, 9, 10));\n"
        "  l[1] = l[0]; l[1].power[i % 3] += 0.5; l[i % 2].color[i % 3] = -1.0; l[1].turn[i % 2].y *= 2.0;\n"
        "  Light k = l[1]; bool same = k == l[1] && l[0] != l[1];\n"
        "  return kTable[i] + k.power[0] + k.power[1] + k.power[2] + dot(l[0].color, vec3(1)) + dot(k.color, vec3(1)) "
        "+\n"
        "    k.turn[0].y + k.turn[1][1] + (same ? 0.0 : 1e6) + float(l.length()); }\n");
    for (int i = 0; i < 4; ++i) {
        const double replaced = 1.0 + i % 3;
        const double turn = i % 2 == 0 ? 16.0 + 10.0 : 8.0 + 20.0;
        const double wanted = std::pow(10.0, i) + 15.5 + 12.0 - replaced - 1.0 + turn + 2.0;
        EXPECT_EQ(number_of(module, "f", {{static_cast<double>(i)}}), wanted) << i;
    }
    const std::string why = error_of([&] { number_of(module, "f", {{4.0}}); });
    EXPECT_NE(why.find("index 4 of 4 elements"), std::string::npos) << why;
    EXPECT_NE(why.find("<more text>:6"), std::string::npos) << why;
}

TEST(Memory, UniformsInputsOutputsAndVertexStage) {
    const gl::StageText stage{
        "#version 300 es\nstruct Sun { vec3 toward; float bright[2]; };\nuniform Sun sun;\nuniform mat4 clip;\nuniform "
        "int n;\n"
        "in vec3 position;\nout mediump vec3 color;\n"
        "void main() { gl_Position = clip * vec4(position, 1.0); gl_PointSize = 3.0; color = sun.toward * "
        "sun.bright[n]; }\n",
        {"<test>"}};
    const Bindings bindings{
        .variables = {{"sun", {{1}, {2}, {3}, {10}, {20}}},
                      {"clip", {{2}, {0}, {0}, {0}, {0}, {2}, {0}, {0}, {0}, {0}, {2}, {0}, {1}, {1}, {1}, {1}}},
                      {"n", {{1}}},
                      {"position", {{1, 2}, {3, 4}, {5, 6}}}},
        .samplers = {}};
    const Evaluation run = evaluate(compile(stage, gl::Stage::vertex), "main", {}, Model::half, bindings);
    EXPECT_EQ(run.outputs.at("gl_Position"), (Columns{{3, 5}, {7, 9}, {11, 13}, {1, 1}}));
    EXPECT_EQ(run.outputs.at("gl_PointSize"), (Columns{{3, 3}}));
    EXPECT_EQ(run.outputs.at("color"), (Columns{{20, 20}, {40, 40}, {60, 60}}));
}

TEST(Sampling, WhatTheShaderAsksFor) {
    const Module module = module_of(
        "uniform sampler2D image; uniform samplerCube room; uniform mediump sampler2DArray pages; uniform highp "
        "sampler2DShadow shade;\n"
        "vec4 plain(vec2 at) { return texture(image, at); }\n"
        "vec4 biased(vec2 at) { return texture(image, at, 2.0); }\n"
        "vec4 level(vec2 at) { return textureLod(image, at, 3.0); }\n"
        "vec4 slopes(vec2 at) { return textureGrad(image, at, vec2(1, 2), vec2(3, 4)); }\n"
        "vec4 projected(vec4 at) { return textureProj(image, at); }\n"
        "vec4 shifted(vec2 at) { return textureOffset(image, at, ivec2(-1, 2)); }\n"
        "vec4 texel(ivec2 at) { return texelFetch(image, at, 1); }\n"
        "vec4 cube(vec3 at) { return texture(room, at); }\n"
        "vec4 page(vec3 at) { return texture(pages, at); }\n"
        "float shadow(vec3 at) { return texture(shade, at); }\n"
        "vec2 size(int lod) { return vec2(textureSize(image, lod)); }\n"
        "uniform sampler2D several[3];\n"
        "vec4 element(vec2 at) { return texture(several[1], at) + texture(several[2], at) * 10.0; }\n"
        "vec4 given(sampler2D some, vec2 at) { return texture(some, at) * 2.0; }\n");
    SampleRequest seen;
    const Sampler sampler{.sample =
                              [&](const SampleRequest& request) {
                                  seen = request;
                                  return std::array{0.1, 0.2, 0.3, 0.4};
                              },
                          .size =
                              [](int lod) {
                                  return std::array{64 >> lod, 32 >> lod, 1};
                              }};
    const Bindings all{
        .variables = {},
        .samplers = {{"image", sampler}, {"room", sampler}, {"pages", sampler}, {"shade", sampler}, {"some", sampler}}};
    const auto ask = [&](const char* function, const std::vector<double>& at) {
        return result_of(module, function, {at}, Model::in_double, all);
    };
    EXPECT_EQ(ask("plain", {0.5, 0.75}), (std::vector{0.1, 0.2, 0.3, 0.4}));
    EXPECT_EQ(seen.at, (std::array{0.5, 0.75, 0.0, 0.0}));
    EXPECT_FALSE(seen.lod.has_value());
    ask("biased", {0.5, 0.75});
    EXPECT_EQ(seen.bias, 2.0);
    ask("level", {0.5, 0.75});
    EXPECT_EQ(seen.lod, 3.0);
    ask("slopes", {0.5, 0.75});
    EXPECT_EQ(seen.gradient, (std::array{1.0, 2.0, 0.0, 3.0, 4.0, 0.0}));
    ask("projected", {1.0, 2.0, 9.0, 4.0});
    EXPECT_EQ(seen.at, (std::array{0.25, 0.5, 0.0, 0.0}));
    ask("shifted", {0.5, 0.75});
    EXPECT_EQ(seen.offset, (std::array{-1, 2, 0}));
    ask("texel", {5, 6});
    EXPECT_TRUE(seen.texel_fetch);
    EXPECT_EQ(seen.at, (std::array{5.0, 6.0, 0.0, 0.0}));
    EXPECT_EQ(seen.lod, 1.0);
    ask("cube", {1.0, 2.0, 3.0});
    EXPECT_EQ(seen.at, (std::array{1.0, 2.0, 3.0, 0.0}));
    ask("page", {0.1, 0.2, 3.0});
    EXPECT_EQ(seen.at[2], 3.0);
    EXPECT_EQ(ask("shadow", {0.1, 0.2, 0.6}), (std::vector{0.1}));
    EXPECT_EQ(seen.reference, 0.6);
    EXPECT_EQ(ask("size", {2}), (std::vector{16.0, 8.0}));
    EXPECT_EQ(result_of(module, "given", {{}, {0.5, 0.5}}, Model::in_double, all)[0], 0.2);
    const Sampler other{.sample = [](const SampleRequest&) { return std::array{1.0, 1.0, 1.0, 1.0}; }, .size = {}};
    const Bindings array{.variables = {}, .samplers = {{"several", sampler}, {"several[2]", other}}};
    EXPECT_EQ(result_of(module, "element", {{0, 0}}, Model::in_double, array)[1], 10.2);
    // A texture's result has the precision of its sampler.
    EXPECT_EQ(result_of(module, "page", {{0, 0, 0}}, Model::half, all)[0], rounded(Model::half, 0.1));
    EXPECT_EQ(result_of(module, "plain", {{0, 0}}, Model::half, all)[0], rounded(Model::in_float, 0.1));
    const std::string why = error_of([&] { result_of(module, "plain", {{0, 0}}); });
    EXPECT_NE(why.find("<more text>:2"), std::string::npos) << why;
}

TEST(Errors, NameLineAndInstruction) {
    const Module module = module_of(
        "uniform float u;\n\nfloat f(float x) {\n    float y = x * 2.0;\n    return dFdx(y);\n}\n"
        "float g(float x) { return x + u; }\n"
        "float h(float x) { while (x < 10.0) { x *= 1.0; } return x; }\n");
    const std::string derivative = error_of([&] { number_of(module, "f", {{1.0}}); });
    EXPECT_NE(derivative.find("<more text>:5"), std::string::npos) << derivative;
    EXPECT_NE(derivative.find("OpDPdx"), std::string::npos) << derivative;
    const std::string missing = error_of([&] { number_of(module, "g", {{1.0}}); });
    EXPECT_NE(missing.find("<more text>:7: \"u\" is read"), std::string::npos) << missing;
    const std::string endless = error_of([&] { number_of(module, "h", {{1.0}}); });
    EXPECT_NE(endless.find("<more text>:8"), std::string::npos) << endless;
    EXPECT_EQ(number_of(module, "h", {{11.0}}), 11.0);
    const std::string typo =
        error_of([&] { module_of("float f(float x) { return x; }\nfloat g() { return nowhere; }\n"); });
    EXPECT_NE(typo.find("<more text>:2"), std::string::npos) << typo;
    EXPECT_THROW(number_of(module, "unknown", {{1.0}}), Mistake);
    EXPECT_THROW(number_of(module, "f", {}), Mistake);
    EXPECT_THROW(evaluate(module, "f", std::vector<Columns>{{{1, 2}, {1, 2, 3}}}, Model::half), Mistake);
}

}  // namespace
}  // namespace halfframe::shader_ir
