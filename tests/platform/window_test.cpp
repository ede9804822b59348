// GLFW: needs a display, so it is its own program and runs under with_display.sh.
#include "platform/context.h"

#include <gtest/gtest.h>

#include "tests/platform/probe.h"

namespace halfframe::platform {
namespace {

using test::Pixel;
using test::Probe;

TEST(GlfwContext, es_starts_draws_and_swaps) {
    Context context = Context::create({.backend = Backend::glfw, .width = 64, .height = 48});
    EXPECT_EQ(context.backend(), Backend::glfw);
    EXPECT_TRUE(context.description().starts_with("GLFW 3.")) << context.description();
    const Probe probe(context);
    EXPECT_FALSE(probe.desktop()) << probe.version();
    probe.clear(0, 0, 0);
    probe.use(test::kVertex100, test::kFragment100);
    probe.draw_left_half();
    EXPECT_EQ(probe.read(10, 10), test::kOrange);
    EXPECT_EQ(probe.read(50, 10), (Pixel{0, 0, 0, 255}));
    context.swap();
    EXPECT_FALSE(context.should_close());
    EXPECT_EQ(probe.error(), GLenum{GL_NO_ERROR});
    RecordProperty("description", context.description());
}

TEST(GlfwContext, visible_window_starts) {
    Context context = Context::create({.backend = Backend::glfw, .visible = true, .title = "halfframe test"});
    context.swap();
    EXPECT_FALSE(context.should_close());
}

TEST(GlfwContext, desktop_counts_samples_exactly) {
    const Context context = Context::create({.backend = Backend::glfw, .api = Api::desktop});
    const Probe probe(context);
    ASSERT_TRUE(probe.desktop()) << probe.version();
    probe.use(test::kVertex300, test::kFragment300);
    EXPECT_EQ(probe.samples_of_left_half(), GLuint{Probe::kSize * Probe::kSize / 2});
    EXPECT_TRUE(probe.enabled(0x884F)) << "GL_TEXTURE_CUBE_MAP_SEAMLESS";
}

TEST(GlfwContext, takes_turns_with_every_back_end) {
    for (const Backend other : {Backend::egl, Backend::osmesa, Backend::glfw}) {
        Context window = Context::create({.backend = Backend::glfw});
        const Probe window_probe(window);
        window_probe.clear(1, 0, 0);
        {
            Context second = Context::create({.backend = other});
            const Probe second_probe(second);
            second_probe.clear(0, 1, 0);
            for (int turn = 0; turn < 3; ++turn) {
                window.make_current();
                ASSERT_EQ(window_probe.read(5, 5), (Pixel{255, 0, 0, 255}))
                    << second.description() << ", turn " << turn;
                second.make_current();
                ASSERT_EQ(second_probe.read(5, 5), (Pixel{0, 255, 0, 255}))
                    << second.description() << ", turn " << turn;
            }
        }
        window.make_current();
        EXPECT_EQ(window_probe.read(5, 5), (Pixel{255, 0, 0, 255})) << "after the other was destroyed";
    }
}

TEST(GlfwContext, impossible_window_is_a_sentence) {
    try {
        const Context context = Context::create({.backend = Backend::glfw, .width = 0, .height = 0});
        FAIL() << "a window without pixels was made";
    } catch (const ContextError& error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("GLFW cannot start: ")) << error.what();
    }
}

}  // namespace
}  // namespace halfframe::platform
