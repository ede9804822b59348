// Where assets are looked for, and that a list of them is complete and in order.
#include "tests/harness/assets.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>
#include <unistd.h>

namespace halfframe::harness {
namespace {

/// Sets HALFFRAME_ASSETS for one test and puts the old value back.
class AssetsVariable {
public:
    explicit AssetsVariable(const std::string& value) {
        if (const char* old = std::getenv("HALFFRAME_ASSETS")) old_ = old;
        setenv("HALFFRAME_ASSETS", value.c_str(), 1);
    }
    ~AssetsVariable() {
        if (old_) {
            setenv("HALFFRAME_ASSETS", old_->c_str(), 1);
        } else {
            unsetenv("HALFFRAME_ASSETS");
        }
    }
    AssetsVariable(const AssetsVariable&) = delete;
    AssetsVariable& operator=(const AssetsVariable&) = delete;

private:
    std::optional<std::string> old_;
};

TEST(Assets, TheVariableLeadsAndAWrongOneIsNamed) {
    const AssetsVariable variable("/no/such/assets");
    EXPECT_FALSE(assets_folder());
    EXPECT_NE(assets_missing().find("/no/such/assets"), std::string::npos);
}

TEST(Assets, ModelsAreFoundAtAnyDepthInOrder) {
    const std::filesystem::path root =
        std::filesystem::temp_directory_path() / ("halfframe_assets_" + std::to_string(getpid()));
    std::filesystem::create_directories(root / "b" / "deep");
    for (const char* file : {"z.glb", "b/deep/a.gltf", "b/a.bin", "b/a.gltf"}) std::ofstream(root / file) << "x";
    const AssetsVariable variable(root.string());
    ASSERT_TRUE(assets_folder());
    const std::vector<std::filesystem::path> expected = {root / "b/a.gltf", root / "b/deep/a.gltf", root / "z.glb"};
    EXPECT_EQ(gltf_files(*assets_folder()), expected);
    std::error_code ignored;
    std::filesystem::remove_all(root, ignored);
}

TEST(Assets, TheModelsOfTheDistributionAreThere) {
    const auto folder = assimp_models_folder();
    if (!folder) GTEST_SKIP() << assimp_models_missing();
    EXPECT_GT(gltf_files(*folder).size(), 20u);
}

}  // namespace
}  // namespace halfframe::harness
