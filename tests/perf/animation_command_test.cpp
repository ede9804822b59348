// --time, --animation, --frames: what the command says and writes of a model that moves.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/harness/assets.h"
#include "tests/perf/child_process.h"

namespace halfframe::test {
namespace {

const std::string kCommand = HALFFRAME_BINARY_DIR "/halfframe";

/// The fox, which has three clips: Survey, Walk, Run.
class AnimationCommand : public ::testing::Test {
protected:
    void SetUp() override {
        const auto folder = harness::assets_folder();
        if (!folder) {
            GTEST_SKIP() << harness::assets_missing();
        }
        const auto files = harness::gltf_files(*folder / "khronos" / "Fox");
        ASSERT_FALSE(files.empty());
        fox_ = files.front().string();
        if (run_child(kCommand, {"info", "--json"}).code == 4) {
            GTEST_SKIP() << "no graphics context here";
        }
    }
    [[nodiscard]] ChildResult render(const std::string& scene, std::vector<std::string> more) const {
        more.insert(more.begin(),
                    {"render", scene, "--size", "48x32", "--cache", "none", "--measure", "0", "--environment", "none"});
        return run_child(kCommand, more);
    }
    std::string fox_;
    TemporaryFolder folder_;
};

TEST_F(AnimationCommand, PlanListsAnimations) {
    const ChildResult result =
        run_child(kCommand, {"plan", fox_, "--json", "--cache", "none", "--environment", "none"});
    ASSERT_EQ(result.code, 0) << result.err;
    const nlohmann::json plan = nlohmann::json::parse(result.out);
    ASSERT_EQ(plan["animations"].size(), 3u);
    EXPECT_EQ(plan["animations"][2]["name"], "Run");
    EXPECT_NEAR(plan["animations"][2]["duration_s"].get<double>(), 1.158, 0.001);
}

TEST_F(AnimationCommand, AMomentIsAnotherPicture) {
    const auto picture = [&](const std::string& name, const std::vector<std::string>& more) {
        std::vector<std::string> all{"-o", (folder_ / name).string()};
        all.insert(all.end(), more.begin(), more.end());
        const ChildResult result = render(fox_, all);
        EXPECT_EQ(result.code, 0) << result.err;
        return file_text(folder_ / name);
    };
    const std::string rest = picture("rest.png", {});
    const std::string run = picture("run.png", {"--animation", "Run", "--time", "0.3"});
    EXPECT_NE(rest, run);
    EXPECT_EQ(run, picture("number.png", {"--animation", "2", "--time", "0.3"})) << "by number as by name";
    EXPECT_NE(run, picture("first.png", {"--time", "0.3"})) << "the first is Survey";
}

TEST_F(AnimationCommand, WritesARowOfPictures) {
    const ChildResult result =
        render(fox_, {"--animation", "Run", "--frames", "3", "--fps", "10", "-o", (folder_ / "fox.png").string()});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_EQ(folder_.names(), (std::vector<std::string>{"fox_0000.png", "fox_0001.png", "fox_0002.png"}));
    EXPECT_NE(file_text(folder_ / "fox_0000.png"), file_text(folder_ / "fox_0002.png"));
}

TEST_F(AnimationCommand, WrongWordsAreUsageErrors) {
    const std::vector<std::pair<std::vector<std::string>, std::string>> cases{
        {{"--animation", "Wlak"}, "did you mean 'Walk'? There are: Survey, Walk, Run"},
        {{"--animation", "3"}, "unknown animation '3'"},
        {{"--time", "inf"}, "--time inf"},
        {{"--frames", "2"}, "-o FILE.png"},
        {{"--frames", "2", "-o", "x.exr"}, "-o FILE.png"},
        {{"--frames", "2", "--fps", "0", "-o", "x.png"}, "--fps 0"},
        {{"--frames", "2", "--ledger", "-o", "x.png"}, "leave out --trace"}};
    for (const auto& [arguments, says] : cases) {
        const ChildResult result = render(fox_, arguments);
        EXPECT_EQ(result.code, 2) << says;
        EXPECT_NE(result.err.find(says), std::string::npos) << result.err;
    }
    const ChildResult still = render("test_room", {"--time", "1"});
    EXPECT_EQ(still.code, 2);
    EXPECT_NE(still.err.find("no animation"), std::string::npos) << still.err;
}

}  // namespace
}  // namespace halfframe::test
