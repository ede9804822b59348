// depth_prepass changes no pixel, is called for by overdraw alone, and writes no colour.
#include "engine/effects/depth_prepass/depth_prepass.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "content/content.h"
#include "tests/effects/lit_square.h"
#include "tests/harness/image_compare.h"

namespace halfframe::tests {
namespace {

class DepthPrepass : public harness::GlFixture {};

TEST_F(DepthPrepass, ChangesNoPixel) {
    const Scene scene = content::open_scene("test_room");
    for (const Camera& camera : scene.cameras) {
        const View view = view_of(camera, 320, 180);
        for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
            const auto off = render(scene, view, {.tier = tier, .effect_switches = {{"depth_prepass", false}}});
            const auto on = render(scene, view, {.tier = tier, .effect_switches = {{"depth_prepass", true}}});
            ASSERT_EQ(std::ranges::count(on.plan.passes, "depth_prepass", &Pass::name), 1);
            EXPECT_TRUE(harness::same_picture(on.picture, off.picture, std::string("prepass_") + name(tier)));
        }
    }
}

TEST_F(DepthPrepass, IsCalledForByOverdraw) {
    Scene scene = wide_square();
    const View view = square_view();
    EXPECT_NEAR(opaque_cover(scene, view), 1.0, 1e-6) << "one square over the whole picture";
    EXPECT_FALSE(plan(scene).find("depth_prepass")->in);
    for (int i = 0; i < 3; ++i) scene.surfaces.push_back(scene.surfaces[0]);
    EXPECT_NEAR(opaque_cover(scene, view), 4.0, 1e-6);
    EXPECT_TRUE(plan(scene).find("depth_prepass")->in);
    EXPECT_NE(plan(scene).find("depth_prepass")->why.find("4.0 times"), std::string::npos);
    scene.materials[0].alpha_mode = AlphaMode::blend;
    EXPECT_EQ(opaque_cover(scene, view), 0.0) << "translucents hide nothing";
}

}  // namespace
}  // namespace halfframe::tests
