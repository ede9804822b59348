// Functions that are not plain: out parameters, whole numbers, matrices, arrays, and what is read or written outside.
#include <gtest/gtest.h>

#include <cmath>

#include "engine/error.h"
#include "perf/stability/search.h"

namespace halfframe::stability {
namespace {

using shader_ir::Model;

FunctionStability found_in(const std::string& text) {
    std::vector<gl::ShaderFile> files(gl::shader_files().begin(), gl::shader_files().end());
    files.push_back({"own/own.glsl", text});
    const Subject subject(functions_of("own/own.glsl", text).at(0), "TIER_CONSOLE", files);
    return search(subject, kFastEffort, nullptr);
}

std::string refusal_of(const std::string& text) {
    try {
        (void)found_in(text);
    } catch (const Error& error) {
        return error.what();
    }
    return "it was tried";
}

TEST(NotPlain, IsTriedWhatHolds) {
    for (const char* text :
         {"//@domain k: -3..8; x: 0..1\nfloat f(int k, float x) {\n switch (k) { case 0: return x; case 1: x *= 2.0; break; "
          "default: x = 0.5; }\n return x; }\n",
          "//@domain x: 0..4; z: 0..1\n//@promise result.x == x\n"
          "vec2 f(float x, bool z) { return z ? vec2(x) : vec2(x, 0.0); }\n",
          "//@domain m: -2..2; v: unit\nhighp vec3 f(highp mat3 m, highp vec3 v) { return transpose(m) * v; }\n",
          "//@domain a: -2..2\n//@promise result[3] == 1.0 && result[4] == 2.0\n"
          "mat3x2 f(float a) { return mat3x2(a, a * a, 0.0, 1.0, 2.0, 3.0); }\n",
          "//@domain w: 0..1\nfloat f(float w[4]) { float s = 0.0; for (int k = 0; k < 4; ++k) { if (s > 2.0) break; s = "
          "max(s, w[k]); } return s; }\n",
          "//@domain x: any\n//@promise in 0..255\nuint f(uint x) { x ^= x >> 16u; return (x * 73u) & 0xffu; }\n",
          "uniform mediump vec4 tint;\n//@domain x: 0..1; vec4 tint: 0..2\n//@promise in 0..2\n"
          "vec3 f(float x) { return tint.rgb * x; }\n",
          "varying vec2 uv;\nuniform sampler2D map;\n//@domain vec2 uv: 0..1; sampler2D map: 0..1\n"
          "//@jumps step(0.5, uv.x)\n//@promise in 0..1\nvec4 f() { return texture2D(map, uv); }\n"
          "void main() { gl_FragColor = f(); }\n",
          "vec3 light;\n//@writes vec3 light\n//@domain x: 0..1\n//@promise result.y == x\n"
          "void f(float x) { light = vec3(0.0, x, 1.0); }\n",
          "//@promise result == 0.5\nfloat f(void) { return 0.5; }\n"}) {
        const FunctionStability found = found_in(text);
        EXPECT_TRUE(found.portable()) << text << (found.violations.empty() ? "" : found.violations[0]);
        EXPECT_GT(found.lanes, 0u);
    }
}

TEST(NotPlain, IsFoundWhatBreaks) {
    const FunctionStability out =
        found_in("//@domain x: 0..1000; z: 0..1\nvoid f(float x, out float y, inout float z) { y = x; z += x * x; }\n");
    ASSERT_FALSE(out.violations.empty());
    EXPECT_NE(out.violations[0].find("f, half: "), std::string::npos) << out.violations[0];
    EXPECT_NE(out.violations[0].find("NaN or inf; try x = 256"), std::string::npos) << out.violations[0];
    // 36 additions in half.
    const FunctionStability sum =
        found_in("uniform sampler2D map;\n//@domain at: 0..1; sampler2D map: 0..1\n//@jumps step(0.5, at.x)\n"
                 "float f(vec2 at) { float s = 0.0; for (int i = 0; i < 36; ++i) s += texture(map, at).r;\n"
                 " return s / 36.0; }\n");
    EXPECT_FALSE(sum.portable());
}

TEST(NotPlain, IsRefusedWhatNothingIsSaidOf) {
    EXPECT_NE(refusal_of("uniform vec4 tint;\n//@domain x: 0..1\nvec3 f(float x) { return tint.rgb * x; }\n")
                  .find("f reads tint from outside"),
              std::string::npos);
    EXPECT_NE(refusal_of("float total = 0.0;\n//@domain x: 0..1\nfloat f(float x) { total += x; return total; }\n")
                  .find("total, which is set before main()"),
              std::string::npos);
    EXPECT_NE(refusal_of("//@domain x: 0..1; vec4 none: 0..1\nfloat f(float x) { return x; }\n")
                  .find("own/own.glsl:2: what is declared above f does not compile with it"),
              std::string::npos);
    EXPECT_NE(gap_in(functions_of("a/a.glsl", "struct L { vec3 c; };\nvec3 f(L l) { return l.c; }\n").at(0))
                  .find("the parameter 'L l', of a type that nothing can be given for"),
              std::string::npos);
    EXPECT_NE(gap_in(functions_of("a/a.glsl", "void f(float x) {}\n").at(0)).find("nothing comes back"),
              std::string::npos);
}

TEST(NotPlain, CommentsAndInnerBlocksAreNoFunctions) {
    const std::vector<Declaration> functions = functions_of(
        "a/a.glsl", "/* float a(float x) { return x; } */\n  float f ( in float x , // float b(float x) {\n"
                    "   const in float y )\n{\n float c = max(x, y);\n return c;\n}\n");
    ASSERT_EQ(functions.size(), 1u);
    EXPECT_EQ(functions[0].name, "f");
    EXPECT_EQ(functions[0].parameters.size(), 2u);
}

// A highlight of specular 0.04 a tenth of a degree to four degrees off its peak of 10: as one factor the lobe ended at
// 2^-14, which (power + 2) / 8 made 0.016 of.
TEST(DirectLight, TheLobeSurvivesWhereSubnormalsAreFlushed) {
    for (const Declaration& one : all_functions()) {
        if (one.name != "direct_light") continue;
        const Subject subject(one, "TIER_CONSOLE", gl::shader_files());
        std::vector<std::vector<double>> lanes;
        for (double angle = 0.002; angle < 0.07; angle += 0.001) {
            const double c = std::cos(2.0 * angle), s = std::sin(2.0 * angle);
            lanes.push_back({0.0, 0.0, 0.0, 0.04, 0.04, 0.04, 2048.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, s, 0.0, c, 100.0,
                             100.0, 100.0});
        }
        const Batch batch = batch_of(one, lanes);
        const auto truth = subject.run(batch, Model::in_double), flushed = subject.run(batch, Model::half_flushed);
        std::size_t judged = 0;
        for (std::size_t lane = 0; lane < lanes.size(); ++lane) {
            if (truth[0][lane] < 0.02) continue;  // 2^-14 of a radiance of 100 is 0.006
            ++judged;
            // 7e-3: twice the rounding of the root, and that of the exponent, 20 at the rim: 20 ln 2 / 2^11.
            EXPECT_NEAR(flushed[0][lane] / truth[0][lane], 1.0, 7e-3 + 0.0061 / truth[0][lane]) << "lane " << lane;
        }
        EXPECT_GT(judged, 30u);
        return;
    }
    FAIL() << "there is no direct_light";
}

}  // namespace
}  // namespace halfframe::stability
