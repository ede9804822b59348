// One plan gives one picture: EGL ES 3, the desktop GL 4.5 context and OSMesa agree to the bit.
#include <gtest/gtest.h>

#include "content/content.h"
#include "engine/frame/renderer.h"
#include "tests/harness/gl_fixture.h"
#include "tests/harness/image_compare.h"

namespace halfframe::tests {
namespace {

struct Drawn {
    std::string context;
    Picture picture;
};

class Contexts : public testing::TestWithParam<Tier> {};

TEST_P(Contexts, GiveIdenticalPictures) {
    const Scene scene = content::open_scene("test_room");
    const View view = view_of(scene.cameras.at(0), 320, 180);
    const Wishes wishes{.tier = GetParam(),
                        .arithmetic = Arithmetic::full,
                        .storage = GetParam() == Tier::low ? gl::PixelFormat::rgba8 : gl::PixelFormat::rgba16f};
    std::vector<Drawn> drawn;
    std::string missing;
    for (const auto& [backend, api] : {std::pair{platform::Backend::egl, platform::Api::es},
                                       std::pair{platform::Backend::egl, platform::Api::desktop},
                                       std::pair{platform::Backend::osmesa, platform::Api::es}}) {
        auto [ground, reason] = harness::make_ground({.backend = backend, .api = api, .device = "native"});
        if (!ground) {
            missing += reason + "; ";
            continue;
        }
        drawn.push_back({ground->context.description(), harness::render(*ground, scene, view, wishes).picture});
    }
    if (drawn.size() < 2) GTEST_SKIP() << "fewer than two contexts start here: " << missing;
    for (std::size_t i = 1; i < drawn.size(); ++i) {
        EXPECT_TRUE(harness::same_picture(drawn[i].picture, drawn[0].picture,
                                          std::string("contexts_") + name(GetParam()) + std::to_string(i)))
            << drawn[i].context << " against " << drawn[0].context;
    }
    EXPECT_EQ(drawn.size(), 3u) << missing;
}

INSTANTIATE_TEST_SUITE_P(Tiers, Contexts, testing::Values(Tier::low, Tier::console, Tier::reference),
                         [](const auto& tier) { return std::string(name(tier.param)); });

}  // namespace
}  // namespace halfframe::tests
