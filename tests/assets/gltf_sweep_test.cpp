// Draws every glTF file of the asset folders on one ground at every tier it runs: no GL error, the model inside its
// projected box and nowhere else, never blank. expected.json says of each file whether it draws, draws with a notice,
// or is refused; a file that does better than its line says fails too, so that the list stays true.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "engine/error.h"
#include "engine/frame/camera_space.h"
#include "engine/frame/renderer.h"
#include "tests/harness/assets.h"
#include "tests/harness/gl_fixture.h"

namespace halfframe::tests {
namespace {

namespace fs = std::filesystem;

struct Expectation {
    std::string outcome;  ///< draws, notice, error
    std::string says;     ///< words of the notice or the error
};

struct File {
    std::string key;  ///< as in expected.json: "khronos/Box/..." or "assimp/..."
    fs::path path;
};

/// Every glTF file of the asset folders but invalid/, which has a test of its own.
std::vector<File> all_files() {
    std::vector<File> files;
    const auto add = [&](const fs::path& root, const std::string& prefix) {
        if (!fs::exists(root)) return;
        for (const fs::path& path : harness::gltf_files(root))
            files.push_back({prefix + fs::relative(path, root).string(), path});
    };
    if (const auto assets = harness::assets_folder()) {
        add(*assets / "khronos", "khronos/");
        add(*assets / "kaykit", "kaykit/");
    }
    if (const auto models = harness::assimp_models_folder()) add(*models, "assimp/");
    return files;
}

std::map<std::string, Expectation> expectations() {
    std::map<std::string, Expectation> all;
    std::ifstream file(std::string(HALFFRAME_SOURCE_DIR) + "/tests/assets/expected.json");
    const auto document = nlohmann::json::parse(file);
    for (const auto& [key, value] : document.items()) {
        all[key] = {value.at("outcome").get<std::string>(), value.value("says", std::string())};
    }
    return all;
}

constexpr int kWidth = 160, kHeight = 90;

/// Pixels that the scene's box can touch, one pixel wider on each side.
struct Rectangle {
    int left = kWidth, top = kHeight, right = -1, bottom = -1;
};

Rectangle projected(const Box& box, const View& view) {
    Rectangle rectangle;
    const glm::mat4 matrix = clip_from_local(view, glm::mat4(1.0f));
    for (unsigned i = 0; i < 8; ++i) {
        const glm::vec4 clip = matrix * glm::vec4(i & 1u ? box.high.x : box.low.x, i & 2u ? box.high.y : box.low.y,
                                                  i & 4u ? box.high.z : box.low.z, 1.0f);
        const float x = (clip.x / clip.w * 0.5f + 0.5f) * kWidth, y = (0.5f - clip.y / clip.w * 0.5f) * kHeight;
        rectangle.left = std::min(rectangle.left, static_cast<int>(std::floor(x)) - 3);  // 3: points are 4 pixels wide
        rectangle.right = std::max(rectangle.right, static_cast<int>(std::ceil(x)) + 3);
        rectangle.top = std::min(rectangle.top, static_cast<int>(std::floor(y)) - 3);
        rectangle.bottom = std::max(rectangle.bottom, static_cast<int>(std::ceil(y)) + 3);
    }
    return rectangle;
}

/// Pixels that are not the background: inside the rectangle, and outside of it.
std::pair<int, int> counted(const Picture& picture, const Rectangle& rectangle, const std::array<int, 3>& background) {
    int inside = 0, outside = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const std::size_t at = (static_cast<std::size_t>(y) * kWidth + static_cast<std::size_t>(x)) * 4;
            int error = 0;
            for (std::size_t c = 0; c < 3; ++c)
                error = std::max(error, std::abs(int{picture.rgba[at + c]} - background[c]));
            if (error <= 6) continue;  // 6: R11G11B10F and the inverse tone curve move the background by up to 4 codes
            const bool in = x >= rectangle.left && x <= rectangle.right && y >= rectangle.top && y <= rectangle.bottom;
            ++(in ? inside : outside);
        }
    }
    return {inside, outside};
}

class Sweep : public testing::Test {
protected:
    void draw_all(const harness::GroundWish& wish, const std::vector<Tier>& tiers);

private:
    void draw_file(harness::Ground& ground, const Scene& scene, const std::string& key, const std::vector<Tier>& tiers);
    std::map<Tier, std::unique_ptr<Renderer>> renderers_;  ///< one a tier, so that programs are shared between files
};

void Sweep::draw_file(harness::Ground& ground, const Scene& scene, const std::string& key,
                      const std::vector<Tier>& tiers) {
    const Box box = world_box(scene);
    const View view = view_of(camera_framing(box, static_cast<float>(kWidth) / kHeight), kWidth, kHeight);
    const std::array<int, 3> background = {204, 26, 204};
    for (const Tier tier : tiers) {
        auto& renderer = renderers_[tier];
        if (!renderer) renderer = std::make_unique<Renderer>(ground.gl, ground.caps);
        const FramePlan plan = plan_frame(scene, view, {.tier = tier}, ground.caps, all_effects());
        renderer->prepare(scene, plan);
        renderer->draw(view);
        const Picture picture = renderer->read_display();
        EXPECT_EQ(renderer->first_gl_error(), "") << key << ' ' << name(tier);
        const auto [inside, outside] = counted(picture, projected(box, view), background);
        EXPECT_GT(inside, 3) << key << " is blank at tier " << name(tier);
        if (plan.find("bloom")->in) continue;  // a glow leaves the box on purpose
        EXPECT_EQ(outside, 0) << key << " draws outside its box at tier " << name(tier);
    }
}

void Sweep::draw_all(const harness::GroundWish& wish, const std::vector<Tier>& tiers) {
    auto [ground, reason] = harness::make_ground(wish);
    if (!ground) GTEST_SKIP() << reason;
    const std::vector<File> files = all_files();
    if (files.empty()) GTEST_SKIP() << harness::assets_missing() << "; " << harness::assimp_models_missing();
    const auto expected = expectations();
    int drawn = 0, refused = 0, unlisted = 0;
    for (const File& file : files) {
        const auto line = expected.find(file.key);
        std::string outcome, words;
        try {
            Scene scene = content::load_gltf(file.path);
            content::add_studio_rig(scene);
            scene.background = {0.8f, 0.1f, 0.8f};
            for (const std::string& notice : scene.notices) words += notice + "\n";
            outcome = scene.notices.empty() ? "draws" : "notice";
            if (!world_box(scene).empty()) draw_file(*ground, scene, file.key, tiers);
            ++drawn;
        } catch (const Error& error) {
            EXPECT_EQ(error.fault(), Fault::input) << file.key << ": " << error.what();
            EXPECT_NE(std::string(error.what()).find(file.path.filename().string()), std::string::npos)
                << "the file is not named: " << error.what();
            outcome = "error";
            words = error.what();
            ++refused;
        }
        if (line == expected.end()) {
            ++unlisted;
            fmt::print("not in expected.json: \"{}\": {} {}\n", file.key, outcome, words);
            continue;
        }
        EXPECT_EQ(outcome, line->second.outcome) << file.key << ": " << words;
        EXPECT_NE(words.find(line->second.says), std::string::npos)
            << file.key << " says: " << words << "expected: " << line->second.says;
    }
    fmt::print("{} files: {} drawn at {} tiers, {} refused, {} not listed\n", files.size(), drawn, tiers.size(),
               refused, unlisted);
    EXPECT_GT(drawn, 0);
    renderers_.clear();  // before the ground they stand on
}

TEST_F(Sweep, EglEs3) { draw_all({.backend = platform::Backend::egl}, {Tier::low, Tier::console, Tier::reference}); }

TEST_F(Sweep, Es2Minimum) { draw_all({.backend = platform::Backend::egl, .device = "es2-minimum"}, {Tier::low}); }

TEST_F(Sweep, OsMesa) { draw_all({.backend = platform::Backend::osmesa}, {Tier::low, Tier::console, Tier::reference}); }

}  // namespace
}  // namespace halfframe::tests
