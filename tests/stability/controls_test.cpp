// The comparison of frames fails when something is off: one planted fault for every kind of pair.
#include <gtest/gtest.h>

#include <algorithm>

#include "perf/measure/planted_effect.h"
#include "tests/stability/frame_pairs.h"

namespace halfframe::tests {
namespace {

using accuracy::FrameCase;
using accuracy::Shot;

/// The first pair of `kind` whose change holds `words`.
FrameCase pair_of(const std::string& kind, const std::string& words = "") {
    for (const FrameCase& pair : accuracy::frame_cases()) {
        if (pair.kind == kind && pair.change.find(words) != std::string::npos) return pair;
    }
    ADD_FAILURE() << "no pair of the kind " << kind << " says '" << words << "'";
    return accuracy::frame_cases().front();
}

/// The pair with its changed shot changed once more.
template <typename Fault>
FrameCase with_fault(FrameCase pair, Fault fault) {
    pair.changed = [made = pair.changed, fault] {
        Shot shot = made();
        fault(shot);
        return shot;
    };
    return pair;
}

Light& light_named(Shot& shot, const std::string& name) {
    const auto found = std::ranges::find(shot.scene.lights, name, &Light::name);
    if (found == shot.scene.lights.end()) throw Mistake("the test room has no light called " + name);
    return *found;
}

void remove_light(Shot& shot, const std::string& name) {
    std::erase_if(shot.scene.lights, [&](const Light& light) { return light.name == name; });
}

class FrameControls : public FramePairs {
protected:
    /// Is `pair` refused with `words`, in both arithmetics?
    void expect_refused(const FrameCase& pair, const std::string& words = "_") {
        for (const Arithmetic arithmetic : {Arithmetic::full, Arithmetic::half}) {
            const accuracy::FrameAccuracy found = bench().measure(pair, Tier::console, arithmetic);
            const bool refused = std::ranges::any_of(found.violations, [&](const std::string& violation) {
                return violation.find(words) != std::string::npos;
            });
            EXPECT_TRUE(refused) << pair.kind << ", " << pair.change << ", " << name(arithmetic) << ": distance "
                                 << found.max_channel_error << " / " << found.bad_fraction << " was not refused";
        }
    }
};

TEST_F(FrameControls, AnEyeBesideItsPlace) {
    // 5 cm against bounds that allow half a millimetre; 1 mm against bounds that allow nothing.
    const auto step_aside = [](float distance) {
        return [distance](Shot& shot) { shot.camera.world_from_view[3].z += distance; };
    };
    expect_refused(with_fault(pair_of("moved", "10 km away, in m,"), step_aside(0.05f)), "bad_fraction");
    expect_refused(with_fault(pair_of("far_places", "10 km away, in m,"), step_aside(0.001f)), "bad_fraction");
    expect_refused(with_fault(pair_of("eye", "in mm"), step_aside(5.0f)), "bad_fraction");
}

TEST_F(FrameControls, ALampForgottenWhenUnitsChange) {
    expect_refused(with_fault(pair_of("units", "mm"), [](Shot& shot) { light_named(shot, "warm lamp").color /= 1e6f; }),
                   "max_channel_error");
    expect_refused(
        with_fault(pair_of("units", "cm"), [](Shot& shot) { light_named(shot, "warm lamp").color *= 1.05f; }),
        "bad_fraction");
}

TEST_F(FrameControls, ALightThatIsMissing) {
    expect_refused(with_fault(pair_of("lights", "opposite"), [](Shot& shot) { remove_light(shot, "warm lamp"); }));
    expect_refused(with_fault(pair_of("lights", "halves"), [](Shot& shot) { shot.scene.lights.pop_back(); }));
    expect_refused(with_fault(pair_of("lights", "exposure"), [](Shot& shot) { shot.camera.exposure *= 1.05f; }));
    expect_refused(with_fault(pair_of("eye", "parallel"), [](Shot& shot) { remove_light(shot, "violet neon"); }));
}

TEST_F(FrameControls, MoreLightThatDarkens) {
    expect_refused(with_fault(pair_of("lights", "lights times"), [](Shot& shot) { shot.scene.lights.clear(); }),
                   "max_channel_error");
}

TEST_F(FrameControls, ASunLeftBehindWhenAllTurns) {
    expect_refused(with_fault(pair_of("turned", "90"), [](Shot& shot) {
        light_named(shot, "sun").direction = glm::normalize(glm::vec3(-0.80f, -0.55f, -0.22f));
    }));
}

TEST_F(FrameControls, ATriangleWithAnArea) {
    expect_refused(with_fault(pair_of("triangles"), [](Shot& shot) {
        // The first triangles of the floor go from one corner of it to another and to a metre above, seen from both
        // sides.
        Mesh& floor = shot.scene.meshes.at(0);
        const std::uint32_t above = static_cast<std::uint32_t>(floor.positions.size() - 1);
        const std::uint32_t far_corner = floor.indices.back();
        floor.positions.back() += glm::vec3(2.0f, -2.0f, 1.0f);
        floor.indices[6] = floor.indices[0];
        floor.indices[7] = floor.indices[11] = far_corner;
        floor.indices[8] = floor.indices[10] = above;
    }));
}

TEST_F(FrameControls, ANeighbouringPixel) {
    FrameCase wide = pair_of("size", "4096x64");
    wide.changed_part->x += 1;
    expect_refused(wide);
    FrameCase one = pair_of("size", "1x1");
    one.plain_part->x += 4;
    expect_refused(one);
}

TEST_F(FrameControls, ABlankFrame) {
    const auto look_at_nothing = [](Shot& shot) { shot.scene.surfaces.clear(); };
    FrameCase blank = with_fault(pair_of("units"), look_at_nothing);
    blank.plain = blank.changed;  // two blank frames are the same
    expect_refused(blank, "too little to judge");
}

// As in tests/frame/census_test.cpp: an 8-bit target stores NaN as 0, and a black room may well be the same as before.
constexpr gl::Insertion kPlanted[] = {
    {"surface.color", nullptr, "color *= (base_color.a - base_color.a) / (base_color.a - base_color.a);"}};
const EffectCard kPlantedNan =
    perf::planted_effect([](const PlanContext&) { return std::span<const gl::Insertion>(kPlanted); });

TEST_F(FrameControls, ANanInBothFrames) {
    const std::vector<const EffectCard*> cards = perf::all_effects_and(kPlantedNan);
    accuracy::FrameBench with_nan(gl(), caps(), cards);
    const auto found = with_nan.measure(pair_of("triangles"), Tier::console, Arithmetic::full);
    EXPECT_GT(found.not_finite, 1000u);
    EXPECT_TRUE(std::ranges::any_of(found.violations, [](const std::string& violation) {
        return violation.find("NaN or infinite") != std::string::npos;
    }));
}

}  // namespace
}  // namespace halfframe::tests
