// tone_map against the talk's numbers: a light of 1 is 214, a light of 8 is 255; NaN, inf and negatives never reach it.
#include "engine/effects/tone_map/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/effects/lit_square.h"

namespace halfframe::tests {
namespace {

/// An unlit square that emits `light`.
Scene glowing(float light) {
    Scene scene = wide_square();
    scene.meshes[0].normals.clear();
    scene.materials[0].base_color = {light, light, light, 1.0f};
    return scene;
}

class ToneMap : public harness::GlFixture {
protected:
    int code(float light, const Wishes& wishes) {
        const auto rendered =
            render(glowing(light), square_view(16, 16), wishes, all_effects(), harness::FlatPicture::is_expected);
        return rendered.picture.rgba[(8 * 16 + 8) * 4];
    }
};

TEST_F(ToneMap, GivesTheTalksCodes) {
    struct Storage {
        gl::PixelFormat format;
        int codes;  ///< tolerance in display codes
    };
    // RGBA16F: half's rounding at the steep top. R11G11B10F: 6 bits, truncated. RGB10_A2: the square root's ten bits.
    // RGBA8 maps in the shader, so nothing is lost before the curve.
    const Storage storages[] = {{gl::PixelFormat::rgba32f, 1},
                                {gl::PixelFormat::rgba16f, 1},
                                {gl::PixelFormat::r11g11b10f, 2},
                                {gl::PixelFormat::rgb10_a2, 1},
                                {gl::PixelFormat::rgba8, 1}};
    for (const Storage& storage : storages) {
        if (!caps().renders[static_cast<std::size_t>(storage.format)]) continue;
        for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
            for (const Arithmetic arithmetic : {Arithmetic::half, Arithmetic::full}) {
                for (const double light : {0.0, 0.01, 0.1, 0.5, 1.0, 4.0, 8.0, 100.0, 60000.0}) {
                    const double clamped = std::min(light, 8.0);
                    const double expected = 255.0 * 1.0275 * clamped / (clamped + 0.22);
                    EXPECT_NEAR(code(static_cast<float>(light),
                                     {.tier = tier, .arithmetic = arithmetic, .storage = storage.format}),
                                expected, storage.codes)
                        << light << ' ' << name(tier) << ' ' << name(arithmetic) << ' ' << name(storage.format);
                }
            }
        }
    }
}

TEST_F(ToneMap, AnInfiniteOrNegativeLightIsWhiteOrBlack) {
    for (const Tier tier : {Tier::low, Tier::console}) {
        EXPECT_EQ(code(std::numeric_limits<float>::infinity(), {.tier = tier}), 255) << name(tier);
        EXPECT_EQ(code(-1.0f, {.tier = tier}), 0) << name(tier);
        EXPECT_EQ(code(std::numeric_limits<float>::quiet_NaN(), {.tier = tier}), 0) << name(tier);
    }
}

TEST_F(ToneMap, IsAPassOnlyWhereLightIsStored) {
    const Scene scene = glowing(1.0f);
    const auto last_pass = [&](Wishes wishes) {
        wishes.effect_switches = {{"anti_alias", false}};  // it may come after
        return plan(scene, wishes).passes.back().name;
    };
    EXPECT_EQ(last_pass({.tier = Tier::console}), "tone_map");
    EXPECT_EQ(last_pass({.tier = Tier::low}), "surface");
    EXPECT_EQ(last_pass({.tier = Tier::console, .storage = gl::PixelFormat::rgba8}), "surface");
    EXPECT_FALSE(plan({.name = "nothing"}).find("tone_map")->in);
}

}  // namespace
}  // namespace halfframe::tests
