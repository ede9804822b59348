// Timing methods: what calibration says holds, and every pass has as many samples as frames. No test looks at a
// duration.
#include "engine/frame/pass_timer.h"

#include <gtest/gtest.h>

#include "engine/frame/renderer.h"
#include "tests/frame/counted_new.h"
#include "tests/frame/planning.h"
#include "tests/harness/gl_fixture.h"

namespace halfframe::tests {
namespace {

class PassTimerTest : public harness::GlFixture {};

TEST_F(PassTimerTest, CalibrationBelievesOnlyWhatSeesTheDraw) {
    const TimingCalibration seen = calibrate_timing(gl(), caps());
    EXPECT_GT(seen.wall_ms, 0.0);
    EXPECT_FALSE(seen.sentence.empty());
    if (seen.method == TimingMethod::timer_query) {
        EXPECT_GE(seen.timer_query_ms, 0.8 * seen.wall_ms);
    }
    EXPECT_NE(seen.sentence.find(seen.method == TimingMethod::fence    ? "fence"
                                 : seen.method == TimingMethod::finish ? "glFinish"
                                                                       : "queries"),
              std::string::npos)
        << seen.sentence;
    EXPECT_EQ(gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST_F(PassTimerTest, LlvmpipesTimerQueriesAreNotBelieved) {
    // They time the submission of a draw, not its rasterisation: believing them would make every figure wrong.
    if (caps().renderer.find("llvmpipe") == std::string::npos)
        GTEST_SKIP() << "this is not llvmpipe but " << caps().renderer;
    EXPECT_NE(calibrate_timing(gl(), caps()).method, TimingMethod::timer_query);
}

TEST_F(PassTimerTest, EveryMethodTimesEveryPassOfEveryFrameWithoutTheHeap) {
    const Scene scene = square_scene();
    const View view = square_view();
    for (const TimingMethod method : {TimingMethod::finish, TimingMethod::fence, TimingMethod::timer_query}) {
        if (method == TimingMethod::fence && !caps().fence_sync) continue;
        if (method == TimingMethod::timer_query && !caps().timer_query) continue;
        Renderer renderer(gl(), caps());
        const FramePlan plan = plan_frame(scene, view, {}, caps(), all_effects());
        renderer.prepare(scene, plan);
        PassTimer timer(gl(), method, static_cast<int>(plan.passes.size()), 6);
        renderer.draw_timed(view, timer);
        const std::uint64_t before = heap_allocations();
        for (int frame = 0; frame < 5; ++frame) renderer.draw_timed(view, timer);
        EXPECT_EQ(heap_allocations(), before) << name(method);
        for (int pass = 0; pass < static_cast<int>(plan.passes.size()); ++pass) {
            EXPECT_EQ(timer.samples(pass).size(), 6u) << name(method);
            EXPECT_LE(timer.pass(pass).low_ms, timer.pass(pass).median_ms);
            EXPECT_LE(timer.pass(pass).median_ms, timer.pass(pass).high_ms);
        }
        EXPECT_EQ(timer.frame().frames, 6);
        EXPECT_EQ(renderer.first_gl_error(), "") << name(method);
    }
}

}  // namespace
}  // namespace halfframe::tests
