// The gate must let a plain program through and must find each kind of planted fault.
#include "tests/shaders/glslang_gate.h"

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace halfframe::shaders {
namespace {

/// A program of ES 1.00 with room for declarations and statements.
struct Planted {
    std::string vertex_global{};
    std::string vertex_main{};
    std::string fragment_global{};
    std::string fragment_main{};
    bool fragment_highp = true;
};

ProgramTexts es100(const Planted& planted) {
    ProgramTexts program;
    program.name = "planted";
    program.dialect = gl::Dialect::es100;
    program.fragment_highp = planted.fragment_highp;
    program.vertex_file = "planted.vert";
    program.fragment_file = "planted.frag";
    program.vertex = {
        fmt::format("#version 100\nattribute vec4 position;\n{}\nvoid main() {{\ngl_Position = position;\n{}\n}}\n",
                    planted.vertex_global, planted.vertex_main),
        {"planted.vert"}};
    program.fragment = {
        fmt::format("#version 100\nprecision mediump float;\n{}\nvoid main() {{\nvec4 color = vec4(0.5);\n{}\n"
                    "gl_FragColor = color;\n}}\n",
                    planted.fragment_global, planted.fragment_main),
        {"planted.frag"}};
    return program;
}

ProgramTexts es300(const Planted& planted) {
    ProgramTexts program = es100(planted);
    program.dialect = gl::Dialect::es300;
    program.vertex.text =
        fmt::format("#version 300 es\nin vec4 position;\n{}\nvoid main() {{\ngl_Position = position;\n{}\n}}\n",
                    planted.vertex_global, planted.vertex_main);
    program.fragment.text = fmt::format(
        "#version 300 es\nprecision mediump float;\nout vec4 written;\n{}\nvoid main() {{\n"
        "vec4 color = vec4(0.5);\n{}\nwritten = color;\n}}\n",
        planted.fragment_global, planted.fragment_main);
    return program;
}

std::string joined(const std::vector<std::string>& faults) {
    std::string text;
    for (const std::string& fault : faults) text += fault + "\n";
    return text;
}

void expect_passes(const ProgramTexts& program) {
    const GateReport report = check_program(program);
    EXPECT_TRUE(report.faults.empty()) << joined(report.faults);
}

void expect_fault(const ProgramTexts& program, const std::string& part) {
    const GateReport report = check_program(program);
    EXPECT_NE(joined(report.faults).find(part), std::string::npos)
        << "wanted: " << part << "\ngot: " << joined(report.faults);
}

TEST(GateEs100, PlainProgramsPassAndAreCounted) {
    const ProgramTexts program = es100(
        {.vertex_global =
             "uniform mat4 matrix; uniform mediump vec3 tint; varying mediump vec2 at; attribute mat4 instance;",
         .vertex_main = "at = (matrix * instance * position).xy * tint.x;",
         .fragment_global =
             "uniform mediump vec3 tint; uniform float weight[3]; uniform sampler2D a, b; varying mediump vec2 at;",
         .fragment_main = "for (int i = 0; i < 3; i++) color += weight[i] * vec4(tint, 1.0);\n"
                          "color += texture2D(a, at) + texture2D(b, at) * gl_FragCoord;"});
    const GateReport report = check_program(program);
    EXPECT_TRUE(report.faults.empty()) << joined(report.faults);
    EXPECT_EQ(report.counts.attributes, 5);
    EXPECT_EQ(report.counts.vertex_uniform_vectors, 5);
    EXPECT_EQ(report.counts.fragment_uniform_vectors, 3)
        << "the array of three scalars fills the fourth column beside tint";
    EXPECT_EQ(report.counts.fragment_samplers, 2);
    EXPECT_EQ(report.counts.vertex_samplers, 0);
    EXPECT_EQ(report.counts.varying_vectors, 2) << "one for `at`, one for gl_FragCoord";
}

TEST(GateEs100, LoopsOfAppendixAAreTheOnlyOnes) {
    expect_passes(es100({.fragment_main = "for (int i = 0; i < 4; i++) { if (color.x > 0.7) break; color *= 1.1; }"}));
    expect_fault(es100({.fragment_main = "while (color.x < 1.0) color *= 1.1;"}), "while loops not available");
    expect_fault(es100({.fragment_main = "do { color *= 1.1; } while (color.x < 1.0);"}),
                 "do-while loops not available");
    expect_fault(es100({.fragment_global = "uniform int count;",
                        .fragment_main = "for (int i = 0; i < count; i++) color *= 1.1;"}),
                 "inductive-loop");
    expect_fault(es100({.fragment_main = "for (float x = color.y; x < 1.0; x += 0.1) color *= 1.1;"}),
                 "inductive-loop");
}

TEST(GateEs100, IndicesAreConstantsAndLoopCounters) {
    const std::string array = "uniform vec4 colors[4]; uniform int which; uniform sampler2D images[2];";
    expect_passes(
        es100({.fragment_global = array, .fragment_main = "for (int i = 0; i < 4; i++) color += colors[i];"}));
    expect_fault(es100({.fragment_global = array, .fragment_main = "color = colors[which];"}),
                 "Non-constant-index-expression");
    expect_fault(es100({.fragment_global = array, .fragment_main = "color = vec4(color[which]);"}), "onstant");
    expect_fault(
        es100({.fragment_global = array, .fragment_main = "vec4 list[2]; list[which] = color; color = list[0];"}),
        "onstant");
    expect_fault(es100({.fragment_global = array, .fragment_main = "color = texture2D(images[which], color.xy);"}),
                 "onstant");
}

TEST(GateEs100, WhatOnlyEs300HasIsFound) {
    const std::string image = "uniform sampler2D image;";
    expect_fault(es100({.fragment_global = image, .fragment_main = "color = textureLod(image, color.xy, 0.0);"}),
                 "textureLod");
    expect_fault(es100({.fragment_global = image, .fragment_main = "color = texture2DLod(image, color.xy, 0.0);"}),
                 "texture2DLod");
    expect_fault(es100({.fragment_global = image, .fragment_main = "color = texture(image, color.xy);"}), "texture");
    expect_fault(es100({.fragment_main = "color.x = dFdx(color.y);"}), "dFdx");
    expect_fault(es100({.fragment_main = "uint x = 1u;"}), "planted.frag:");
    expect_fault(es100({.fragment_global = "uniform mediump sampler3D image;"}), "sampler3D");
    ProgramTexts wrong_version = es100({});
    wrong_version.dialect = gl::Dialect::es300;
    expect_fault(wrong_version, "the text says version 100, but the dialect is 300");
}

TEST(GateEs100, EachLimitIsCounted) {
    expect_passes(es100({.fragment_global = "uniform vec4 u[16];"}));
    expect_fault(es100({.fragment_global = "uniform vec4 u[17];"}),
                 "17 fragment uniform vectors, but the poorest device has 16");
    expect_fault(es100({.fragment_global = "uniform mat4 m[4]; uniform float one;"}), "17 fragment uniform vectors");
    expect_fault(es100({.vertex_global = "uniform mat4 m[32]; uniform vec2 one;"}), "129 vertex uniform vectors");
    expect_passes(es100({.fragment_global = "uniform sampler2D s[8];"}));
    expect_fault(es100({.fragment_global = "uniform sampler2D s[8]; uniform samplerCube c;"}), "9 fragment samplers");
    expect_fault(es100({.vertex_global = "uniform sampler2D s;"}), "1 vertex samplers, but the poorest device has 0");
    expect_fault(es100({.vertex_global = "attribute mat4 a, b;"}), "9 attributes, but the poorest device has 8");
    expect_passes(es100({.vertex_global = "varying mediump vec4 v[8];", .vertex_main = "v[0] = position;"}));
    expect_fault(es100({.vertex_global = "varying mediump vec4 v[8]; varying mediump float one;"}),
                 "9 varying vectors");
    expect_fault(es100({.fragment_global = "struct S { mat4 m[4]; vec4 one; }; uniform S s;"}),
                 "17 fragment uniform vectors");
}

TEST(GateEs100, FragmentsWithoutHighpNeverReadTheWord) {
    const std::string highp = "uniform highp vec4 u;";
    expect_passes(es100({.fragment_global = highp}));
    expect_fault(es100({.fragment_global = highp, .fragment_highp = false}),
                 "highp reaches a fragment stage without highp");
    expect_passes(es100({.fragment_global = "// highp in a comment\n#define UNUSED highp", .fragment_highp = false}));
    expect_passes(es100({.vertex_global = highp, .fragment_highp = false}));
}

TEST(Precision, BothSidesOfAnInterfaceAgree) {
    const std::string uniform = "uniform vec4 u;";
    // Without a qualifier the defaults decide: highp in vertices, mediump in these fragments.
    expect_fault(es100({.vertex_global = uniform, .fragment_global = uniform}),
                 "the uniform u is highp in planted.vert and mediump in planted.frag");
    expect_fault(es300({.vertex_global = uniform, .fragment_global = uniform}),
                 "the uniform u is highp in planted.vert and mediump in planted.frag");
    expect_passes(es100({.vertex_global = "uniform mediump vec4 u;", .fragment_global = uniform}));
    expect_passes(es100({.vertex_global = uniform, .fragment_global = "precision highp float; uniform vec4 u;"}));
    expect_fault(es100({.vertex_global = "varying vec2 at;",
                        .vertex_main = "at = position.xy;",
                        .fragment_global = "varying vec2 at;",
                        .fragment_main = "color.xy = at;"}),
                 "the varying at is highp in planted.vert and mediump in planted.frag");
    expect_fault(es300({.vertex_global = "out vec2 at;",
                        .vertex_main = "at = position.xy;",
                        .fragment_global = "in vec2 at;",
                        .fragment_main = "color.xy = at;"}),
                 "the varying at is highp in planted.vert and mediump in planted.frag");
    expect_fault(es100({.vertex_global = "struct S { mediump vec4 a; highp vec4 b; }; uniform S s;",
                        .fragment_global = "struct S { mediump vec4 a; mediump vec4 b; }; uniform S s;"}),
                 "the uniform s.b is highp in planted.vert and mediump in planted.frag");
}

TEST(GateEs300, HasItsOwnMinimums) {
    expect_passes(es300({.fragment_global = "uniform vec4 u[224]; uniform sampler2D s[16];",
                         .fragment_main = "int i = 0; while (i < 3) { color += u[i]; i++; }"}));
    expect_fault(es300({.fragment_global = "uniform vec4 u[224]; uniform vec3 one;"}), "225 fragment uniform vectors");
    expect_fault(es300({.fragment_global = "uniform sampler2D s[17];"}), "17 fragment samplers");
    expect_fault(es300({.vertex_global = "uniform vec4 u[257];"}), "257 vertex uniform vectors");
    expect_fault(es300({.vertex_global = "in mat4 a[4];"}), "planted.vert");
    expect_fault(es300({.vertex_global = "in mat4 a, b, c, d;"}), "17 attributes");
    expect_fault(es300({.vertex_global = "out mediump vec4 v[16];"}), "16 varying vectors");
    expect_fault(es300({.fragment_main = "color = texture2D(color);"}), "texture2D");
    expect_fault(es300({.fragment_global = "layout(std140) uniform Block { vec4 b[225]; };"}),
                 "225 fragment uniform vectors");
}

TEST(Link, WhatOnlyOneStageKnowsIsFound) {
    expect_fault(es300({.fragment_global = "in mediump vec2 at;", .fragment_main = "color.xy = at;"}),
                 "planted.frag reads at, which planted.vert does not declare");
    expect_fault(es100({.vertex_global = "uniform mediump vec4 u;", .fragment_global = "uniform mediump vec3 u;"}),
                 "u");
}

TEST(Packing, FollowsTheReferenceOrder) {
    EXPECT_EQ(packed_rows({}), 0);
    EXPECT_EQ(packed_rows({{4, 4}}), 4) << "mat4";
    EXPECT_EQ(packed_rows({{3, 1}, {1, 1}}), 1) << "a scalar beside a vec3";
    EXPECT_EQ(packed_rows({{3, 1}, {2, 1}}), 2);
    EXPECT_EQ(packed_rows({{2, 1}, {2, 1}}), 1) << "two vec2 in a row";
    EXPECT_EQ(packed_rows({{2, 3}, {2, 2}}), 3);
    EXPECT_EQ(packed_rows({{1, 1}, {1, 1}, {1, 1}, {1, 1}, {1, 1}}), 2);
    EXPECT_EQ(packed_rows({{1, 5}}), 5) << "an array runs down a column";
    // The example of Appendix A.7: vec4 a; mat3 b; vec2 c[3], d[2]; vec2 e; float f[3], g[2], h take 8 rows exactly.
    EXPECT_EQ(packed_rows({{4, 1}, {3, 3}, {2, 3}, {2, 2}, {2, 1}, {1, 3}, {1, 2}, {1, 1}}), 8);
}

}  // namespace
}  // namespace halfframe::shaders
