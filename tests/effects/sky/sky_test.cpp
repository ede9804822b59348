// sky: the display colours that were asked for come out, whatever the storage; the horizon is where it should be.
#include "engine/effects/sky/sky.h"

#include <gtest/gtest.h>

#include "tests/effects/lit_square.h"
#include "tests/harness/image_compare.h"

namespace halfframe::tests {
namespace {

class SkyTest : public harness::GlFixture {
protected:
    static Scene skies() {
        Scene scene;
        scene.name = "skies";
        scene.sky = Sky{.zenith = {0.2f, 0.3f, 0.9f}, .horizon = {0.8f, 0.6f, 0.4f}, .ground = {0.1f, 0.2f, 0.1f}};
        scene.bloom = Bloom{.strength = 0.0f};  // the blue of the zenith is a light above 1: it would glow
        return scene;
    }
    static View looking(const glm::vec3& target) {
        return view_of(camera_looking({0, 0, 0}, target, 0.8f, Box{}), 33, 33);
    }
    std::array<int, 3> centre(const Scene& scene, const View& view, const Wishes& wishes) {
        const Picture picture = render(scene, view, wishes, all_effects(), harness::FlatPicture::is_expected).picture;
        const std::size_t at = (16u * 33u + 16u) * 4u;
        return {picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]};
    }
};

TEST_F(SkyTest, ShowsTheDisplayColoursItWasGiven) {
    struct Rung {
        Tier tier;
        gl::PixelFormat storage;
        int tolerance;  ///< display codes
    };
    // Half's rounding before and after the curve is under 2 codes; R11G11B10F truncates 6 and 5 bits.
    for (const Rung& rung :
         {Rung{Tier::low, gl::PixelFormat::rgba8, 1}, Rung{Tier::console, gl::PixelFormat::rgba16f, 2},
          Rung{Tier::console, gl::PixelFormat::r11g11b10f, 5}, Rung{Tier::console, gl::PixelFormat::rgb10_a2, 2},
          Rung{Tier::reference, gl::PixelFormat::rgba32f, 1}}) {
        if (!caps().renders[static_cast<std::size_t>(rung.storage)]) continue;
        const Wishes wishes{.tier = rung.tier, .arithmetic = {}, .storage = rung.storage};
        const auto up = centre(skies(), looking({0, 1, 0.001f}), wishes);
        EXPECT_NEAR(up[0], 51, rung.tolerance) << name(rung.storage);
        EXPECT_NEAR(up[1], 76.5, rung.tolerance) << name(rung.storage);
        EXPECT_NEAR(up[2], 229.5, rung.tolerance) << name(rung.storage);
        const auto ahead = centre(skies(), looking({0, 0, -1}), wishes);
        EXPECT_NEAR(ahead[0], 204, rung.tolerance) << name(rung.storage);
        EXPECT_NEAR(ahead[2], 102, rung.tolerance) << name(rung.storage);
        const auto down = centre(skies(), looking({0, -1, 0.001f}), wishes);
        EXPECT_NEAR(down[1], 51, rung.tolerance) << name(rung.storage);
    }
}

TEST_F(SkyTest, IsBehindEverything) {
    Scene scene = wide_square();
    const View view = square_view();
    scene.materials[0].base_color = {0.0f, 0.0f, 0.0f, 1.0f};
    scene.materials[0].metallic = 1.0f;
    const Picture without = render(scene, view, {}, all_effects(), harness::FlatPicture::is_expected).picture;
    scene.sky = Sky{};
    const Picture with = render(scene, view, {}, all_effects(), harness::FlatPicture::is_expected).picture;
    EXPECT_TRUE(harness::same_picture(with, without, "sky_behind"));
}

TEST_F(SkyTest, AnOrthographicEyeSeesOneColour) {
    Camera camera = camera_looking({0, 0, 0}, {0, 0.2f, -1}, 0.8f, Box{});
    camera.orthographic = true;
    const Picture picture =
        render(skies(), view_of(camera, 33, 33), {}, all_effects(), harness::FlatPicture::is_expected).picture;
    EXPECT_EQ(harness::coverage(picture), 0.0);
}

}  // namespace
}  // namespace halfframe::tests
