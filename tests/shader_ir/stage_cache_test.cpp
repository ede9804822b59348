// Compiled stages that are kept in files: found again, or compiled again, and never half of one.
#include "perf/shader_ir/stage_cache.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <iterator>

#include "tests/harness/temporary_folder.h"

namespace halfframe::shader_ir {
namespace {

namespace fs = std::filesystem;

const StageCache::Kept kStage{.inlined = {1, 2, 3}, .optimised = {0xffffffff, 5}};

std::vector<fs::path> files_under(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
        if (entry.is_regular_file()) files.push_back(entry.path());
    }
    return files;
}

TEST(StageCache, FindsWhatWasKeptAndOnlyThat) {
    const harness::TemporaryFolder folder;
    StageCache(folder.path(), "a build").keep("key", kStage);
    const StageCache again(folder.path(), "a build");
    const auto found = again.find("key");
    ASSERT_TRUE(found);
    EXPECT_EQ(found->inlined, kStage.inlined);
    EXPECT_EQ(found->optimised, kStage.optimised);
    EXPECT_FALSE(again.find("another key"));
    EXPECT_FALSE(StageCache(folder.path(), "another build").find("key"));
    EXPECT_EQ(files_under(folder.path()).size(), 1u) << "nothing is left beside it";
}

TEST(StageCache, ABrokenFileIsNone) {
    const harness::TemporaryFolder folder;
    const StageCache cache(folder.path(), "a build");
    cache.keep("key", kStage);
    const fs::path file = files_under(folder.path()).at(0);
    std::ifstream stream(file, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(stream), {}};
    for (std::size_t at = 0; at < whole.size(); ++at) {
        std::string other = whole;
        other[at] = static_cast<char>(other[at] ^ 1);
        std::ofstream(file, std::ios::binary) << other;
        EXPECT_FALSE(cache.find("key")) << "byte " << at << " is another";
        std::ofstream(file, std::ios::binary) << whole.substr(0, at);
        EXPECT_FALSE(cache.find("key")) << "cut at " << at;
    }
    cache.keep("key", kStage);
    EXPECT_TRUE(cache.find("key"));
}

TEST(StageCache, WithoutAFolderNothingIsKeptAndNothingFails) {
    const harness::TemporaryFolder folder;
    const fs::path file = folder.path() / "file";
    std::ofstream(file) << "no folder";
    for (const StageCache& cache : {StageCache(), StageCache(file, "a build")}) {
        cache.keep("key", kStage);
        EXPECT_FALSE(cache.find("key"));
    }
}

TEST(StageCache, FourBuildsAreKept) {
    const harness::TemporaryFolder folder;
    for (int build = 0; build < 7; ++build) {
        for (const fs::directory_entry& older : fs::directory_iterator(folder.path()))
            fs::last_write_time(older, older.last_write_time() - std::chrono::hours(1));
        StageCache(folder.path(), std::to_string(build)).keep("key", kStage);
    }
    EXPECT_EQ(files_under(folder.path()).size(), 4u);
    EXPECT_TRUE(StageCache(folder.path(), "6").find("key"));
}

}  // namespace
}  // namespace halfframe::shader_ir
