// Every back end that needs no display: it starts, draws both languages, moves, takes turns, and notices its own loss.
#include "platform/context.h"

#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <ostream>
#include <utility>

#define EGL_NO_X11
#include <EGL/egl.h>
#include <gtest/gtest.h>

#include "platform/implementation.h"
#include "tests/platform/probe.h"

namespace halfframe::platform {
namespace {

using test::Pixel;
using test::Probe;

constexpr GLenum kTextureCubeMapSeamless = 0x884F;  // desktop GL alone has these two switches
constexpr GLenum kProgramPointSize = 0x8642;

struct Kind {
    Backend backend;
    Api api;
    const char* name;
};
void PrintTo(const Kind& kind, std::ostream* out) { *out << kind.name; }

class ContextOf : public testing::TestWithParam<Kind> {
protected:
    static Context create() { return Context::create({.backend = GetParam().backend, .api = GetParam().api}); }
};

INSTANTIATE_TEST_SUITE_P(Backends, ContextOf,
                         testing::Values(Kind{Backend::egl, Api::es, "EglEs"},
                                         Kind{Backend::egl, Api::desktop, "EglDesktop"},
                                         Kind{Backend::osmesa, Api::es, "OsmesaEs"},
                                         Kind{Backend::osmesa, Api::desktop, "OsmesaDesktop"}),
                         [](const auto& kind) { return kind.param.name; });

TEST_P(ContextOf, tells_what_it_is) {
    const Context context = create();
    EXPECT_EQ(context.backend(), GetParam().backend);
    EXPECT_TRUE(context.tried().empty());
    const Probe probe(context);
    EXPECT_NE(context.description().find(probe.version()), std::string::npos) << context.description();
    const bool desktop = GetParam().api == Api::desktop || GetParam().backend == Backend::osmesa;
    EXPECT_EQ(probe.desktop(), desktop) << probe.version();
    RecordProperty("description", context.description());
}

TEST_P(ContextOf, clears_and_reads_back) {
    const Context context = create();
    const Probe probe(context);
    probe.clear(0.2f, 0.4f, 0.6f);
    EXPECT_EQ(probe.read(0, 0), (Pixel{51, 102, 153, 255}));
    EXPECT_EQ(probe.error(), GLenum{GL_NO_ERROR});
}

TEST_P(ContextOf, runs_both_languages) {
    const Context context = create();
    const Probe probe(context);
    for (const bool es3 : {false, true}) {
        probe.clear(0, 0, 0);
        probe.use(es3 ? test::kVertex300 : test::kVertex100, es3 ? test::kFragment300 : test::kFragment100);
        probe.draw_left_half();
        EXPECT_EQ(probe.read(10, 32), es3 ? test::kBlue : test::kOrange);
        EXPECT_EQ(probe.read(40, 32), (Pixel{0, 0, 0, 255}));
    }
    EXPECT_EQ(probe.error(), GLenum{GL_NO_ERROR});
}

TEST_P(ContextOf, desktop_has_what_es_has_always_on) {
    const Context context = create();
    const Probe probe(context);
    if (!probe.desktop()) {
        EXPECT_FALSE(probe.enabled(kTextureCubeMapSeamless));
        EXPECT_EQ(probe.error(), GLenum{GL_INVALID_ENUM}) << "ES knows no such switch";
        return;
    }
    EXPECT_TRUE(probe.enabled(kTextureCubeMapSeamless));
    EXPECT_TRUE(probe.enabled(kProgramPointSize));
}

TEST_P(ContextOf, counts_samples_exactly_on_desktop) {
    const Context context = create();
    const Probe probe(context);
    if (!probe.desktop()) {
        EXPECT_EQ(context.description().find("Core Profile"), std::string::npos);
        return;  // ES has no such query; that is why the desktop context exists
    }
    probe.use(test::kVertex300, test::kFragment300);
    EXPECT_EQ(probe.samples_of_left_half(), GLuint{Probe::kSize * Probe::kSize / 2});
}

TEST_P(ContextOf, survives_a_move_with_its_loader) {
    Context first = create();
    const auto loader = first.loader();
    Context second = std::move(first);
    EXPECT_NE(loader("glClear"), nullptr);
    second.make_current();
    const Probe probe(second);
    probe.clear(1, 0, 0);
    EXPECT_EQ(probe.read(1, 1), (Pixel{255, 0, 0, 255}));

    // Assigning over a live context destroys the old one and leaves the new one usable.
    Context third = create();
    third = std::move(second);
    third.make_current();
    const Probe again(third);
    again.clear(0, 1, 0);
    EXPECT_EQ(again.read(1, 1), (Pixel{0, 255, 0, 255}));
}

TEST_P(ContextOf, swap_and_close_do_nothing_without_a_window) {
    Context context = create();
    context.swap();
    EXPECT_FALSE(context.should_close());
}

TEST_P(ContextOf, comes_and_goes_many_times) {
    for (int i = 0; i < 8; ++i) {
        const Context context = create();
        const Probe probe(context);
        probe.clear(0, 0, 1);
        ASSERT_EQ(probe.read(0, 0), (Pixel{0, 0, 255, 255})) << "round " << i;
    }
}

/// Every pair of kinds lives side by side and keeps its own pixels, whoever was current before.
TEST_P(ContextOf, takes_turns_with_every_other) {
    for (const Kind& other :
         {Kind{Backend::egl, Api::es, ""}, Kind{Backend::egl, Api::desktop, ""}, Kind{Backend::osmesa, Api::es, ""}}) {
        Context a = create();
        const Probe probe_a(a);
        probe_a.clear(1, 0, 0);
        {
            Context b = Context::create({.backend = other.backend, .api = other.api});
            const Probe probe_b(b);
            probe_b.clear(0, 1, 0);
            for (int turn = 0; turn < 3; ++turn) {
                a.make_current();
                ASSERT_EQ(probe_a.read(5, 5), (Pixel{255, 0, 0, 255})) << b.description() << ", turn " << turn;
                b.make_current();
                ASSERT_EQ(probe_b.read(5, 5), (Pixel{0, 255, 0, 255})) << b.description() << ", turn " << turn;
            }
        }
        a.make_current();
        EXPECT_EQ(probe_a.read(5, 5), (Pixel{255, 0, 0, 255})) << "after the other was destroyed";
        EXPECT_EQ(probe_a.error(), GLenum{GL_NO_ERROR});
    }
}

TEST(Context, automatic_takes_egl_first) {
    const Context context = Context::create({});
    EXPECT_EQ(context.backend(), Backend::egl) << context.description();
}

TEST(Context, names_are_those_of_the_command) {
    EXPECT_STREQ(name(Backend::automatic), "auto");
    EXPECT_STREQ(name(Backend::egl), "egl");
    EXPECT_STREQ(name(Backend::osmesa), "osmesa");
    EXPECT_STREQ(name(Backend::glfw), "glfw");
}

TEST(EglContext, starts_from_a_device) {
    std::unique_ptr<Context::Implementation> context;
    try {
        context = start_egl({}, EglRoute::device);
    } catch (const ContextError& error) {
        GTEST_SKIP() << error.what();
    }
    EXPECT_NE(context->summary.find("device"), std::string::npos) << context->summary;
    EXPECT_NE(context->function("glDrawArrays"), nullptr);
}

// The default display of Mesa is an X server unless it is told otherwise; this route draws to a pbuffer.
TEST(EglContext, starts_on_the_default_display_with_a_pbuffer) {
    ASSERT_EQ(setenv("EGL_PLATFORM", "surfaceless", 1), 0);
    for (const Api api : {Api::es, Api::desktop}) {
        const auto context = start_egl({.api = api, .width = 40, .height = 24}, EglRoute::default_display);
        EXPECT_NE(context->summary.find("default display"), std::string::npos) << context->summary;
        // Framebuffer 0 is the pbuffer, of the size asked for: its viewport says so.
        std::array<GLint, 4> viewport{};
        reinterpret_cast<decltype(&glGetIntegerv)>(context->function("glGetIntegerv"))(GL_VIEWPORT, viewport.data());
        EXPECT_EQ(viewport, (std::array<GLint, 4>{0, 0, 40, 24}));
    }
    unsetenv("EGL_PLATFORM");
}

TEST(EglContext, notices_that_it_was_lost) {
    void* egl = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    ASSERT_NE(egl, nullptr) << dlerror();
    Context context = Context::create({.backend = Backend::egl});
    const auto display = reinterpret_cast<decltype(&eglGetCurrentDisplay)>(dlsym(egl, "eglGetCurrentDisplay"))();
    const auto current = reinterpret_cast<decltype(&eglGetCurrentContext)>(dlsym(egl, "eglGetCurrentContext"))();
    context.make_current();  // all is well so far
    // Destroyed behind its back: EGL keeps it until it is released, which make_current() does.
    ASSERT_EQ(reinterpret_cast<decltype(&eglDestroyContext)>(dlsym(egl, "eglDestroyContext"))(display, current),
              EGLBoolean{EGL_TRUE});
    try {
        context.make_current();
        FAIL() << "a destroyed context was made current";
    } catch (const ContextError& error) {
        EXPECT_NE(std::string(error.what()).find("the context was lost (eglMakeCurrent: EGL_BAD_CONTEXT)"),
                  std::string::npos)
            << error.what();
    }
}

}  // namespace
}  // namespace halfframe::platform
