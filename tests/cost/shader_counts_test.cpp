// Counts of small shaders against counts by hand.
#include <gtest/gtest.h>

#include "engine/error.h"
#include "tests/cost/count.h"

namespace halfframe::cost {
namespace {

/// One line a case: what the shader computes, and what a person counts.
struct Case {
    const char* expression;
    double slots, moves, vector_ops, scalar_ops, mads;
};

class Expressions : public testing::TestWithParam<Case> {};

TEST_P(Expressions, CountAsByHand) {
    const Case& wanted = GetParam();
    const ShaderCounts counts = counts_of_expression(wanted.expression);
    const PathCounts& path = counts.weighted;
    EXPECT_DOUBLE_EQ(path.work.slots, wanted.slots) << wanted.expression;
    EXPECT_DOUBLE_EQ(path.moves, wanted.moves) << wanted.expression;
    EXPECT_DOUBLE_EQ(path.work.vector_ops, wanted.vector_ops) << wanted.expression;
    EXPECT_DOUBLE_EQ(path.work.scalar_ops, wanted.scalar_ops) << wanted.expression;
    EXPECT_DOUBLE_EQ(path.work.mads, wanted.mads) << wanted.expression;
}

INSTANTIATE_TEST_SUITE_P(
    Cost, Expressions,
    testing::Values(
        // One add of four components; one interpolant, one constant: no move.
        Case{"a + u", 1.0, 0.0, 1, 0, 4},
        // A second interpolant has to be moved first: 1 + 1.
        Case{"a + b", 2.0, 1.0, 1, 0, 4},
        // Two constants and the interpolant: one multiply-add and one move.
        Case{"a * u + v", 2.0, 1.0, 1, 0, 4},
        // A literal is a constant too.
        Case{"a * u + 3.0", 2.0, 1.0, 1, 0, 4},
        // Modifiers are free: negation, absolute value, saturation, halves and doubles.
        Case{"clamp(-abs(a) * 0.5 + u, 0.0, 1.0)", 1.0, 0.0, 1, 0, 4},
        // dot 1 + reciprocal root 0.5 + product 1, all from one interpolant.
        Case{"normalize(a)", 2.5, 0.0, 2, 1, 9},
        // A scalar: logarithm 0.5, product 0.5, exponential 0.5, and a move out for each distinct source (none).
        Case{"vec4(pow(a.x, u.x))", 1.5, 0.0, 0, 3, 3},
        // Two operations on four components, two constants in each: one move of four.
        Case{"mix(a, u, v)", 3.0, 1.0, 2, 0, 8},
        // sin is one slot a component.
        Case{"vec4(sin(a.x))", 1.0, 0.0, 0, 1, 1},
        // Reciprocal of one component, product of four.
        Case{"a / u.x", 1.5, 0.0, 1, 1, 5},
        // Three components 0.75; the alpha is a constant that is moved out: 0.5.
        Case{"vec4(a.xyz * u.xyz, 1.0)", 1.25, 0.0, 1, 1, 4},
        // Swizzles and constructions rename.
        Case{"vec4(a.wz, a.yx) * u", 1.0, 0.0, 1, 0, 4}));

TEST(ShaderCounts, HalfNormalizeHasItsOwnUnit) {
    const ShaderCounts full = counts_of_expression("vec4(normalize(a.xyz), a.w * u.x)", false);
    const ShaderCounts half = counts_of_expression("vec4(normalize(a.xyz), a.w * u.x)", true);
    // highp: dot 0.75 + reciprocal root 0.5 + product 0.75 = 2; the product of the alpha 0.5.
    EXPECT_DOUBLE_EQ(full.weighted.work.slots, 2.5);
    EXPECT_DOUBLE_EQ(full.weighted.work.normalizes, 0.0);
    EXPECT_DOUBLE_EQ(half.weighted.work.slots, 0.5);
    EXPECT_DOUBLE_EQ(half.weighted.work.normalizes, 1.0);
    // Xenos has fp32 alone: nothing changes.
    EXPECT_DOUBLE_EQ(full.weighted.work.vector_ops, half.weighted.work.vector_ops);
    EXPECT_DOUBLE_EQ(full.weighted.work.scalar_ops, half.weighted.work.scalar_ops);
}

TEST(ShaderCounts, FetchesBySampler) {
    const ShaderCounts counts = counts_of(
        "in vec2 at; uniform sampler2D flat_image; uniform mediump sampler3D volume; uniform samplerCube cube;\n"
        "uniform highp sampler2DShadow depth; out vec4 color;\nvoid main() {\n"
        "  color = texture(flat_image, at) + textureLod(flat_image, at.yx, 0.0) + texture(volume, at.xyy)\n"
        "        + texture(cube, at.xyx) * texture(depth, at.xyx);\n}\n");
    ASSERT_EQ(counts.samplers.size(), 4u);
    double all = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const SamplerUse& use = counts.samplers[i];
        const double fetches = counts.weighted.fetches[i];
        all += fetches;
        if (use.name == "flat_image") {
            EXPECT_DOUBLE_EQ(fetches, 2.0);
            EXPECT_DOUBLE_EQ(counts.weighted.level_fetches[i], 1.0);
        } else if (use.name == "volume") {
            EXPECT_EQ(use.shape, SamplerUse::Shape::volume);
            EXPECT_TRUE(use.half);
        } else if (use.name == "cube") {
            EXPECT_EQ(use.shape, SamplerUse::Shape::cube);
        } else {
            EXPECT_EQ(use.name, "depth");
            EXPECT_TRUE(use.compares);
        }
    }
    EXPECT_DOUBLE_EQ(all, 5.0);
    // Two additions and a multiply-add of four components.
    EXPECT_DOUBLE_EQ(counts.weighted.work.slots, 3.0);
}

TEST(ShaderCounts, BranchesHaveAShortestALongestAndAWeightedWay) {
    // One side fetches and adds (1 slot and 1 fetch), the other does nothing. Comparing costs 0.5 on both.
    const ShaderCounts counts = counts_of(
        "in vec4 a; uniform sampler2D image; uniform vec4 u; out vec4 color;\nvoid main() {\n"
        "  vec4 sum = a * u;\n  if (a.x > u.x) { sum += texture(image, a.xy); sum *= sum; }\n  color = sum;\n}\n");
    EXPECT_EQ(counts.branches, 1);
    EXPECT_DOUBLE_EQ(counts.shortest.work.slots, 1.5);
    EXPECT_DOUBLE_EQ(counts.longest.work.slots, 3.5);
    EXPECT_DOUBLE_EQ(counts.weighted.work.slots, 2.5);
    EXPECT_DOUBLE_EQ(counts.shortest.fetch_count(), 0.0);
    EXPECT_DOUBLE_EQ(counts.longest.fetch_count(), 1.0);
    EXPECT_DOUBLE_EQ(counts.weighted.fetch_count(), 0.5);
    EXPECT_NE(counts.weighting.find("0.5"), std::string::npos);
}

TEST(ShaderCounts, LoopsWithKnownCountsAreUnrolledAndOthersSayWhatIsAssumed) {
    const std::string head =
        "in vec4 a; uniform sampler2D image; uniform int rounds; out vec4 color;\nvoid main() {\n"
        "  vec4 sum = vec4(0.0);\n";
    const ShaderCounts known = counts_of(
        head + "  for (int i = 0; i < 5; i++) sum += texture(image, a.xy * float(i + 1));\n color = sum; }\n");
    EXPECT_DOUBLE_EQ(known.weighted.fetch_count(), 5.0);
    EXPECT_EQ(known.branches, 0);
    EXPECT_TRUE(known.notices.empty());
    const ShaderCounts bounded =
        counts_of(head +
                  "  for (int i = 0; i < 7; i++) { if (i >= rounds) break; sum += texture(image, a.xy * float(i)); }\n"
                  "  color = sum; }\n");
    EXPECT_DOUBLE_EQ(bounded.longest.fetch_count(), 7.0);
    EXPECT_DOUBLE_EQ(bounded.weighted.fetch_count(), 4.0);  // left early: (7 + 1) / 2
    ASSERT_EQ(bounded.notices.size(), 1u);
    EXPECT_NE(bounded.notices[0].find("at most 7 rounds"), std::string::npos) << bounded.notices[0];
    const ShaderCounts open = counts_of(
        head + "  for (int i = 0; i < rounds; i++) sum += texture(image, a.xy * float(i));\n color = sum; }\n");
    EXPECT_DOUBLE_EQ(open.weighted.fetch_count(), kUnknownRounds);
    ASSERT_EQ(open.notices.size(), 1u);
    EXPECT_NE(open.notices[0].find("<test>:4"), std::string::npos) << open.notices[0];
}

TEST(ShaderCounts, TemporariesThatLiveTogether) {
    // Four fetches that all live until the last: four vec4.
    const std::string text =
        "in vec4 a; uniform sampler2D image; out vec4 color;\nvoid main() {\n"
        "  vec4 p = texture(image, a.xy); vec4 q = texture(image, a.yz); vec4 r = texture(image, a.zw);\n"
        "  vec4 s = texture(image, a.wx);\n  color = (p * q + r) * s + p * r + q * s + (p + s) * (q + r);\n}\n";
    EXPECT_EQ(counts_of(text).temporaries.half, 0);
    EXPECT_GE(counts_of(text).temporaries.full, 5);  // the four and a sum
    EXPECT_LE(counts_of(text).temporaries.full, 6);
    const ShaderCounts half = counts_of(text, true);
    EXPECT_EQ(half.temporaries.full, 0);
    EXPECT_EQ(half.temporaries.half, counts_of(text).temporaries.full);
    EXPECT_DOUBLE_EQ(half.temporaries.weighted(), 0.5 * half.temporaries.half);
    // Four scalars share one vector; a triple and a scalar too.
    EXPECT_EQ(counts_of("in vec4 a; uniform vec4 u; out vec4 color;\nvoid main() {\n"
                        "  float p = sin(a.x), q = sin(a.y), r = sin(a.z), s = sin(a.w);\n"
                        "  color = vec4(p, q, r, s);\n}\n")
                  .temporaries.full,
              1);
}

TEST(ShaderCounts, UnrolledHalfStaysHalf) {
    const std::string text =
        "in vec4 a; uniform sampler2D image; out vec4 color;\nvoid main() {\n  vec4 sum = vec4(0.0);\n"
        "  for (int i = 0; i < 4; i++) { vec4 one = texture(image, a.xy * float(i + 1)); sum += one.x > 0.5 ? one : "
        "sum * one; }\n  color = sum;\n}\n";
    const ShaderCounts half = counts_of(text, true);
    EXPECT_EQ(half.temporaries.full, 0);
    EXPECT_GT(half.temporaries.half, 0);
    for (const CountedInstruction& one : half.instructions) {
        EXPECT_TRUE(one.half || (one.what != "fetch" && one.what != "select" && one.what != "multiply")) << one.what;
    }
}

/// `statements` times `one` between a declaration of s and its use. Takes minutes where what is cut up for SPIRV-Tools
/// (spirv_words.h) is not.
ShaderCounts counts_of_many(const std::string& one, int statements) {
    std::string text =
        "in vec4 a; uniform float k; out vec4 color;\nvec3 turned(vec3 p) { vec3 q = sin(p); return q * k; }\n"
        "vec3 either(vec3 p) { if (p.x > k) return p; return p * k; }\nvoid main() {\n  vec4 s = a;\n";
    for (int i = 0; i < statements; ++i) text += one;
    return counts_of(text + "  color = s;\n}\n");
}

TEST(ShaderCounts, ThousandsOfStatementsCountAsManyTimesOne) {
    struct Long {
        const char* statement;
        double slots;  ///< of one
    };
    for (const Long& wanted : {Long{"  s = s * k + a;\n", 1.0},  // a multiply-add
                                                                 // Sines and a product of three components.
                               Long{"  s.xyz = turned(s.xyz);\n", 1.5 * 2.0 * 0.75 + 1.5},
                               Long{"  s.y = s.x * k;\n  s.x = sin(s.y);\n", 1.5}}) {
        // The difference of two lengths, so that what the ends cost falls out.
        const double slots = counts_of_many(wanted.statement, 1500).weighted.work.slots -
                             counts_of_many(wanted.statement, 500).weighted.work.slots;
        EXPECT_DOUBLE_EQ(slots, 1000.0 * wanted.slots) << wanted.statement;
    }
}

TEST(ShaderCounts, CutBlocksKeepTheirWaysAndLines) {
    // Calls on both sides of `&&`, whose value a phi takes from the block that the calls before it end.
    std::string text =
        "in vec4 a; uniform float k; out vec4 color;\nvec3 f(vec3 p) {\n  return sin(p) * k;\n}\n"
        "void main() {\n  vec3 s = a.xyz;\n  if (a.w > k) {\n";
    for (int i = 0; i < 200; ++i) text += "    s = f(s);\n";
    text += "    bool both = s.x > k && f(s).y > k;\n    if (both) discard;\n  }\n  color = vec4(s, 1.0);\n}\n";
    const shader_ir::Module module = module_of(text);
    const ShaderCounts counts = count_shader(module);
    EXPECT_TRUE(counts.discards);
    int sines = 0;
    for (const CountedInstruction& one : counts.instructions) {
        EXPECT_NE(module.place(one.line), "an unknown line") << one.what;
        if (one.what != "sin") continue;
        ++sines;
        EXPECT_EQ(module.place(one.line), "<test>:3");
    }
    EXPECT_EQ(sines, 201);
}

TEST(ShaderCounts, LinesAreThoseOfTheText) {
    const shader_ir::Module module = module_of(
        "in vec4 a; uniform vec4 u; out vec4 color;\nvec4 twice(vec4 x) {\n  return sin(x);\n}\nvoid main() {\n"
        "  vec4 b = a + u;\n  color = twice(b);\n}\n");
    const ShaderCounts counts = count_shader(module);
    ASSERT_EQ(counts.instructions.size(), 2u);
    EXPECT_EQ(counts.instructions[0].what, "add");
    EXPECT_EQ(module.place(counts.instructions[0].line), "<test>:6");
    EXPECT_EQ(counts.instructions[1].what, "sin");
    EXPECT_EQ(module.place(counts.instructions[1].line), "<test>:3");
}

TEST(ShaderCounts, DiscardAndAttributes) {
    const ShaderCounts counts = counts_of(
        "in vec4 a; in vec2 b; in vec3 never; out vec4 color;\nvoid main() {\n"
        "  if (a.x < 0.5) discard;\n  color = a * b.x;\n}\n");
    EXPECT_TRUE(counts.discards);
    EXPECT_EQ(counts.attributes, 2);
    EXPECT_FALSE(counts_of_expression("a").discards);
}

TEST(ShaderCounts, CoIssueIsOneVectorAndOneScalar) {
    EXPECT_DOUBLE_EQ(co_issued({.vector_ops = 4, .scalar_ops = 3}), 4.0);
    EXPECT_DOUBLE_EQ(co_issued({.vector_ops = 4, .scalar_ops = 9}), 7.0);
    EXPECT_DOUBLE_EQ(co_issued({.vector_ops = 0, .scalar_ops = 3}), 2.0);
}

TEST(ShaderCounts, TheCompilerIsNamed) {
    const std::string versions = shader_ir::compiler_versions();
    EXPECT_NE(versions.find("glslang "), std::string::npos) << versions;
    EXPECT_NE(versions.find("SPIRV-Tools"), std::string::npos) << versions;
}

}  // namespace
}  // namespace halfframe::cost
