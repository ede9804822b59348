// Holds the repository to its own rules, and shows that each rule can fail.
#include <cstdlib>
#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <unistd.h>

#include "content/content.h"
#include "engine/frame/effect_card.h"
#include "perf/process/child_process.h"
#include "tests/harness/house_rules.h"
#include "tests/harness/temporary_folder.h"

namespace halfframe::harness {
namespace {

const std::vector<SourceFile>& repository() {
    static const std::vector<SourceFile> kFiles = read_tree(HALFFRAME_SOURCE_DIR);
    return kFiles;
}

const SourceFile* find(const std::vector<SourceFile>& files, const std::string& path) {
    for (const SourceFile& file : files) {
        if (file.path == path) return &file;
    }
    return nullptr;
}

void expect_none(const Violations& violations) { EXPECT_TRUE(violations.empty()) << joined(violations); }

/// One violation whose sentence holds `part`.
void expect_one(const Violations& violations, const std::string& part) {
    ASSERT_EQ(violations.size(), 1u) << joined(violations);
    EXPECT_NE(violations[0].find(part), std::string::npos) << violations[0];
}

TEST(ReadTree, FindsTheRoomsAndLeavesOutWhatIsBuilt) {
    EXPECT_NE(find(repository(), "engine/error.h"), nullptr);
    EXPECT_NE(find(repository(), "shaders_es/surface/surface.frag"), nullptr);
    EXPECT_NE(find(repository(), "README.md"), nullptr);
    EXPECT_GT(repository().size(), 60u);

    TemporaryFolder folder;
    folder.write("engine/a.h", "// A.\n");
    folder.write("build/release/b.h", "// Built.\n");
    folder.write(".git/c.md", "hidden\n");
    folder.write("out/d.html", "written\n");
    folder.write("docs/images/e.png", "not text");
    const std::vector<SourceFile> files = read_tree(folder.path());
    ASSERT_EQ(files.size(), 1u);
    EXPECT_EQ(files[0].path, "engine/a.h");
    EXPECT_EQ(files[0].text, "// A.\n");
    EXPECT_EQ(paths_of(folder.path()).count("docs/images/e.png"), 1u);
}

TEST(IncludeDirections, HoldInTheRepository) { expect_none(include_violations(repository())); }

TEST(IncludeDirections, EachForbiddenDirectionIsFound) {
    const std::vector<SourceFile> base = {{"engine/a.h", ""},       {"platform/a.h", ""},
                                          {"content/a.h", ""},      {"perf/a.h", ""},
                                          {"tests/a.h", ""},        {"shaders_es/x/x_limits.h", ""},
                                          {"shaders_es/x/x.h", ""}, {"shaders_es/x/x.glsl", ""}};
    const auto with = [&](const std::string& path, const std::string& text) {
        std::vector<SourceFile> files = base;
        files.push_back({path, text});
        return include_violations(files);
    };
    expect_none(
        with("engine/b.cpp", "#include <vector>\n#include \"engine/a.h\"\n#include \"shaders_es/x/x_limits.h\"\n"));
    expect_none(with("content/b.cpp", "#include \"engine/a.h\"\n#include \"content/a.h\"\n"));
    expect_none(with("perf/b.cpp", "#include \"platform/a.h\"\n#include \"engine/a.h\"\n#include \"content/a.h\"\n"));
    expect_none(with("shaders_es/x/x.frag", "#include \"x/x.glsl\"\n#include \"x/x_limits.h\"\n"));

    expect_one(with("engine/b.cpp", "#include \"platform/a.h\"\n"), "engine/ may not include platform/a.h");
    expect_one(with("engine/b.cpp", "#include <platform/a.h>\n"), "engine/ may not include platform/a.h");
    expect_one(with("engine/b.cpp", "#  include \"content/a.h\"\n"), "engine/ may not include content/a.h");
    expect_one(with("engine/b.cpp", "#include\"perf/a.h\"\n"), "engine/ may not include perf/a.h");
    expect_one(with("engine/b.cpp", "#include \"shaders_es/x/x.h\"\n"), "engine/ may not include shaders_es/x/x.h");
    expect_one(with("platform/b.cpp", "\n\n#include \"engine/a.h\"\n"), "platform/b.cpp:3: platform/ may not include");
    expect_one(with("content/b.cpp", "#include \"platform/a.h\"\n"), "content/ may not include platform/a.h");
    expect_one(with("content/b.cpp", "#include \"perf/a.h\"\n"), "content/ may not include perf/a.h");
    expect_one(with("perf/b.cpp", "#include \"tests/a.h\"\n"), "perf/ may not include tests/a.h");
    expect_one(with("shaders_es/x/y_limits.h", "#include \"x/x_limits.h\"\n"), "includes nothing");
    expect_one(with("shaders_es/x/y.frag", "#include \"engine/a.h\"\n"), "shaders_es has no file engine/a.h");
}

TEST(IncludeDirections, IncludesAreRootedExistAndStartWithTheOwnHeader) {
    expect_one(include_violations({{"engine/b.cpp", "#include \"a.h\"\n"}, {"engine/a.h", ""}}), "not rooted");
    expect_one(include_violations({{"engine/b.cpp", "#include \"engine/gone.h\"\n"}}), "does not exist");
    expect_one(
        include_violations({{"engine/b.cpp", "#include <vector>\n#include \"engine/b.h\"\n"}, {"engine/b.h", ""}}),
        "its own header engine/b.h comes first");
}

TEST(Dialect, WordsOfOneLanguageStayInItsFolder) { expect_none(dialect_violations(repository())); }

TEST(Dialect, EachWordIsFound) {
    const auto in = [](const std::string& line) {
        return dialect_violations({{"shaders_es/x/x.frag", "// texture2D in a comment is no matter\n" + line + "\n"}});
    };
    expect_none(in("vec4 texture2D_like = sample_2d(image, at);  /* gl_FragColor */"));
    expect_one(in("#version 300 es"), "shaders_es/x/x.frag:2: #version");
    expect_one(in("attribute vec3 position;"), "attribute belongs in");
    expect_one(in("varying vec3 position;"), "varying belongs in");
    expect_one(in("vec4 c = texture2D(image, at);"), "texture2D belongs in");
    expect_one(in("vec4 c = texture(image, at);"), "texture belongs in");
    expect_one(in("gl_FragColor = vec4(0.0);"), "gl_FragColor belongs in");
    expect_none(dialect_violations({{"shaders_es/dialect/es100.glsl", "#define sample_2d texture2D\n"}}));
}

TEST(Precision, EachFullAndHighpHasItsReason) { expect_none(precision_violations(repository())); }

TEST(Precision, EachWithoutIsFound) {
    const auto in = [](const std::string& path, const std::string& text) {
        return precision_violations({{"shaders_es/" + path, text}});
    };
    expect_one(in("a/a.glsl", "// A.\nFULL float f(float x);\n"), "shaders_es/a/a.glsl:2");
    expect_one(in("a/a.frag", "// A.\nuniform highp vec4 x;  // metres\n"), "a.frag:2");
    expect_one(in("a/a.frag", "// FULL: metres.\nFULL vec3 a;\n\nFULL vec3 b;\n"), "a.frag:4");
    expect_one(in("a/a.frag", "FULL vec3 a;\n// FULL: too late.\nFULL vec3 b;\n"), "a.frag:1");
    expect_one(in("a/a.frag", "//@domain highp vec4 x: 0..1\nFULL vec3 a;\n"), "a.frag:2");
    expect_one(in("a/a.vert", "// A.\nuniform highp mat4 m;\nVERTEX_OUT FULL vec3 at;\n"), "a.vert:3");
    expect_one(in("a/a.glsl", "// Vertex stage: a.\nhighp vec3 x;\nVERTEX_OUT FULL vec3 at;\n"), "a.glsl:3");
    expect_none(
        in("a/a.frag",
           "FULL vec3 a;  // FULL: metres\n// FULL: a uv.\nFULL float f(FULL vec2 uv) {\n    FULL vec2 x;\n}\n"));
    expect_none(in("a/a.frag", "#define HALF highp\n// highp is a word here\nFULLER x;\n"));
    expect_none(in("dialect/es300.glsl", "precision highp float;\n"));
}

TEST(Screen, EachEffectFitsOne) {
    expect_none(screen_violations(repository()));
    std::string long_text;
    for (int line = 0; line < 69; ++line) long_text += "\n";
    expect_none(screen_violations(
        {{"engine/effects/a/README.md", long_text + "a\n"}, {"engine/README.md", long_text + long_text}}));
    expect_one(screen_violations({{"engine/effects/a/README.md", long_text + std::string(121, 'a') + "\n"}}),
               "71 rows");
}

TEST(Length, FilesAreShortOrSayWhyNot) {
    expect_none(length_violations(repository()));
    std::string body;
    for (int line = 0; line < 601; ++line) body += "int x;\n";
    expect_one(length_violations({{"engine/a.cpp", "// A.\n" + body}}), "602 lines, over 600");
    expect_one(length_violations({{"shaders_es/a.frag", "// A.\n" + body.substr(0, 240 * 7)}}), "241 lines, over 240");
    expect_none(
        length_violations({{"engine/a.cpp", "// A. It is one file because the table must be seen whole.\n" + body}}));
    expect_one(length_violations(
                   {{"engine/a.cpp", "// A.\nint b;  // one file because it is not the first comment\n" + body}}),
               "603 lines");
}

TEST(FirstLine, SaysWhatTheFileIs) {
    expect_none(first_line_violations(repository()));
    expect_one(first_line_violations({{"engine/a.h", "#pragma once\n"}}), "engine/a.h:1");
    expect_one(first_line_violations({{"shaders_es/a.glsl", "//\nfloat x;\n"}}), "shaders_es/a.glsl:1");
    expect_none(first_line_violations({{"engine/a.h", "// What a thing is.\n#pragma once\n"}}));
}

TEST(Folders, TestsShareNone) {
    expect_none(shared_folder_violations(repository()));
    expect_one(
        shared_folder_violations({{"tests/a_test.cpp", std::string("// A.\nauto f = testing::Temp") + "Dir();\n"}}),
        "tests/a_test.cpp:2");
}

TEST(Words, TextSpeaksOfTheProjectAlone) { expect_none(word_violations(repository())); }

TEST(Words, EachKindIsFound) {
    const auto in = [](const std::string& text) { return word_violations({{"engine/a.h", "// A.\n" + text + "\n"}}); };
    expect_one(in(std::string("// TO") + "DO: later"), "engine/a.h:2");
    expect_one(in(std::string("// FIX") + "ME"), "does not belong");
    expect_one(in(std::string("path = \"/wo") + "rk/main\""), "does not belong");
    expect_one(in(std::string("// the Age") + "nt wrote this"), "does not belong");
    expect_one(in(std::string("// in this sess") + "ion"), "does not belong");
    expect_none(in("// a magenta reagent, obsession, and the workplace"));
}

TEST(Links, OfEveryDocumentLeadSomewhere) {
    expect_none(link_violations(repository(), paths_of(HALFFRAME_SOURCE_DIR)));
}

TEST(Links, ADeadOneIsFound) {
    const std::set<std::string> paths = {"README.md", "engine", "engine/README.md", "docs/a.png"};
    const auto in = [&](const std::string& text) { return link_violations({{"engine/README.md", text}}, paths); };
    expect_none(
        in("[up](../README.md#title) [here](#here) [room](../engine/) ![a](../docs/a.png) [web](https://a.b/c)\n"));
    expect_one(in("text\n[gone](gone.md)\n"), "engine/README.md:2: the link leads nowhere: gone.md");
    expect_one(in("[a](../README.md) and [b](../engine/gone/README.md \"title\")\n"), "gone");
}

/// False for a card whose every program is made of another effect's files.
bool has_own_shaders(const EffectCard& card) {
    const std::string folder = std::string(card.name) + "/";
    for (const TierCard& tier : card.tiers) {
        for (const ShaderVariant& variant : tier.shaders) {
            if (variant.vertex.starts_with(folder) || variant.fragment.starts_with(folder)) return true;
        }
        if (tier.shaders.empty()) return true;  // insertions live in a folder of their own too
    }
    return false;
}

TEST(Cards, EveryEffectHasAllItsParts) {
    std::vector<CardNames> cards;
    for (const EffectCard* card : all_effects())
        cards.push_back({std::string(card->name), std::string(card->budget_row), has_own_shaders(*card)});
    ASSERT_FALSE(cards.empty());
    std::set<std::string> rows;
    for (const BudgetRow& row : content::budget("ps3_30fps").rows) rows.insert(row.name);
    expect_none(card_violations(cards, paths_of(HALFFRAME_SOURCE_DIR), rows));
}

TEST(Cards, EachMissingPartIsFound) {
    const std::set<std::string> whole = {"engine/effects/fog", "engine/effects/fog/fog.h",
                                         "engine/effects/fog/README.md", "shaders_es/fog", "tests/effects/fog"};
    expect_none(card_violations({{"fog", "fog"}}, whole, {"fog"}));
    expect_one(card_violations({{"fog", "fog"}}, whole, {"rain"}), "the budget has no row \"fog\"");
    for (const std::string& part : whole) {
        std::set<std::string> less = whole;
        less.erase(part);
        expect_one(card_violations({{"fog", "fog"}}, less, {"fog"}), part + " is missing");
    }
    std::set<std::string> borrows = whole;
    borrows.erase("shaders_es/fog");
    expect_none(card_violations({{"fog", "fog", false}}, borrows, {"fog"}));
}

TEST(Readme, ItsCommandTableIsReadRightly) {
    const std::string readme =
        "# Name\n## Commands\n\n| command | does |\n|---|---|\n| `halfframe render SCENE` | draws |\n"
        "| `plan` | plans |\n\n## Other\n| `halfframe no` | x |\n|---|---|\n| `halfframe never` | x |\n";
    EXPECT_EQ(commands_of_readme(readme), (std::vector<std::string>{"render", "plan"}));
    const std::string help =
        "Usage: halfframe [OPTIONS] SUBCOMMAND\n\nOptions:\n  -h,--help   Print\n\nSubcommands:\n"
        "  render                      Draws a scene\n                              further\n"
        "  plan                        Plans\n\nExit codes:\n  0 done\n";
    EXPECT_EQ(commands_of_help(help), (std::vector<std::string>{"render", "plan"}));
}

TEST(Readme, ItsCommandTableIsThatOfTheCommand) {
    const std::filesystem::path command = HALFFRAME_COMMAND;
    if (command.empty() || !std::filesystem::exists(command)) GTEST_SKIP() << "the halfframe command is not built";
    const process::ChildResult help = process::run_child({.arguments = {command.string(), "--help"}});
    ASSERT_EQ(help.exit_code, 0) << help.story();
    const std::vector<std::string> built = commands_of_help(help.output);
    ASSERT_FALSE(built.empty()) << help.story();
    const SourceFile* readme = find(repository(), "README.md");
    ASSERT_NE(readme, nullptr);
    const std::vector<std::string> written = commands_of_readme(readme->text);
    EXPECT_EQ(std::set<std::string>(written.begin(), written.end()), std::set<std::string>(built.begin(), built.end()));
    EXPECT_EQ(written.size(), built.size());
}

}  // namespace
}  // namespace halfframe::harness
