// A steady frame takes no heap memory, makes no GL object and links no program, at any tier, while the camera moves.
#include <gtest/gtest.h>

#include "content/content.h"
#include "engine/frame/renderer.h"
#include "tests/frame/counted_new.h"
#include "tests/harness/gl_fixture.h"

namespace halfframe::tests {
namespace {

class SteadyFrame : public harness::GlFixture, public testing::WithParamInterface<Tier> {};

TEST_P(SteadyFrame, TakesNothing) {
    const Scene scene = content::open_scene("test_room");
    ASSERT_FALSE(scene.cameras.empty());
    View view = view_of(scene.cameras[0], 96, 64);
    const FramePlan plan = plan_frame(scene, view, {.tier = GetParam()}, caps(), all_effects());
    Renderer renderer(gl(), caps());
    renderer.prepare(scene, plan);
    for (int frame = 0; frame < 3; ++frame) renderer.draw(view);
    gl().Finish();

    gl().ledger.clear();
    const std::uint64_t before = heap_allocations();
    for (int frame = 0; frame < 8; ++frame) {
        const glm::vec3 step{0.01f * static_cast<float>(frame), 0.0f, 0.0f};
        view.eye += step;
        view.view_from_world[3] -= view.view_from_world * glm::vec4(step, 0.0f);
        renderer.draw(view);
    }
    EXPECT_EQ(heap_allocations() - before, 0u);
    EXPECT_EQ(gl().ledger.object_creations(), 0u);
    EXPECT_EQ(gl().ledger.program_links(), 0u);
    EXPECT_EQ(renderer.first_gl_error(), "");
}

TEST(SteadyFrameCounter, SeesAnAllocation) {
    if (!heap_is_counted()) GTEST_SKIP() << "AddressSanitizer owns operator new: nothing is counted";
    const std::uint64_t before = heap_allocations();
    const std::string long_enough_to_need_the_heap(100, 'x');
    EXPECT_GT(heap_allocations(), before) << long_enough_to_need_the_heap.size();
}

INSTANTIATE_TEST_SUITE_P(Tiers, SteadyFrame, testing::Values(Tier::low, Tier::console, Tier::reference),
                         [](const auto& tier) { return std::string(name(tier.param)); });

}  // namespace
}  // namespace halfframe::tests
