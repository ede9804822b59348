// The ground of the GL tests: masks are in force, and a blank or wrong picture does not pass.
#include "tests/harness/gl_fixture.h"

#include <gtest/gtest-spi.h>

#include "content/content.h"
#include "tests/harness/image_compare.h"

namespace halfframe::harness {
namespace {

using NativeGround = GlFixture;

class PoorGround : public GlFixture {
protected:
    [[nodiscard]] GroundWish wish() const override { return {.device = "es2-minimum"}; }
};

View view_of_test_room(const Scene& scene) { return view_of(scene.cameras.at(0), 96, 54); }

TEST_F(NativeGround, DrawsTheTestRoomTheSameTwice) {
    const Scene scene = content::open_scene("test_room");
    const Rendered first = render(scene, view_of_test_room(scene));
    const Rendered second = render(scene, view_of_test_room(scene));
    EXPECT_TRUE(same_picture(second.picture, first.picture, "gl_fixture_twice"));
    EXPECT_EQ(first.picture.width, 96);
    EXPECT_EQ(first.picture.height, 54);
}

TEST_F(NativeGround, ABlankPictureIsAFailure) {
    Scene empty;
    empty.name = "empty";
    View view = view_of(Camera{}, 16, 16);
    Ground* ground_here = &ground();
    EXPECT_NONFATAL_FAILURE(static_cast<void>(harness::render(*ground_here, empty, view)), "the picture is blank");
    const Rendered flat = render(empty, view, {}, all_effects(), FlatPicture::is_expected);
    EXPECT_EQ(flat.picture.rgba.size(), 16u * 16u * 4u);
}

TEST_F(PoorGround, TheMaskIsInForce) {
    EXPECT_EQ(caps().es_version, 20);
    EXPECT_EQ(caps().max_fragment_uniform_vectors, 16);
    EXPECT_FALSE(caps().fragment_highp);
    EXPECT_ANY_THROW(gl().BindVertexArray(0)) << "ES 2.0 has no vertex arrays";
    const Scene scene = content::open_scene("test_room");
    EXPECT_EQ(render(scene, view_of_test_room(scene)).plan.tier, Tier::low);
}

TEST(Ground, OneThatCannotStartGivesItsSentence) {
    // A device profile is looked up after the context starts, so a missing context is what is asked for here.
    const char* old = std::getenv("DISPLAY");
    const std::string kept = old != nullptr ? old : "";
    setenv("DISPLAY", ":987", 1);
    unsetenv("WAYLAND_DISPLAY");
    const GroundOrReason made = make_ground({.backend = platform::Backend::glfw});
    if (old != nullptr) {
        setenv("DISPLAY", kept.c_str(), 1);
    } else {
        unsetenv("DISPLAY");
    }
    EXPECT_EQ(made.ground, nullptr);
    EXPECT_GT(made.reason.size(), 20u) << "a whole sentence";
}

}  // namespace
}  // namespace halfframe::harness
