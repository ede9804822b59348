// A long search that was stopped takes up what it had found, and nothing else.
#include "perf/stability/kept_results.h"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/harness/temporary_folder.h"

namespace halfframe::stability {
namespace {

constexpr Effort kSmall{.combinations = 64, .drawn = 64, .sweeps = 1, .sweep_points = 16};

/// A function of a user's own that overflows in half, with the file that holds it.
struct Own {
    explicit Own(std::string_view body)
        : text("// Mine.\n//@domain x, y: 0..1000\nfloat mine(float x, float y) { return " + std::string(body) +
               "; }\n"),
          files(gl::shader_files().begin(), gl::shader_files().end()) {
        files.push_back({"mine.glsl", text});
        subject.emplace(functions_of("mine.glsl", text).at(0), "TIER_CONSOLE", files);
    }
    Own(const Own&) = delete;
    Own& operator=(const Own&) = delete;
    std::string text;
    std::vector<gl::ShaderFile> files;
    std::optional<Subject> subject;
};

TEST(KeptResults, AreWhatWasFoundToTheBit) {
    const harness::TemporaryFolder folder;
    const Own own("x * y");
    const FunctionStability found = search(*own.subject, kSmall, nullptr);
    ASSERT_GT(found.tallies.at(2).not_finite, 0u) << "an infinity has to survive";
    KeptResults(folder.path(), "here").keep(found, *own.subject, kSmall);
    const auto again = KeptResults(folder.path(), "here").find(*own.subject, kSmall);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->function.name, "mine");
    EXPECT_EQ(again->title, found.title);
    EXPECT_EQ(again->lanes, found.lanes);
    EXPECT_EQ(again->violations, found.violations);
    ASSERT_EQ(again->tallies.size(), found.tallies.size());
    for (std::size_t i = 0; i < found.tallies.size(); ++i) {
        EXPECT_EQ(again->tallies[i].arithmetic, found.tallies[i].arithmetic);
        EXPECT_EQ(again->tallies[i].model, found.tallies[i].model);
        EXPECT_EQ(again->tallies[i].worst.input, found.tallies[i].worst.input);
        EXPECT_EQ(again->tallies[i].worst.ratio, found.tallies[i].worst.ratio);
        EXPECT_EQ(again->tallies[i].holds(), found.tallies[i].holds());
    }
    EXPECT_EQ(again->strip.allowed, found.strip.allowed);
    EXPECT_EQ(again->strip.errors, found.strip.errors);
    EXPECT_EQ(again->steps.size(), found.steps.size());
}

TEST(KeptResults, OfOtherTextEffortOrDriverAreNotTakenUp) {
    const harness::TemporaryFolder folder;
    const Own own("x * y");
    KeptResults(folder.path(), "here").keep(search(*own.subject, kSmall, nullptr), *own.subject, kSmall);
    EXPECT_TRUE(KeptResults(folder.path(), "here").find(*own.subject, kSmall));
    EXPECT_FALSE(KeptResults(folder.path(), "elsewhere").find(*own.subject, kSmall));
    Effort more = kSmall;
    more.drawn *= 2;
    EXPECT_FALSE(KeptResults(folder.path(), "here").find(*own.subject, more));
    const Own other("x + y");
    EXPECT_FALSE(KeptResults(folder.path(), "here").find(*other.subject, kSmall));
    EXPECT_FALSE(KeptResults({}, "here").find(*own.subject, kSmall));
}

TEST(KeptResults, DamagedOnesAreSearchedAgain) {
    const harness::TemporaryFolder folder;
    const Own own("x * y");
    KeptResults(folder.path(), "here").keep(search(*own.subject, kSmall, nullptr), *own.subject, kSmall);
    ASSERT_EQ(folder.names().size(), 1u);
    std::filesystem::resize_file(folder / folder.names()[0], 40);
    EXPECT_FALSE(KeptResults(folder.path(), "here").find(*own.subject, kSmall));
}

TEST(KeptResults, AreGoneWhenTheSearchHasEnded) {
    const harness::TemporaryFolder folder;
    const Own own("x * y");
    const FunctionStability found = search(*own.subject, kSmall, nullptr);
    KeptResults(folder.path(), "here").keep(found, *own.subject, kSmall);
    KeptResults second(folder.path(), "here");
    EXPECT_TRUE(second.find(*own.subject, kSmall));
    second.forget();
    EXPECT_TRUE(folder.names().empty());
}

TEST(KeptResults, AFolderThatCannotBeWrittenStopsNothing) {
    const Own own("x * y");
    const FunctionStability found = search(*own.subject, kSmall, nullptr);
    KeptResults kept("/proc/nowhere", "here");
    EXPECT_NO_THROW(kept.keep(found, *own.subject, kSmall));
    EXPECT_FALSE(kept.find(*own.subject, kSmall));
}

}  // namespace
}  // namespace halfframe::stability
