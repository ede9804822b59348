// transparent sorts far to near, blends by the over operator, leaves depth alone, and costs nothing when nothing
// blends.
#include "engine/effects/transparent/transparent.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "engine/effects/tone_map/tone_map_reference.h"
#include "engine/effects/transparent/transparent_reference.h"
#include "tests/effects/lit_square.h"

namespace halfframe::tests {
namespace {

class Transparent : public harness::GlFixture {};

/// Squares that shine by themselves, so that the answer is arithmetic alone: an opaque one at the back, then `layers`.
struct Layer {
    glm::vec3 light;
    float alpha;
    float z_m;
};
Scene layered(const glm::vec3& back, const std::vector<Layer>& layers) {
    Scene scene = wide_square();
    scene.materials[0].base_color = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
    scene.materials[0].emissive = back;
    for (const Layer& layer : layers) {
        Material material = scene.materials[0];
        material.alpha_mode = AlphaMode::blend;
        material.base_color.a = layer.alpha;
        material.emissive = layer.light;
        scene.materials.push_back(material);
        Surface surface = scene.surfaces[0];
        surface.material = static_cast<int>(scene.materials.size()) - 1;
        surface.world_from_local[3].z = layer.z_m;
        scene.surfaces.push_back(surface);
    }
    return scene;
}

glm::dvec3 over(const glm::dvec3& behind, const std::vector<Layer>& layers) {
    std::vector<reference::BlendedLayer> seen;
    for (const Layer& layer : layers)
        seen.push_back({.light = layer.light, .alpha = layer.alpha, .distance_m = 2.0 - layer.z_m});  // the eye: z = 2
    return reference::seen_through(seen, behind);
}

TEST_F(Transparent, BlendsFarToNearWhateverTheOrderOfTheScene) {
    const glm::vec3 back(0.5f, 0.25f, 0.125f);
    std::vector<Layer> layers = {
        {{0.9f, 0.1f, 0.1f}, 0.5f, 0.25f}, {{0.1f, 0.9f, 0.1f}, 0.25f, 0.5f}, {{0.1f, 0.1f, 0.9f}, 0.75f, 0.75f}};
    const glm::dvec3 expected = over(back, layers);
    std::ranges::sort(layers, {}, &Layer::alpha);  // once more in another order
    for (const auto& order : {layers, std::vector<Layer>(layers.rbegin(), layers.rend())}) {
        for (const Tier tier : {Tier::console, Tier::reference}) {
            for (const Arithmetic arithmetic : {Arithmetic::half, Arithmetic::full}) {
                const FloatPicture picture =
                    scene_color(ground(), layered(back, order), square_view(8, 8), tier, arithmetic);
                const glm::vec3 got = pixel(picture, 4, 4);
                // 1e-3: alpha and light pass through 11 bits each; full gives 2e-7
                const double tolerance = arithmetic == Arithmetic::half ? 1e-3 : 1e-6;
                for (int i = 0; i < 3; ++i)
                    EXPECT_NEAR(got[i], expected[i], tolerance) << name(tier) << " " << name(arithmetic) << " " << i;
            }
        }
    }
    // At low, display values are blended: the same operator over what each layer shows alone.
    const auto shown = [](const glm::vec3& light) {
        glm::vec3 value;
        for (int i = 0; i < 3; ++i) value[i] = static_cast<float>(reference::tone_curve(light[i]));
        return value;
    };
    std::vector<Layer> display = layers;
    for (Layer& layer : display) layer.light = shown(layer.light);
    const glm::dvec3 expected_at_low = over(shown(back), display);
    const Picture low = render(layered(back, layers), square_view(8, 8), {.tier = Tier::low}, all_effects(),
                               harness::FlatPicture::is_expected)
                            .picture;
    for (std::size_t i = 0; i < 3; ++i)  // 2 codes: each of three layers is rounded to 8 bits
        EXPECT_NEAR(low.rgba[(4 * 8 + 4) * 4 + i], 255.0 * expected_at_low[static_cast<int>(i)], 2.0) << i;
    std::vector<Layer> wrong = layers;
    for (Layer& layer : wrong) layer.z_m = -layer.z_m;
    EXPECT_GT(glm::length(over(back, wrong) - expected), 0.1) << "the check cannot tell near to far from far to near";
}

TEST_F(Transparent, APaneBehindAWallIsHiddenAndHidesNothing) {
    // The pane in front writes no depth: what is drawn after it, behind it, would fail otherwise.
    const glm::vec3 back(0.5f);
    const Scene hidden = layered(back, {{{0.0f, 1.0f, 0.0f}, 1.0f, -0.5f}});
    const glm::vec3 got =
        pixel(scene_color(ground(), hidden, square_view(8, 8), Tier::console, Arithmetic::full), 4, 4);
    EXPECT_EQ(got, back);
    const FramePlan frame = plan(hidden);
    for (const Pass& pass : frame.passes) {
        if (pass.effect == "transparent") {
            EXPECT_FALSE(pass.writes_depth);
        }
    }
}

TEST(TransparentPlan, IsCalledForByBlendingAlone) {
    Scene scene = square_scene();
    EXPECT_FALSE(plan(scene).find("transparent")->in);
    EXPECT_EQ(plan(scene).find("transparent")->why, "no surface is translucent");
    scene.materials[0].alpha_mode = AlphaMode::blend;
    const FramePlan frame = plan(scene);
    EXPECT_TRUE(frame.find("transparent")->in);
    EXPECT_FALSE(frame.find("surface")->in) << "nothing is opaque";
    EXPECT_EQ(pass_names(frame), (std::vector<std::string>{"transparent", "tone_map", "anti_alias"}));
    EXPECT_EQ(broken_rule(frame, able_caps()), std::nullopt);
}

}  // namespace
}  // namespace halfframe::tests
