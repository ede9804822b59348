// tone_map against the talk's numbers: a light of 1 is 214, a light of 8 is 255; NaN, inf and negatives never reach it.
#include "engine/effects/tone_map/tone_map.h"

#include <gtest/gtest.h>

#include <cmath>

#include <fmt/format.h>

#include "content/content.h"
#include "tests/effects/lit_square.h"
#include "tests/harness/image_compare.h"

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
    const Wishes all[] = {
        {.tier = Tier::low}, {.tier = Tier::console}, {.tier = Tier::console, .storage = gl::PixelFormat::rgba16f}};
    for (Wishes wishes : all) {
        for (const Arithmetic arithmetic : {Arithmetic::half, Arithmetic::full}) {
            wishes.arithmetic = arithmetic;
            const std::string what = fmt::format("{} {}", name(*wishes.tier), name(arithmetic));
            EXPECT_EQ(code(std::numeric_limits<float>::infinity(), wishes), 255) << what;
            EXPECT_EQ(code(-1.0f, wishes), 0) << what;
            EXPECT_EQ(code(std::numeric_limits<float>::quiet_NaN(), wishes), 0) << what;
        }
    }
}

// Where nothing else needs light, each shader maps its own: what the plan chooses is the picture of a float target.
TEST_F(ToneMap, ShowsTheSameWithAndWithoutAPassOfItsOwn) {
    int compared = 0;
    for (const content::BuiltInScene& built_in : content::built_in_scenes()) {
        const Scene scene = built_in.make();
        for (const Arithmetic arithmetic : {Arithmetic::half, Arithmetic::full}) {
            Wishes wishes{.tier = Tier::console, .arithmetic = arithmetic};
            // The edge filter asks whether neighbours differ: a code there may mix a pixel or not.
            wishes.effect_switches = {{"anti_alias", false}};
            for (const Camera& camera : scene.cameras) {
                const View view = view_of(camera, 320, 180);
                wishes.storage.reset();
                if (!holds_display_values(plan_frame(scene, view, wishes, caps(), all_effects()).storage)) continue;
                const Picture chosen =
                    render(scene, view, wishes, all_effects(), harness::FlatPicture::is_expected).picture;
                wishes.storage = gl::PixelFormat::rgba32f;
                const Picture light =
                    render(scene, view, wishes, all_effects(), harness::FlatPicture::is_expected).picture;
                // One code: rounding to 8 bits, and in half three roundings of the curve, 0.4 of a code.
                const harness::ImageTolerance one_code{.max_channel_error = 1, .max_bad_fraction = 1.0};
                EXPECT_TRUE(harness::similar_picture(chosen, light, one_code,
                                                     fmt::format("own_light_{}_{}", built_in.name, name(arithmetic))));
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 10) << "pictures of scenes that store no light";
}

TEST_F(ToneMap, IsAPassOnlyWhereLightIsStored) {
    const Scene scene = glowing(1.0f);
    const auto last_pass = [&](Wishes wishes) {
        wishes.effect_switches = {{"anti_alias", false}};  // it may come after
        return plan(scene, wishes).passes.back().name;
    };
    EXPECT_EQ(last_pass({.tier = Tier::console, .storage = gl::PixelFormat::rgba16f}), "tone_map");
    EXPECT_EQ(last_pass({.tier = Tier::console, .reads_light = true}), "tone_map");
    EXPECT_EQ(last_pass({.tier = Tier::console}), "surface");
    EXPECT_EQ(last_pass({.tier = Tier::low}), "surface");
    EXPECT_EQ(last_pass({.tier = Tier::console, .storage = gl::PixelFormat::rgba8}), "surface");
    EXPECT_FALSE(plan({.name = "nothing"}).find("tone_map")->in);
}

}  // namespace
}  // namespace halfframe::tests
