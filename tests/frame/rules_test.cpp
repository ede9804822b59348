// broken_rule(): every rule is broken once on purpose.
#include <gtest/gtest.h>

#include "tests/frame/planning.h"

namespace halfframe::tests {
namespace {

/// With a pass that reads what another has drawn.
FramePlan good() { return plan(square_scene(), {.reads_light = true}); }

void expect_broken(const FramePlan& frame, const std::string& words, const gl::Caps& caps = able_caps()) {
    const auto broken = broken_rule(frame, caps);
    ASSERT_TRUE(broken) << "expected a sentence with: " << words;
    EXPECT_NE(broken->find(words), std::string::npos) << *broken;
}

TEST(BrokenRule, AGoodPlanBreaksNone) { EXPECT_FALSE(broken_rule(good(), able_caps())); }

TEST(BrokenRule, ReadBeforeWritten) {
    FramePlan frame = good();
    std::swap(frame.passes[0], frame.passes[1]);
    expect_broken(frame, "before any pass has written");
}

TEST(BrokenRule, SampledWhileBound) {
    FramePlan frame = good();
    frame.passes[1].color = frame.passes[1].reads[0];
    expect_broken(frame, "while it is bound");
}

TEST(BrokenRule, KeepsWhatNobodyWrote) {
    FramePlan frame = good();
    frame.passes[0].start_color = StartAction::keep;
    expect_broken(frame, "nothing has been written");
}

TEST(BrokenRule, OverTheBytesOfItsTier) {
    FramePlan frame = good();
    for (const char* extra : {"a", "b", "c"}) frame.add_target(extra, gl::PixelFormat::rgba8);
    expect_broken(frame, "bytes a pixel");
}

TEST(BrokenRule, LargerThanTheDeviceAllows) {
    gl::Caps caps = able_caps();
    caps.max_texture_size = 32;
    expect_broken(good(), "allows 32", caps);
}

TEST(BrokenRule, AFormatThatDoesNotRender) {
    expect_broken(good(), "does not render", without(able_caps(), {gl::PixelFormat::rgba16f}));
}

TEST(BrokenRule, NoDisplay) {
    FramePlan frame = good();
    frame.passes.pop_back();
    expect_broken(frame, "display");
}

TEST(BrokenRule, NoPixels) {
    FramePlan frame = good();
    frame.targets[0].width = 0;
    expect_broken(frame, "no pixels");
}

}  // namespace
}  // namespace halfframe::tests
