// Programs: errors that name our file and line, uniforms, and the cache in memory and on disk.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "engine/error.h"
#include "engine/gl/call_number.h"
#include "tests/gl/ground.h"
#include "tests/gl/sample_frame.h"

namespace halfframe::gl {
namespace {

constexpr const char* kEs100 = "#ifdef STAGE_FRAGMENT\n#define color gl_FragColor\n#endif\n#define IN attribute\n";
constexpr const char* kEs300 =
    "#ifdef STAGE_FRAGMENT\nlayout(location = 0) out mediump vec4 color;\n#endif\n#define IN in\n";
constexpr ShaderFile kBadFiles[] = {
    {"bad/called.glsl",
     "// A function with a mistake in its third line.\nmediump float called() {\n    return undeclared;\n}\n"},
    {"bad/first.frag", "#include \"bad/called.glsl\"\nvoid main() { color = vec4(called()); }\n"},
    {"bad/second.frag", "#include \"good/good.glsl\"\n\nvoid main() {\n    color = vec4(good()) + vec2(1.0);\n}\n"},
    {"bad/syntax.frag", "#include \"good/good.glsl\"\nvoid main() {\n    color = = vec4(0.0);\n}\n"},
    {"bad/unlinked.frag", "uniform mediump vec4 shared_name;\nvoid main() { color = shared_name; }\n"},
    {"bad/unlinked.vert",
     "IN vec2 position;\nuniform mat4 shared_name;\nvoid main() { gl_Position = shared_name * vec4(position, 0.0, "
     "1.0); }\n"},
    {"dialect/es100.glsl", kEs100},
    {"dialect/es300.glsl", kEs300},
    {"good/good.frag",
     "//@insert_functions\nuniform mediump vec4 tint[2];\nvoid main() {\n    color = tint[1] + tint[0];\n//@insert "
     "color\n}\n"},
    {"good/good.glsl", "mediump float good() {\n    return 1.0;\n}\n"},
    {"good/good.vert", "IN vec2 position;\nvoid main() { gl_Position = vec4(position, 0.0, 1.0); }\n"},
};

ProgramDescription description_of(const char* fragment, Dialect dialect = Dialect::es300) {
    ProgramDescription description;
    description.name = "test";
    description.vertex = "good/good.vert";
    description.fragment = fragment;
    description.dialect = dialect;
    description.defines = {{"VARIANT", "7"}};
    return description;
}

/// A folder that is gone when the test ends.
class ScratchFolder {
public:
    ScratchFolder() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        path_ = std::filesystem::path(HALFFRAME_BINARY_DIR) / "scratch" /
                (std::string(test->name()) + "." + std::to_string(::getpid()));
        std::filesystem::remove_all(path_);
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::vector<std::filesystem::path> files() const {
        std::vector<std::filesystem::path> found;
        if (!std::filesystem::exists(path_)) return found;
        for (const auto& entry : std::filesystem::directory_iterator(path_)) found.push_back(entry.path());
        return found;
    }

private:
    std::filesystem::path path_;
};

std::string content_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::filesystem::path& path, const std::string& content) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << content;
}

class ProgramTest : public GroundTest {
protected:
    std::string error_of(const ProgramDescription& description) {
        ProgramCache cache(gl(), caps(), {}, kBadFiles);
        std::string sentence = sentence_of<Error>([&] { cache.get(description); });
        EXPECT_NE(sentence.find("VARIANT 7"), std::string::npos) << "the variant is not named: " << sentence;
        return sentence;
    }
};

TEST_F(ProgramTest, ErrorsNameOurFileAndLineInBothDialects) {
    for (const Dialect dialect : {Dialect::es100, Dialect::es300}) {
        const std::string in_include = error_of(description_of("bad/first.frag", dialect));
        EXPECT_NE(in_include.find("bad/called.glsl:3"), std::string::npos) << in_include;
        const std::string behind_include = error_of(description_of("bad/second.frag", dialect));
        EXPECT_NE(behind_include.find("bad/second.frag:4"), std::string::npos) << behind_include;
        const std::string syntax = error_of(description_of("bad/syntax.frag", dialect));
        EXPECT_NE(syntax.find("bad/syntax.frag:3"), std::string::npos) << syntax;
        ProgramDescription inserted = description_of("good/good.frag", dialect);
        inserted.insertions = {{"color", nullptr, "color *= 1.0;\ncolor *= nothing;"}};
        const std::string insertion = error_of(inserted);
        EXPECT_NE(insertion.find("<insertion at color: code without a file>:2"), std::string::npos) << insertion;
    }
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(ProgramTest, ALinkErrorNamesBothFiles) {
    ProgramDescription description = description_of("bad/unlinked.frag");
    description.vertex = "bad/unlinked.vert";
    const std::string sentence = error_of(description);
    EXPECT_NE(sentence.find("bad/unlinked.vert"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("shared_name"), std::string::npos) << sentence;
}

TEST_F(ProgramTest, UniformsAreReflectedAndMustBeClaimed) {
    ProgramCache cache(gl(), caps(), {}, kBadFiles);
    Program& program = cache.get(description_of("good/good.frag"));
    ASSERT_EQ(program.uniforms().size(), 1u);
    EXPECT_EQ(program.uniforms()[0].name, "tint");
    EXPECT_EQ(program.uniforms()[0].size, 2);
    EXPECT_EQ(program.uniforms()[0].type, static_cast<std::uint32_t>(GL_FLOAT_VEC4));
    const std::string unclaimed = sentence_of<Mistake>([&] { program.expect_all_uniforms_claimed(); });
    EXPECT_NE(unclaimed.find("tint"), std::string::npos) << unclaimed;
    const std::string unknown = sentence_of<Mistake>([&] { program.uniform("tnit"); });
    EXPECT_NE(unknown.find("tnit"), std::string::npos) << unknown;
    EXPECT_NE(unknown.find("tint"), std::string::npos) << unknown;
    EXPECT_EQ(program.uniform_if_used("tnit"), -1);
    EXPECT_GE(program.uniform("tint"), 0);
    EXPECT_NO_THROW(program.expect_all_uniforms_claimed());
}

TEST_F(ProgramTest, OneTextIsCompiledOnce) {
    ProgramCache cache(gl(), caps(), {}, kBadFiles);
    Program& first = cache.get(description_of("good/good.frag"));
    Program& again = cache.get(description_of("good/good.frag"));
    EXPECT_EQ(&first, &again);
    Program& other_dialect = cache.get(description_of("good/good.frag", Dialect::es100));
    EXPECT_NE(&first, &other_dialect);
    ProgramDescription other_defines = description_of("good/good.frag");
    other_defines.defines = {{"VARIANT", "8"}};
    EXPECT_NE(&first, &cache.get(other_defines));
    ProgramDescription other_attributes = description_of("good/good.frag");
    other_attributes.attributes = {{"position", 3}};
    EXPECT_NE(&first, &cache.get(other_attributes));
    EXPECT_EQ(cache.statistics().compiled, 4);
    EXPECT_EQ(cache.statistics().shared, 1);
    EXPECT_EQ(cache.statistics().from_disk, 0);
    EXPECT_EQ(cache.programs().size(), 4u);
    EXPECT_TRUE(cache.notices().empty());
}

/// As ProgramTest, where the driver gives binaries.
class ProgramDiskTest : public ProgramTest {
protected:
    void SetUp() override {
        ProgramTest::SetUp();
        if (!IsSkipped() && !caps().program_binary)
            GTEST_SKIP() << "this driver gives no program binaries: " << caps().renderer;
    }
    /// What one run of a program with this folder does.
    ProgramCache::Statistics run(const std::filesystem::path& folder) {
        ProgramCache cache(gl(), caps(), folder, sample_files());
        Program& program = cache.get(sample_program(Dialect::es300));
        EXPECT_GE(program.uniform("tint"), 0);
        EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
        EXPECT_TRUE(cache.notices().empty());
        return cache.statistics();
    }
};

TEST_F(ProgramDiskTest, TheSecondRunComesFromDisk) {
    const ScratchFolder folder;
    EXPECT_EQ(run(folder.path()).compiled, 1);
    ASSERT_EQ(folder.files().size(), 1u);
    gl().ledger.clear();
    const ProgramCache::Statistics second = run(folder.path());
    EXPECT_EQ(second.from_disk, 1);
    EXPECT_EQ(second.compiled, 0);
    EXPECT_EQ(gl().ledger.total(number(Call::CompileShader)), 0u);
}

TEST_F(ProgramDiskTest, AFileThatIsNotWholeOrNotOursIsIgnoredAndRewritten) {
    const ScratchFolder folder;
    run(folder.path());
    ASSERT_EQ(folder.files().size(), 1u);
    const std::filesystem::path file = folder.files()[0];
    const std::string good = content_of(file);
    ASSERT_GT(good.size(), 200u);
    std::string flipped = good;
    flipped[flipped.size() - 10] ^= 1;
    std::string other_key = good;
    other_key[8] = 'x';
    std::string other_driver = good;
    other_driver[good.find(caps().renderer)] ^= 1;
    std::string other_magic = good;
    other_magic[0] = 'X';
    for (const std::string& bad : {std::string(), good.substr(0, 20), good.substr(0, good.size() - 1), good + "x",
                                   flipped, other_key, other_driver, other_magic}) {
        write(file, bad);
        gl().ledger.clear();
        const ProgramCache::Statistics statistics = run(folder.path());
        EXPECT_EQ(gl().ledger.total(number(Call::ProgramBinary)), 0u) << "no driver has to survive our bad files";
        EXPECT_EQ(statistics.disk_ignored, 1) << "a file of " << bad.size() << " bytes was used";
        EXPECT_EQ(statistics.compiled, 1);
        EXPECT_EQ(run(folder.path()).from_disk, 1) << "it was not rewritten";
        EXPECT_EQ(folder.files().size(), 1u) << "something was left beside it";
    }
}

TEST_F(ProgramDiskTest, ABinaryThatTheDriverRefusesIsIgnored) {
    const ScratchFolder folder;
    run(folder.path());
    ASSERT_EQ(folder.files().size(), 1u);
    const std::filesystem::path file = folder.files()[0];
    std::string content = content_of(file);
    content[8 + 32 + 3 * 8] ^= 0x55;  // the binary format, behind magic, key and three sizes
    write(file, content);
    const ProgramCache::Statistics statistics = run(folder.path());
    EXPECT_EQ(statistics.disk_ignored, 1);
    EXPECT_EQ(statistics.compiled, 1);
}

TEST_F(ProgramDiskTest, AFolderThatCannotBeWrittenCostsOneNotice) {
    const ScratchFolder folder;
    std::filesystem::create_directories(folder.path());
    const std::filesystem::path blocked = folder.path() / "a file";
    write(blocked, "not a folder");
    for (const std::filesystem::path& path : {blocked / "cache", std::filesystem::path("/proc/halfframe")}) {
        ProgramCache cache(gl(), caps(), path, sample_files());
        EXPECT_GE(cache.get(sample_program(Dialect::es300)).uniform("tint"), 0);
        EXPECT_GE(cache.get(sample_program(Dialect::es100)).uniform("tint"), 0);
        EXPECT_EQ(cache.statistics().compiled, 2);
        ASSERT_EQ(cache.notices().size(), 1u);
        EXPECT_NE(cache.notices()[0].find(path.string()), std::string::npos) << cache.notices()[0];
    }
}

TEST_F(ProgramDiskTest, AFullDiskIsANoticeThatSaysSoAndLeavesNothing) {
    const ScratchFolder folder;
    ProgramCache cache(gl(), caps(), folder.path(), sample_files());
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);  // the write fails instead
    const rlimit small{.rlim_cur = 64, .rlim_max = before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    EXPECT_GE(cache.get(sample_program(Dialect::es300)).uniform("tint"), 0);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, handler);
    ASSERT_EQ(cache.notices().size(), 1u);
    EXPECT_NE(cache.notices()[0].find(std::generic_category().message(EFBIG)), std::string::npos) << cache.notices()[0];
    EXPECT_TRUE(folder.files().empty());
    EXPECT_EQ(run(folder.path()).compiled, 1);
}

TEST_F(ProgramDiskTest, AMaskWithoutBinariesTouchesNoDisk) {
    const ScratchFolder folder;
    Caps poor = caps();
    poor.program_binary = false;
    ProgramCache cache(gl(), poor, folder.path(), sample_files());
    cache.get(sample_program(Dialect::es300));
    EXPECT_TRUE(folder.files().empty());
}

}  // namespace
}  // namespace halfframe::gl
