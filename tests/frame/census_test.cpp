// The census finds no NaN and no inf in the built-in scenes, and finds a 0/0 that was planted.
#include <gtest/gtest.h>

#include "content/content.h"
#include "engine/frame/renderer.h"
#include "perf/measure/planted_effect.h"
#include "tests/frame/planning.h"
#include "tests/harness/gl_fixture.h"

namespace halfframe::tests {
namespace {

class Census : public harness::GlFixture {
protected:
    /// The rows of every view together; prepared once, for the first.
    std::vector<CensusRow> count(const Scene& scene, const std::vector<View>& views, Wishes wishes,
                                 std::span<const EffectCard* const> cards) {
        wishes.census = true;
        Renderer renderer(gl(), caps(), {.effects = cards});
        renderer.prepare(scene, plan_frame(scene, views.front(), wishes, caps(), cards));
        std::vector<CensusRow> rows;
        for (const View& view : views) {
            renderer.draw(view);
            EXPECT_EQ(renderer.first_gl_error(), "");
            const std::vector<CensusRow> of_view = renderer.census();
            rows.insert(rows.end(), of_view.begin(), of_view.end());
        }
        return rows;
    }
};

TEST_F(Census, FindsNothingInTheBuiltInScenes) {
    int frames = 0;
    for (const content::BuiltInScene& built_in : content::built_in_scenes()) {
        const Scene scene = built_in.make();
        for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
            for (const Arithmetic arithmetic : {Arithmetic::half, Arithmetic::full}) {
                std::vector<View> views;
                for (const Camera& camera : scene.cameras) views.push_back(view_of(camera, 128, 72));
                for (const CensusRow& row :
                     count(scene, views, {.tier = tier, .arithmetic = arithmetic}, all_effects())) {
                    EXPECT_GT(row.values, 0u);
                    EXPECT_EQ(row.nan + row.inf, 0u)
                        << built_in.name << ' ' << name(tier) << ' ' << name(arithmetic) << ' ' << row.target;
                    ++frames;
                }
            }
        }
    }
    EXPECT_GT(frames, 12);
}

// A material effect that divides nothing by nothing where the surface has it: only a census can see it, because an
// 8-bit target stores NaN as 0.
constexpr gl::Insertion kPlanted[] = {
    {"surface.color", nullptr, "color *= (base_color.a - base_color.a) / (base_color.a - base_color.a);"}};
const EffectCard kPlantedNan =
    perf::planted_effect([](const PlanContext&) { return std::span<const gl::Insertion>(kPlanted); });

TEST_F(Census, FindsAPlantedNan) {
    const std::vector<const EffectCard*> cards = perf::all_effects_and(kPlantedNan);
    const auto rows = count(square_scene(), {square_view()}, {.tier = Tier::console}, cards);
    std::uint64_t found = 0;
    for (const CensusRow& row : rows) {
        if (row.target == "scene_color") found += row.nan;
    }
    EXPECT_GT(found, 100u) << "the square covers a few hundred pixels";
    for (const CensusRow& row : rows) {
        if (row.target == "display") {
            EXPECT_EQ(row.nan, 0u) << "the tone map takes NaN out before the curve";
        }
    }
}

}  // namespace
}  // namespace halfframe::tests
