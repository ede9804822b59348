// The cache on disk: what comes out is what went in, or it is made anew. And the built-in environments themselves.
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>
#include <thread>

#include <gtest/gtest.h>
#include <sys/resource.h>

#include "content/content.h"
#include "content/environment/environment_cache.h"
#include "engine/error.h"
#include "tests/content/environment_reference.h"
#include "tests/content/temporary_gltf.h"

namespace halfframe::tests {
namespace {

using content::EnvironmentOptions;
using content::LoadedEnvironment;

std::string read(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
    return files;
}

/// A small file with light from one side, so that it has a notice.
std::string lamp_file(const TemporaryFolder& folder, const char* name, std::uint8_t brightness) {
    std::string bytes = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n";
    for (int i = 0; i < 32; ++i)
        append(bytes, std::vector<std::uint8_t>{brightness, 64, 32, static_cast<std::uint8_t>(i == 9 ? 140 : 120)});
    return folder.write(name, bytes).string();
}

void expect_equal(const LoadedEnvironment& one, const LoadedEnvironment& other) {
    EXPECT_EQ(one.map.name, other.map.name);
    EXPECT_EQ(one.map.size, other.map.size);
    EXPECT_EQ(one.map.levels, other.map.levels);
    EXPECT_EQ(one.map.powers, other.map.powers);
    EXPECT_EQ(one.map.irradiance, other.map.irradiance);
    EXPECT_EQ(one.notices, other.notices);
}

TEST(EnvironmentCache, AHitIsTheMissAgain) {
    const TemporaryFolder folder;
    const std::filesystem::path cache = folder.path() / "deep" / "cache";
    const EnvironmentOptions options{.size = 16, .threads = 1, .cache_folder = cache};
    const std::string file = lamp_file(folder, "lamp.hdr", 200);
    const LoadedEnvironment made = content::environment(file, options);
    EXPECT_FALSE(made.from_cache);
    ASSERT_EQ(made.notices.size(), 1u) << "the window is told";
    EXPECT_EQ(made.map.name, "lamp");
    const LoadedEnvironment kept = content::environment(file, options);
    EXPECT_TRUE(kept.from_cache);
    expect_equal(kept, made);
    expect_equal(content::environment(file, {.size = 16, .threads = 2}), made);
    // Another size, another content: other files.
    EXPECT_FALSE(content::environment(file, {.size = 32, .threads = 1, .cache_folder = cache}).from_cache);
    EXPECT_FALSE(content::environment(lamp_file(folder, "lamp.hdr", 201), options).from_cache);
    EXPECT_EQ(files_in(cache).size(), 3u);
}

TEST(EnvironmentCache, TheSameBytesUnderAnotherNameAreAHit) {
    const TemporaryFolder folder;
    const EnvironmentOptions options{.size = 16, .threads = 1, .cache_folder = folder.path() / "cache"};
    const LoadedEnvironment made = content::environment(lamp_file(folder, "lamp.hdr", 200), options);
    const std::string copy = lamp_file(folder, "copy.hdr", 200);
    const LoadedEnvironment kept = content::environment(copy, options);
    EXPECT_TRUE(kept.from_cache);
    EXPECT_EQ(kept.map.levels, made.map.levels);
    EXPECT_EQ(kept.map.name, "copy");
    ASSERT_EQ(kept.notices.size(), 1u);
    EXPECT_TRUE(kept.notices[0].starts_with(copy + ": ")) << kept.notices[0];
    // The same bytes to be read as something else are another picture, or none.
    EXPECT_ANY_THROW((void)content::environment(lamp_file(folder, "lamp.exr", 200), options));
}

TEST(EnvironmentCache, ABrokenFileIsWrittenAgain) {
    const TemporaryFolder folder;
    const EnvironmentOptions options{.size = 16, .threads = 1, .cache_folder = folder.path() / "cache"};
    const std::string file = lamp_file(folder, "lamp.hdr", 200);
    const LoadedEnvironment made = content::environment(file, options);
    ASSERT_EQ(files_in(options.cache_folder).size(), 1u);
    const std::filesystem::path kept = files_in(options.cache_folder).front();
    const std::string whole = read(kept);
    std::vector<std::string> broken{"", "x", whole.substr(0, 20), whole.substr(0, whole.size() / 2), whole + "x"};
    for (const std::size_t at : {std::size_t{3}, std::size_t{30}, whole.size() / 2, whole.size() - 1}) {
        broken.push_back(whole);
        broken.back()[at] = static_cast<char>(broken.back()[at] ^ 1);
    }
    for (const std::string& bytes : broken) {
        std::ofstream(kept, std::ios::binary | std::ios::trunc) << bytes;
        const LoadedEnvironment again = content::environment(file, options);
        EXPECT_FALSE(again.from_cache);
        expect_equal(again, made);
        EXPECT_EQ(read(kept), whole) << "it is mended on disk";
    }
}

TEST(EnvironmentCache, AFolderThatCannotBeWrittenIsANotice) {
    const TemporaryFolder folder;
    const std::filesystem::path in_the_way = folder.write("cache", "a file, not a folder");
    const std::string file = lamp_file(folder, "lamp.hdr", 200);
    const LoadedEnvironment made = content::environment(file, {.size = 16, .threads = 1, .cache_folder = in_the_way});
    ASSERT_EQ(made.notices.size(), 2u);
    EXPECT_NE(made.notices[1].find("cannot be written"), std::string::npos) << made.notices[1];
    EXPECT_EQ(made.map.levels, content::environment(file, {.size = 16, .threads = 1}).map.levels);
}

TEST(EnvironmentCache, AFullDiskIsANoticeThatSaysSoAndLeavesNothing) {
    const TemporaryFolder folder;
    const std::string file = lamp_file(folder, "lamp.hdr", 200);
    const EnvironmentOptions options{.size = 16, .threads = 1, .cache_folder = folder.path() / "cache"};
    rlimit before{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);  // the write fails instead
    const rlimit small{.rlim_cur = 4096, .rlim_max = before.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const LoadedEnvironment made = content::environment(file, options);
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
    std::signal(SIGXFSZ, handler);
    ASSERT_EQ(made.notices.size(), 2u);
    EXPECT_NE(made.notices[1].find(std::generic_category().message(EFBIG)), std::string::npos) << made.notices[1];
    EXPECT_TRUE(files_in(options.cache_folder).empty());
    expect_equal(content::environment(file, options), content::environment(file, {.size = 16, .threads = 1}));
}

TEST(EnvironmentCache, ThreadsThatKeepTheSameEnvironmentAtOnceDoNotDisturbEachOther) {
    const TemporaryFolder folder;
    const std::string file = lamp_file(folder, "lamp.hdr", 200);
    content::StoredEnvironment stored;
    stored.map = content::environment(file, {.size = 64, .threads = 1}).map;
    const std::filesystem::path kept = folder.path() / "cache" / "one.environment";
    std::array<std::vector<std::string>, 4> notices;
    std::vector<std::thread> threads;
    for (std::vector<std::string>& mine : notices) {
        threads.emplace_back([&] {
            for (int i = 0; i < 20; ++i) {
                if (const auto notice = content::write_cache(kept, stored)) mine.push_back(*notice);
                if (!content::read_cache(kept, 64)) mine.push_back("a file that is not whole");
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    for (const std::vector<std::string>& mine : notices) EXPECT_TRUE(mine.empty()) << mine.front();
    EXPECT_EQ(files_in(kept.parent_path()).size(), 1u);
}

TEST(EnvironmentCache, StoppedWorkLeavesNothing) {
    const TemporaryFolder folder;
    struct Stop {};
    EnvironmentOptions options{.size = 16, .threads = 2, .cache_folder = folder.path() / "cache"};
    options.progress = [](double share) {
        if (share > 0.3) throw Stop();
    };
    EXPECT_THROW((void)content::environment(lamp_file(folder, "lamp.hdr", 200), options), Stop);
    EXPECT_FALSE(std::filesystem::exists(options.cache_folder));
}

TEST(EnvironmentBuiltIn, EachHasLightAndColourWhereItSays) {
    EXPECT_EQ(content::environment_names(), (std::vector<std::string>{"night_sky", "studio"}));
    const EnvironmentMap studio = content::environment("studio", {.size = 64}).map;
    const auto brightness = [](const EnvironmentMap& map, const glm::dvec3& direction) {
        return sampled(map, 0, place_of(glm::normalize(direction))).g;
    };
    // The boxes stand where the studio rig has its lights; the floor between them is dark.
    EXPECT_GT(brightness(studio, {0.45, 0.75, 0.50}), 4.0);
    EXPECT_GT(brightness(studio, {0.55, 0.45, -0.70}), 4.0);
    EXPECT_GT(brightness(studio, {-0.85, 0.25, 0.45}), 0.4);
    EXPECT_LT(brightness(studio, {0.0, -1.0, 0.0}), 0.05);

    const EnvironmentMap night = content::environment("night_sky", {.size = 64}).map;
    double most_red = 0.0;
    double most_blue = 0.0;
    for (const glm::dvec3& direction : even_directions(20000)) {
        const glm::dvec3 light = sampled(night, 0, place_of(direction));
        most_red = std::max(most_red, light.r / light.g);
        most_blue = std::max(most_blue, light.b / light.g);
    }
    EXPECT_GT(most_red, 3.0);
    EXPECT_GT(most_blue, 1.8);
    // Dim and desaturated as a whole.
    const glm::vec3 mean = night.levels.back()[0];
    EXPECT_LT(mean.b, 0.2f);
    EXPECT_LT(mean.b, 2.0f * mean.g);
}

}  // namespace
}  // namespace halfframe::tests
