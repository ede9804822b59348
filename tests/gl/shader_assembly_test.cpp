// Shader assembly: order, includes, insertions, positions, translated logs. No GL.
#include <regex>

#include <gtest/gtest.h>

#include "engine/error.h"
#include "engine/gl/program.h"
#include "tests/gl/ground.h"

namespace halfframe::gl {
namespace {

constexpr ShaderFile kFiles[] = {
    {"a/a.frag",
     "#include \"common/one.glsl\"\n"
     "#include \"common/two.glsl\"\n"
     "//@insert_functions\n"
     "void main() {\n"
     "    float value = two();\n"
     "    //@insert color\n"
     "}\n"},
    {"a/a.vert", "void main() {\n//@insert position\n}\n"},
    {"a/bare.frag", "void main() {\n//@insert bare\n}\n"},
    {"circle/one.glsl", "#include \"circle/two.glsl\"\n"},
    {"circle/two.glsl", "#include \"circle/one.glsl\"\n"},
    {"common/one.glsl", "float one() { return 1.0; }\n"},
    {"common/two.glsl", "#include \"common/one.glsl\"\nfloat two() { return 2.0 * one(); }\n"},
    {"dialect/es100.glsl", "#define DIALECT_100\n"},
    {"dialect/es300.glsl", "#define DIALECT_300\n"},
    {"fog/fog.glsl", "#include \"common/one.glsl\"\nfloat fog() { return one(); }\n"},
    {"bad/circle.frag", "#include \"circle/one.glsl\"\n"},
    {"bad/missing.frag", "\n#include \"no/such.glsl\"\n"},
    {"bad/unquoted.frag", "#include <common/one.glsl>\n"},
    {"branch/branch.frag", "#ifdef NEVER\n#include \"common/two.glsl\"\n#else\nline 4\n#endif\nline 6\n"},
};

ProgramDescription description_of(const char* fragment) {
    ProgramDescription description;
    description.name = "test";
    description.vertex = "a/a.vert";
    description.fragment = fragment;
    return description;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
    return found;
}

/// The pieces are in the text, in this order.
void expect_order(const std::string& text, const std::vector<std::string>& pieces) {
    std::size_t at = 0;
    for (const std::string& piece : pieces) {
        const std::size_t found = text.find(piece, at);
        ASSERT_NE(found, std::string::npos) << "\"" << piece << "\" is missing or out of order in:\n" << text;
        at = found + piece.size();
    }
}

TEST(ShaderAssembly, OrderIsVersionPrecisionDefinesDialectFile) {
    ProgramDescription description = description_of("a/a.frag");
    description.defines = {{"FOG", "3"}};
    const StageText fragment = assemble_stage(description, Stage::fragment, kFiles);
    EXPECT_TRUE(fragment.text.starts_with("#version 300 es\n"));
    expect_order(fragment.text, {"#version 300 es", "precision highp float;", "precision highp sampler2D;",
                                 "#define STAGE_FRAGMENT 1", "#define ARITHMETIC_FULL 1", "#define FRAGMENT_HIGHP 1",
                                 "#define FOG 3", "DIALECT_300", "float one()", "float two()", "void main()"});
    description.dialect = Dialect::es100;
    const StageText vertex = assemble_stage(description, Stage::vertex, kFiles);
    expect_order(vertex.text,
                 {"#version 100\n", "precision highp float;", "#define STAGE_VERTEX 1", "DIALECT_100", "main"});
    EXPECT_EQ(count(vertex.text, "sampler2D"), 0u);
}

TEST(ShaderAssembly, HalfArithmeticIsMediumpInFragmentsOnly) {
    ProgramDescription description = description_of("a/a.frag");
    description.arithmetic = Arithmetic::half;
    description.fragment_highp = false;
    const std::string fragment = assemble_stage(description, Stage::fragment, kFiles).text;
    expect_order(fragment, {"precision mediump float;", "precision mediump int;", "precision mediump sampler2D;",
                            "#define ARITHMETIC_HALF 1"});
    EXPECT_EQ(count(fragment, "highp"), 0u) << "a device without fragment highp rejects the word";
    EXPECT_EQ(count(fragment, "FRAGMENT_HIGHP"), 0u);
    EXPECT_EQ(count(assemble_stage(description, Stage::vertex, kFiles).text, "precision highp float;"), 1u);
}

TEST(ShaderAssembly, FullArithmeticWithoutFragmentHighpIsAMistake) {
    ProgramDescription description = description_of("a/a.frag");
    description.fragment_highp = false;
    EXPECT_THROW((void)assemble_stage(description, Stage::fragment, kFiles), Mistake);
}

TEST(ShaderAssembly, EachFileComesOnce) {
    ProgramDescription description = description_of("a/a.frag");
    description.insertions = {{"color", "fog/fog.glsl", "value *= fog();"},
                              {"color", "fog/fog.glsl", "value += fog();"}};
    const std::string text = assemble_stage(description, Stage::fragment, kFiles).text;
    EXPECT_EQ(count(text, "float one()"), 1u);
    EXPECT_EQ(count(text, "float fog()"), 1u);
}

TEST(ShaderAssembly, InsertionsComeInOrderWithTheirMarker) {
    ProgramDescription description = description_of("a/a.frag");
    description.insertions = {{"color", "fog/fog.glsl", "first();"}, {"color", nullptr, "second();"}};
    const std::string text = assemble_stage(description, Stage::fragment, kFiles).text;
    expect_order(text, {"float fog()", "void main()", "// inserted at color: fog/fog.glsl", "first();",
                        "// inserted at color: code without a file", "second();", "}"});
    EXPECT_EQ(count(text, "//@"), 0u);
}

TEST(ShaderAssembly, AnInsertionLeavesTheOtherStageAlone) {
    ProgramDescription plain = description_of("a/a.frag");
    ProgramDescription widened = plain;
    widened.insertions = {{"color", "fog/fog.glsl", "first();"}};
    EXPECT_EQ(assemble_stage(plain, Stage::vertex, kFiles).text, assemble_stage(widened, Stage::vertex, kFiles).text);
    EXPECT_NE(assemble_stage(plain, Stage::fragment, kFiles).text,
              assemble_stage(widened, Stage::fragment, kFiles).text);
}

TEST(ShaderAssembly, AnUnknownPointIsAMistakeThatListsThePoints) {
    ProgramDescription description = description_of("a/a.frag");
    description.insertions = {{"colour", nullptr, "first();"}};
    const std::string sentence =
        sentence_of<Mistake>([&] { (void)assemble_stage(description, Stage::vertex, kFiles); });
    EXPECT_NE(sentence.find("\"colour\""), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("color"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("position"), std::string::npos) << sentence;
}

TEST(ShaderAssembly, AFileToInsertNeedsItsLine) {
    ProgramDescription description = description_of("a/bare.frag");
    description.insertions = {{"bare", "fog/fog.glsl", "first();"}};
    EXPECT_THROW((void)assemble_stage(description, Stage::fragment, kFiles), Mistake);
}

TEST(ShaderAssembly, BadIncludesAreNamedWithTheirPlace) {
    const auto assemble = [](const char* path) {
        return [path] { (void)assemble_stage(description_of(path), Stage::fragment, kFiles); };
    };
    const std::string circle = sentence_of<Mistake>(assemble("bad/circle.frag"));
    EXPECT_NE(circle.find("circle/one.glsl -> circle/two.glsl -> circle/one.glsl"), std::string::npos) << circle;
    const std::string missing = sentence_of<Error>(assemble("bad/missing.frag"));
    EXPECT_NE(missing.find("bad/missing.frag:2"), std::string::npos) << missing;
    EXPECT_NE(missing.find("no/such.glsl"), std::string::npos) << missing;
    const std::string unquoted = sentence_of<Error>(assemble("bad/unquoted.frag"));
    EXPECT_NE(unquoted.find("bad/unquoted.frag:1"), std::string::npos) << unquoted;
    const std::string absent = sentence_of<Error>(assemble("no/such.frag"));
    EXPECT_NE(absent.find("program \"test\""), std::string::npos) << absent;
}

TEST(ShaderAssembly, PositionsAreRightBehindABranchThatIsSkipped) {
    const StageText stage = assemble_stage(description_of("branch/branch.frag"), Stage::fragment, kFiles);
    const auto index = std::find(stage.files.begin(), stage.files.end(), "branch/branch.frag") - stage.files.begin();
    const auto directive = [&](int line) {
        return "#line " + std::to_string(static_cast<int>(index) * kLinesPerFile + line) + " " + std::to_string(index) +
               "\n";
    };
    expect_order(stage.text, {"#else\n" + directive(4) + "line 4\n#endif\n" + directive(6) + "line 6\n"});
}

TEST(TranslateLog, KnowsThreeDriversWays) {
    StageText stage;
    stage.files = {"<prelude>", "common/one.glsl", "a/a.frag"};
    EXPECT_EQ(translate_log("0:20012(5): error: x\n", stage), "a/a.frag:12(5): error: x\n");
    EXPECT_EQ(translate_log("2(20012) : error C1: x\n", stage), "a/a.frag:12 : error C1: x\n");
    EXPECT_EQ(translate_log("ERROR: 2:10003: 'x' : undeclared\nWARNING: 0:4: y\n", stage),
              "ERROR: common/one.glsl:3: 'x' : undeclared\nWARNING: <prelude>:4: y\n");
}

TEST(TranslateLog, LeavesTheRestAlone) {
    StageText stage;
    stage.files = {"<prelude>"};
    EXPECT_EQ(translate_log("no position 0:3\n12 errors\n0:990001: x\n0(5\n", stage),
              "no position 0:3\n12 errors\n0:990001: x\n0(5\n");
    EXPECT_EQ(translate_log("", stage), "");
}

constexpr ShaderFile kHandingOn[] = {
    {"dialect/es100.glsl", ""},
    {"dialect/es300.glsl", ""},
    {"a.vert", "void main() {\n    gl_Position = vec4(0.0);\n}\n"},
    {"a.frag",
     "FRAGMENT_UNIFORM HALF vec4 color;  // rgb\n"
     "#ifdef TERMS\n"
     "FRAGMENT_UNIFORM FULL vec4 terms[9];\n"
     "#endif\n"
     "uniform HALF vec4 stays;\n"
     "void main() {\n}\n"},
    {"none.frag", "uniform HALF vec4 stays;\nvoid main() {\n}\n"},
};

ProgramDescription handing_on(const char* fragment, Dialect dialect) {
    ProgramDescription description;
    description.name = "test";
    description.vertex = "a.vert";
    description.fragment = fragment;
    description.dialect = dialect;
    description.uniforms_by_vertex = true;
    return description;
}

TEST(UniformsByVertex, TheVertexStageEndsInWhatHandsThemOn) {
    const StageText text = assemble_stage(handing_on("a.frag", Dialect::es300), Stage::vertex, kHandingOn);
    EXPECT_NE(text.text.find("#define UNIFORMS_BY_VERTEX 1"), std::string::npos);
    const std::string end = text.text.substr(text.text.find("void main_of_its_own() {"));
    EXPECT_EQ(end,
              "void main_of_its_own() {\n    gl_Position = vec4(0.0);\n}\n"
              "#line 30001 3\n"
              "uniform highp vec4 handed_on_color;\nflat out highp vec4 color;\n"
              "#ifdef TERMS\n"
              "uniform highp vec4 handed_on_terms[9];\nflat out highp vec4 terms[9];\n"
              "#endif\n"
              "void main() {\nmain_of_its_own();\n"
              "color = handed_on_color;\n"
              "#ifdef TERMS\nterms = handed_on_terms;\n#endif\n"
              "}\n");
    ASSERT_EQ(text.files.size(), 4u);
    EXPECT_EQ(text.files[3], "<uniforms handed on>");
}

TEST(UniformsByVertex, Es100InterpolatesThem) {
    const StageText text = assemble_stage(handing_on("a.frag", Dialect::es100), Stage::vertex, kHandingOn);
    EXPECT_NE(text.text.find("\nvarying highp vec4 color;\n"), std::string::npos);
    EXPECT_EQ(text.text.find("flat"), std::string::npos);
}

TEST(UniformsByVertex, AStageWithoutThemStaysAsItIs) {
    const StageText text = assemble_stage(handing_on("none.frag", Dialect::es300), Stage::vertex, kHandingOn);
    EXPECT_EQ(text.text.find("main_of_its_own"), std::string::npos);
}

}  // namespace
}  // namespace halfframe::gl
