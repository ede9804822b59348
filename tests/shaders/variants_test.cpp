// Every variant of every card keeps the promise of its tier, to the letter of the language and the smallest device.
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "engine/error.h"
#include "tests/shaders/glslang_gate.h"
#include "tests/shaders/shader_variants.h"

namespace halfframe::shaders {
namespace {

/// Checks all and returns how many there were; a run that checked nothing must not pass. One fault of one file shows in
/// many variants: it is told once, with the number of variants and the first of them.
int check_all(const std::vector<NamedProgram>& programs) {
    std::map<std::string, std::vector<std::string>> variants_of_fault;
    for (const NamedProgram& program : programs) {
        for (const std::string& fault : check_program(texts_of(program)).faults) {
            variants_of_fault[fault.substr(program.name.size() + 2)].push_back(program.name);
        }
    }
    for (const auto& [fault, variants] : variants_of_fault) {
        ADD_FAILURE() << fault << "\n  in " << variants.size() << " variants, first in " << variants.front();
    }
    return static_cast<int>(programs.size());
}

TEST(Variants, EveryLowOneIsPlainEs20) {
    const std::vector<NamedProgram> programs = every_variant(Tier::low);
    for (const NamedProgram& program : programs)
        EXPECT_EQ(program.description.dialect, gl::Dialect::es100) << program.name;
    EXPECT_GE(check_all(programs), 3 * 4) << "four effects in three arithmetics at least";
}

TEST(Variants, EveryConsoleOneIsPlainEs30) {
    const std::vector<NamedProgram> programs = every_variant(Tier::console);
    for (const NamedProgram& program : programs)
        EXPECT_EQ(program.description.dialect, gl::Dialect::es300) << program.name;
    EXPECT_GE(check_all(programs), 2 * 4);
}

TEST(Variants, EveryReferenceOneIsPlainEs30) { EXPECT_GE(check_all(every_variant(Tier::reference)), 2 * 4); }

TEST(Variants, ProgramsWithoutACardAreCheckedToo) { EXPECT_GE(check_all(programs_without_card()), 4); }

TEST(Variants, DefinesAreUnfolded) {
    // The surface shader has the most: what it lists must appear alone, with all others, and missing from all others.
    const EffectCard* surface = find_effect("surface");
    ASSERT_NE(surface, nullptr);
    const std::vector<NamedProgram> programs = every_variant(Tier::low, {&surface, 1});
    std::set<std::size_t> counts;
    std::set<std::string> words;
    for (const NamedProgram& program : programs) {
        counts.insert(program.description.defines.size());
        for (const gl::Define& define : program.description.defines) words.insert(define.first);
    }
    EXPECT_EQ(words.count("NORMAL_MAP"), 1u);
    const std::size_t tier_word = 1;
    const std::size_t all = words.size();  // the tier's own word and every define
    EXPECT_EQ(counts, (std::set<std::size_t>{tier_word, tier_word + 1, all - 1, all}));
}

TEST(Variants, InsertionsOfOtherEffectsAreAmongThem) {
    EXPECT_FALSE(every_insertion_set(Tier::low, all_effects()).empty());
    int with_insertion = 0;
    for (const NamedProgram& program : every_variant(Tier::low)) {
        if (program.description.insertions.empty()) continue;
        ++with_insertion;
        const ProgramTexts texts = texts_of(program);
        for (const gl::Insertion& insertion : program.description.insertions) {
            const bool is_in = texts.fragment.text.find(insertion.code) != std::string::npos ||
                               texts.vertex.text.find(insertion.code) != std::string::npos;
            EXPECT_TRUE(is_in) << program.name << ": " << insertion.code;
        }
    }
    EXPECT_GT(with_insertion, 0);
}

TEST(Variants, NoStageFileIsOutOfReach) {
    EXPECT_EQ(unreached_stage_files(), std::vector<std::string>{});
    // Without its card a stage file that stands beside its pair is still reached, one alone is not.
    const std::vector<std::string> without_cards = unreached_stage_files({});
    for (const gl::ShaderFile& file : gl::shader_files()) {
        const std::string path = file.path;
        if (path.ends_with(".vert") && gl::find_shader_file(path.substr(0, path.size() - 5) + ".frag") != nullptr) {
            EXPECT_EQ(std::count(without_cards.begin(), without_cards.end(), path), 0) << path;
        }
    }
}

TEST(ShaderFiles, EveryFileOfTheRoomIsCompiledIn) {
    const std::filesystem::path room = std::filesystem::path(HALFFRAME_SOURCE_DIR) / "shaders_es";
    std::set<std::string> on_disk;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(room)) {
        const std::string extension = entry.path().extension().string();
        if (extension == ".glsl" || extension == ".vert" || extension == ".frag" || extension == ".h") {
            on_disk.insert(entry.path().lexically_relative(room).generic_string());
        }
    }
    std::set<std::string> compiled_in;
    for (const gl::ShaderFile& file : gl::shader_files()) compiled_in.insert(file.path);
    EXPECT_EQ(compiled_in, on_disk);
}

}  // namespace
}  // namespace halfframe::shaders
