// Makes the context of a test and draws on it.
#include "tests/harness/gl_fixture.h"

#include "content/content.h"
#include "engine/frame/renderer.h"
#include "tests/harness/image_compare.h"

namespace halfframe::harness {

Ground::Ground(const GroundWish& wish)
    : context(platform::Context::create({.backend = wish.backend, .api = wish.api})),
      gl(context.loader()),
      native_caps(gl::read_caps(gl)) {
    caps = wish.device == "native" ? native_caps : gl::masked(native_caps, content::device_profile(wish.device));
    gl.restrict_to(caps);
}

GroundOrReason make_ground(const GroundWish& wish) {
    try {
        return {std::make_unique<Ground>(wish), {}};
    } catch (const platform::ContextError& error) {
        return {nullptr, error.what()};
    }
}

Rendered render(Ground& ground, const Scene& scene, const View& view, const Wishes& wishes,
                std::span<const EffectCard* const> cards, FlatPicture flat) {
    Rendered result;
    result.plan = plan_frame(scene, view, wishes, ground.caps, cards);
    if (const auto broken = broken_rule(result.plan, ground.caps)) ADD_FAILURE() << scene.name << ": " << *broken;

    Renderer renderer(ground.gl, ground.caps, {.program_cache_folder = {}, .effects = cards});
    renderer.prepare(scene, result.plan);
    renderer.draw(view);
    result.picture = renderer.read_display();
    EXPECT_EQ(renderer.first_gl_error(), "") << scene.name << " on " << ground.context.description();
    if (flat == FlatPicture::is_a_failure) {
        EXPECT_GT(coverage(result.picture), 0.0)
            << scene.name << ": the picture is blank, on " << ground.context.description();
    }
    return result;
}

void GlFixture::SetUp() {
    GroundOrReason made = make_ground(wish());
    if (!made.ground) GTEST_SKIP() << made.reason;
    ground_ = std::move(made.ground);
}

void GlFixture::TearDown() {
    if (!ground_) return;
    // glGetError is 0 after a test that called everything rightly.
    const std::uint32_t error = ground_->gl.GetError();
    EXPECT_EQ(error, 0u) << "a GL error was left behind on " << ground_->context.description();
}

}  // namespace halfframe::harness
