// What stands above shader functions can be read, and every function of shaders_es says enough.
#include "perf/stability/declaration.h"

#include <gtest/gtest.h>

#include <iostream>

#include "engine/error.h"

namespace halfframe::stability {
namespace {

TEST(Declarations, EveryFunctionOfShadersEsSaysWhatItPromisesOrWhyItIsNotRun) {
    const std::vector<Declaration> functions = all_functions();
    std::size_t covered = 0, not_run = 0;
    for (const Declaration& function : functions) {
        const std::string gap = gap_in(function);
        EXPECT_TRUE(gap.empty()) << gap;
        covered += gap.empty() ? 1 : 0;
        if (function.not_run.empty()) {
            EXPECT_FALSE(function.promises.empty()) << function.place() << " " << function.name << " promises nothing";
        } else {
            ++not_run;
            EXPECT_GT(function.not_run.size(), 10u) << function.place() << ": that is no reason";
        }
        for (const Exemption& one : function.exemptions) EXPECT_GT(one.reason.size(), 7u) << function.place();
    }
    std::cout << "functions covered " << covered << " / " << functions.size() << ", " << not_run << " not run alone\n";
    EXPECT_GT(functions.size(), 50u) << "functions are not found any more";
    EXPECT_LT(not_run, functions.size() / 10);
}

TEST(Declarations, EveryWordThatLooksLikeADefinitionIsFound) {
    // Counted by another rule than the reader's: a line at the left edge that ends a signature with an open brace.
    std::size_t braces = 0;
    for (const gl::ShaderFile& file : gl::shader_files()) {
        std::string line;
        for (const char letter : file.text) {
            if (letter == '\n') {
                const bool definition = line.find(") {") != std::string::npos && line.find('#') != 0 &&
                                        line.find("//") != 0 && line.find("void main") == std::string::npos &&
                                        line[0] != ' ' && line[0] != '}';
                // A signature over two lines ends indented.
                const bool second_line = line.starts_with("        ") && line.ends_with(") {") &&
                                         line.find("for ") == std::string::npos &&
                                         line.find("if ") == std::string::npos;
                braces += definition || second_line ? 1 : 0;
                line.clear();
            } else {
                line += letter;
            }
        }
    }
    EXPECT_EQ(all_functions().size(), braces);
}

TEST(Declarations, AreRead) {
    const std::vector<Declaration> functions = functions_of("a/a.glsl",
                                                            "// A function.\n"
                                                            "//@variant TIER_LOW\n"
                                                            "//@domain x: 0.5..2; n: unit; color: any; where x > 1.0\n"
                                                            "//@promise finite; in -1..1; rising x\n"
                                                            "//@promise error 0.5; where x == 1.0: result == 0.0\n"
                                                            "//@jumps floor(x); fract(n.x)\n"
                                                            "//@exempt half, es_minimum: at most 3 times; it is so\n"
                                                            "FULL float f(FULL float x, vec3 n,\n"
                                                            "             vec4 color) {\n"
                                                            "    return x;\n"
                                                            "}\n"
                                                            "//@domain x: 0..1\n"
                                                            "\n"
                                                            "vec2 g(float x) { return vec2(x); }\n"
                                                            "float declared_only(float x);\n"
                                                            "void main() {}\n");
    ASSERT_EQ(functions.size(), 2u);
    const Declaration& f = functions[0];
    EXPECT_TRUE(f.plain());
    EXPECT_EQ(f.place(), "a/a.glsl:8");
    EXPECT_EQ(f.mangled(), "f(f1;vf3;vf4;");
    EXPECT_TRUE(f.returns_full && f.parameters[0].full && !f.parameters[1].full);
    EXPECT_EQ(f.variants, std::vector<std::string>{"TIER_LOW"});
    EXPECT_EQ(f.parameters[0].domain.high, 2.0);
    EXPECT_EQ(f.parameters[1].domain.kind, Domain::Kind::unit);
    EXPECT_EQ(f.parameters[2].domain.kind, Domain::Kind::any);
    EXPECT_EQ(f.where, "x > 1.0");
    ASSERT_EQ(f.promises.size(), 5u);
    EXPECT_EQ(f.promises[1].low, -1.0);
    EXPECT_EQ(f.promises[3].high, 0.5);
    EXPECT_EQ(f.promises[4].condition, "!(x == 1.0) || (result == 0.0)");
    EXPECT_EQ(f.jumps.size(), 2u);
    ASSERT_NE(f.exemption(shader_ir::Model::es_minimum), nullptr);
    EXPECT_EQ(f.exemption(shader_ir::Model::es_minimum)->at_most, 3.0);
    EXPECT_EQ(f.exemption(shader_ir::Model::half_flushed), nullptr);
    // A blank line parts a comment from a function.
    EXPECT_NE(gap_in(functions[1]).find("says nothing of its parameter 'x'"), std::string::npos);
}

TEST(Declarations, WhatCannotBeReadIsRefusedWithItsPlace) {
    for (const char* line : {"//@domain y: 0..1", "//@domain x: 1..0", "//@domain x: zero..1", "//@domain x: unit",
                             "//@promise rising z", "//@promise in 0-1", "//@exempt half: because", "//@wish x",
                             "//@exempt quarter: at most 2 times; why", "//@not_run", "//@domain x: 0..inf", "//@domain : 0..1",
                             "//@domain light x: 0..1", "//@stage third", "//@writes light"}) {
        try {
            (void)functions_of("a/a.glsl", std::string(line) + "\nfloat f(float x) { return x; }\n");
            ADD_FAILURE() << line << " was read";
        } catch (const Error& error) {
            EXPECT_NE(std::string(error.what()).find("a/a.glsl:2"), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace halfframe::stability
