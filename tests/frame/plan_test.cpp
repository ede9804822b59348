// plan_frame() as a pure function: which effects, which passes, which formats, and why.
#include <gtest/gtest.h>

#include "engine/error.h"
#include "tests/frame/planning.h"

namespace halfframe::tests {
namespace {

using gl::PixelFormat;
using Names = std::vector<std::string>;

std::string refusal(const Scene& scene, const Wishes& wishes, const gl::Caps& caps = able_caps()) {
    try {
        (void)plan(scene, wishes, caps);
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::usage);
        return error.what();
    }
    ADD_FAILURE() << "the wish was not refused";
    return {};
}

/// The square with a pane before it, which blends.
Scene blended_scene() {
    Scene scene = square_scene();
    scene.materials.push_back({.alpha_mode = AlphaMode::blend});
    scene.surfaces.push_back(
        {.name = "pane", .mesh = 0, .material = 1, .world_from_local = glm::mat4(1.0f), .dynamic = false});
    return scene;
}

TEST(Plan, DrawsLightThenMapsItWhereLightIsStored) {
    const FramePlan frame = plan(square_scene(), {.storage = PixelFormat::rgba16f});
    EXPECT_EQ(pass_names(frame), (Names{"surface", "tone_map", "anti_alias"}));
    EXPECT_EQ(frame.storage, PixelFormat::rgba16f);
    EXPECT_EQ(frame.passes[0].start_color, StartAction::clear);
    EXPECT_EQ(frame.passes[0].start_depth, StartAction::clear);
    EXPECT_EQ(frame.passes[1].start_color, StartAction::discard) << "a full-screen pass covers every pixel";
    EXPECT_EQ(frame.targets[static_cast<std::size_t>(frame.display)].name, "display");
    EXPECT_FALSE(broken_rule(frame, able_caps()));
}

TEST(Plan, StoresLightOnlyWhereAPassNeedsIt) {
    struct Case {
        const char* why;  ///< in the sentence of tone_map
        Scene scene;
        Wishes wishes;
        PixelFormat storage;
    };
    Scene glowing = square_scene();
    glowing.bloom = Bloom{};
    Scene sky = square_scene();
    sky.sky = Sky{.zenith = glm::vec3(0.5f), .horizon = glm::vec3(0.5f), .ground = glm::vec3(0.5f)};
    const Case cases[] = {
        {"no pass reads", square_scene(), {}, PixelFormat::rgba8},
        {"no pass reads", sky, {}, PixelFormat::rgba8},
        {"no pass reads", blended_scene(), {.effect_switches = {{"transparent", false}}}, PixelFormat::rgba8},
        {"transparent blends", blended_scene(), {}, PixelFormat::rgba16f},
        {"bloom reads", glowing, {}, PixelFormat::rgba16f},
        {"bloom reads", square_scene(), {.effect_switches = {{"bloom", true}}}, PixelFormat::rgba16f},
        {"read back", square_scene(), {.reads_light = true}, PixelFormat::rgba16f},
        {"by name", square_scene(), {.storage = PixelFormat::rgb10_a2}, PixelFormat::rgb10_a2},
        {"tier reference", square_scene(), {.tier = Tier::reference}, PixelFormat::rgba32f},
        {"tier low", blended_scene(), {.tier = Tier::low}, PixelFormat::rgba8}};
    for (const Case& one : cases) {
        const FramePlan frame = plan(one.scene, one.wishes);
        const EffectDecision& tone_map = *frame.find("tone_map");
        EXPECT_EQ(frame.storage, one.storage) << one.why;
        EXPECT_TRUE(tone_map.in) << one.why;
        EXPECT_NE(tone_map.why.find(one.why), std::string::npos) << tone_map.why;
        EXPECT_EQ(frame.target_index("scene_color") >= 0, one.storage != PixelFormat::rgba8) << one.why;
        EXPECT_EQ(tone_map.insertions.empty(), one.storage != PixelFormat::rgba8) << one.why;
        EXPECT_TRUE(frame.notices.empty()) << one.why << ": " << frame.notices.front();
        EXPECT_FALSE(broken_rule(frame, able_caps())) << one.why;
    }
    gl::Caps caps = able_caps();
    caps.samples.fill(4);
    const Wishes samples{.effect_tiers = {{"anti_alias", Tier::reference}}};
    EXPECT_EQ(plan(square_scene(), samples, caps).storage, PixelFormat::rgba16f) << "samples are averaged as light";
}

TEST(Plan, PutsTheSkyBetweenOpaqueAndTransparent) {
    Scene scene = blended_scene();
    scene.sky = Sky{};
    EXPECT_EQ(pass_names(plan(scene)), (Names{"surface", "sky", "transparent", "tone_map", "anti_alias"}));
    EXPECT_EQ(pass_names(plan(scene, {.tier = Tier::low})), (Names{"surface", "sky", "transparent"}));
}

TEST(Plan, LowStoresDisplayValuesInOneTarget) {
    const FramePlan frame = plan(square_scene(), {.tier = Tier::low});
    EXPECT_EQ(frame.storage, PixelFormat::rgba8);
    EXPECT_EQ(frame.targets.size(), 2u);
    EXPECT_DOUBLE_EQ(frame.bytes_per_pixel(), 6.0) << "RGBA8 and 16-bit depth";
    ASSERT_TRUE(frame.find("tone_map")->in);
    ASSERT_EQ(frame.find("tone_map")->insertions.size(), 1u) << "the surface shader maps its own light";
}

TEST(Plan, TakesTheHighestStorageThatRenders) {
    const Scene scene = blended_scene();
    gl::Caps caps = able_caps();
    EXPECT_EQ(plan(scene, {}, caps).storage, PixelFormat::rgba16f);
    EXPECT_TRUE(plan(scene, {}, caps).notices.empty());
    caps = without(caps, {PixelFormat::rgba32f, PixelFormat::rgba16f});
    EXPECT_EQ(plan(scene, {}, caps).storage, PixelFormat::r11g11b10f);
    EXPECT_EQ(plan(scene, {}, caps).notices.size(), 1u) << "a lower rung is said";
    caps = without(caps, {PixelFormat::r11g11b10f});
    EXPECT_EQ(plan(scene, {}, caps).storage, PixelFormat::rgb10_a2);
    caps = without(caps, {PixelFormat::rgb10_a2});
    EXPECT_EQ(plan(scene, {}, caps).storage, PixelFormat::rgba8);
    EXPECT_EQ(plan(scene, {}, caps).notices.size(), 1u) << "the pane would be blended as light";
    EXPECT_TRUE(plan(square_scene(), {}, caps).notices.empty()) << "nothing here needs light";
    EXPECT_EQ(plan(scene, {.tier = Tier::reference}, able_caps()).storage, PixelFormat::rgba32f);
}

TEST(Plan, BlendsInto32BitFloatsOnlyWhereTheDeviceDoes) {
    gl::Caps caps = able_caps();
    caps.float_blend = false;
    const FramePlan blended = plan(blended_scene(), {.tier = Tier::reference}, caps);
    EXPECT_EQ(blended.storage, PixelFormat::rgba16f);
    EXPECT_NE(blended.why_storage.find("does not blend RGBA32F"), std::string::npos) << blended.why_storage;
    EXPECT_FALSE(broken_rule(blended, caps));
    EXPECT_EQ(plan(square_scene(), {.tier = Tier::reference}, caps).storage, PixelFormat::rgba32f)
        << "nothing here blends";
    EXPECT_EQ(plan(square_scene(), {.census = true}, caps).targets[0].format, PixelFormat::rgba32f);
    for (const Wishes& wishes : {Wishes{.storage = PixelFormat::rgba32f}, Wishes{.census = true}}) {
        const std::string sentence = refusal(blended_scene(), wishes, caps);
        EXPECT_NE(sentence.find("transparent blends into RGBA32F"), std::string::npos) << sentence;
        EXPECT_NE(sentence.find(wishes.census ? "--census" : "--storage rgba16f"), std::string::npos) << sentence;
    }
    EXPECT_TRUE(broken_rule(plan(blended_scene(), {.census = true}), caps));
}

TEST(Plan, ChoosesTheBestTierTheDeviceRuns) {
    EXPECT_EQ(plan(square_scene()).tier, Tier::console);
    EXPECT_EQ(plan(square_scene(), {}, poor_caps()).tier, Tier::low);
    EXPECT_EQ(plan(square_scene(), {}, poor_caps()).arithmetic, Arithmetic::half);
}

TEST(Plan, RefusesWhatTheDeviceCannot) {
    EXPECT_NE(refusal(square_scene(), {.tier = Tier::console}, poor_caps()).find("needs OpenGL ES 3.0"),
              std::string::npos);
    EXPECT_NE(refusal(square_scene(), {.effect_tiers = {{"sky", Tier::reference}}}, poor_caps()).find("ES 3.0"),
              std::string::npos);
    EXPECT_NE(refusal(square_scene(), {.arithmetic = Arithmetic::full}, poor_caps()).find("highp"), std::string::npos);
    EXPECT_NE(refusal(square_scene(), {.storage = PixelFormat::rgba16f}, poor_caps()).find("RGBA16F"),
              std::string::npos);
    EXPECT_NE(refusal(square_scene(), {.effect_tiers = {{"rain_of_frogs", Tier::low}}}).find("rain_of_frogs"),
              std::string::npos);
    EXPECT_NE(refusal(square_scene(), {.census = true}, poor_caps()).find("RGBA32F"), std::string::npos);
}

TEST(Plan, CodeGoesWithTheShadersThatItIsAddedTo) {
    Scene scene = blended_scene();
    scene.environment = EnvironmentMap{};
    const auto tier_of = [&](const Wishes& wishes, const char* effect) {
        return plan(scene, wishes).find(effect)->tier;
    };
    // At low shaders are ES 1.00, and the diffuse light of an environment comes from the vertex stage.
    const Wishes low_surface{.tier = Tier::console, .effect_tiers = {{"surface", Tier::low}}};
    for (const char* effect : {"surface", "transparent", "environment"})
        EXPECT_EQ(tier_of(low_surface, effect), Tier::low) << effect;
    EXPECT_EQ(tier_of(low_surface, "tone_map"), Tier::console) << "it adds the same at every tier, or nothing";
    const Wishes fine_surface{.tier = Tier::low, .effect_tiers = {{"surface", Tier::reference}}};
    EXPECT_EQ(tier_of(fine_surface, "environment"), Tier::reference);
    // What was asked for by name is not changed but refused.
    for (const auto& [surface, environment] : {std::pair{Tier::low, Tier::console}, {Tier::console, Tier::low}}) {
        const Wishes both{.tier = surface, .effect_tiers = {{"environment", environment}}};
        const std::string why = refusal(scene, both);
        EXPECT_NE(why.find("--tier environment="), std::string::npos) << why;
        EXPECT_NE(why.find("--tier surface="), std::string::npos) << why;
    }
    const Wishes apart{.tier = Tier::console, .effect_tiers = {{"transparent", Tier::low}}};
    EXPECT_NE(refusal(scene, apart).find("transparent at low"), std::string::npos);
    scene.surfaces.pop_back();
    EXPECT_EQ(tier_of(apart, "environment"), Tier::console) << "nothing blends, so there is nothing to fit";
    scene.environment.reset();
    EXPECT_EQ(tier_of({.tier = Tier::low, .effect_tiers = {{"surface", Tier::console}}}, "surface"), Tier::console);
}

TEST(Plan, RefusesADevicePoorerThanAnyTier) {
    gl::Caps caps = poor_caps();
    caps.max_fragment_uniform_vectors = 15;
    EXPECT_NE(refusal(square_scene(), {}, caps).find("needs 16 fragment uniform vectors"), std::string::npos);
    caps = able_caps();
    caps.max_fragment_samplers = 12;
    EXPECT_EQ(plan(square_scene(), {}, caps).tier, Tier::low) << "ES 3.0 with fewer than 16 samplers is no ES 3.0";
    EXPECT_NE(refusal(square_scene(), {.tier = Tier::console}, caps).find("16 fragment samplers"), std::string::npos);
}

TEST(Plan, ArithmeticIsFullOnSoftwareAndHalfElsewhere) {
    gl::Caps caps = able_caps();
    EXPECT_EQ(plan(square_scene(), {}, caps).arithmetic, Arithmetic::half);
    caps.software = true;
    EXPECT_EQ(plan(square_scene(), {}, caps).arithmetic, Arithmetic::full);
}

TEST(Plan, EveryEffectSaysWhy) {
    for (const Scene& scene : {square_scene(), Scene{.name = "nothing"}}) {
        const FramePlan frame = plan(scene);
        ASSERT_EQ(frame.effects.size(), all_effects().size());
        for (const EffectDecision& decision : frame.effects) EXPECT_GT(decision.why.size(), 10u) << decision.effect;
    }
}

TEST(Plan, AnEmptySceneIsOneClear) {
    const FramePlan frame = plan({.name = "nothing"});
    EXPECT_EQ(pass_names(frame), Names{"clear"});
    for (const EffectDecision& decision : frame.effects) EXPECT_FALSE(decision.in) << decision.effect;
    EXPECT_DOUBLE_EQ(frame.bytes_per_pixel(), 4.0);
    EXPECT_FALSE(broken_rule(frame, able_caps()));
}

TEST(Plan, ASwitchOverrulesDemandAndSaysSo) {
    Scene scene = square_scene();
    scene.sky = Sky{};
    const FramePlan without_sky = plan(scene, {.effect_switches = {{"sky", false}}});
    EXPECT_FALSE(without_sky.find("sky")->in);
    EXPECT_NE(without_sky.find("sky")->why.find("by hand"), std::string::npos);
    const FramePlan with_prepass = plan(scene, {.effect_switches = {{"depth_prepass", true}}});
    EXPECT_EQ(with_prepass.passes.front().name, "depth_prepass");
    EXPECT_NE(refusal(scene, {.effect_switches = {{"tone_map", false}}}).find("tone_map"), std::string::npos);
}

TEST(Plan, AStorageAskedForByNameMayExceedTheTiersLimitAndSaysSo) {
    const FramePlan frame = plan(square_scene(), {.tier = Tier::low, .storage = PixelFormat::rgba32f});
    EXPECT_FALSE(broken_rule(frame, able_caps()));
    ASSERT_EQ(frame.notices.size(), 1u);
    EXPECT_NE(frame.notices[0].find("22.0 bytes a pixel"), std::string::npos) << frame.notices[0];
}

TEST(Plan, TheCensusMakesEveryColourTargetFloat) {
    const FramePlan frame = plan(blended_scene(), {.census = true});
    for (const Target& target : frame.targets) {
        EXPECT_TRUE(gl::is_depth(target.format) || target.format == PixelFormat::rgba32f) << target.name;
    }
    EXPECT_EQ(frame.storage, PixelFormat::rgba16f) << "the shaders stay those of the frame that is examined";
    EXPECT_EQ(plan(square_scene(), {.census = true}).storage, PixelFormat::rgba16f)
        << "a NaN in light shows, which a shader that maps its own would hide";
}

TEST(Plan, IsTheSameEveryTime) {
    Scene scene = square_scene();
    scene.sky = Sky{};
    const FramePlan a = plan(scene), b = plan(scene);
    EXPECT_EQ(pass_names(a), pass_names(b));
    EXPECT_EQ(a.target_bytes(), b.target_bytes());
    for (std::size_t i = 0; i < a.effects.size(); ++i) EXPECT_EQ(a.effects[i].why, b.effects[i].why);
}

}  // namespace
}  // namespace halfframe::tests
