// Pairs of frames for any scene. Bounds are twice what was measured over all built-in scenes on llvmpipe (Mesa 22.3,
// 160x90 pixels), which their reasons give as max_channel_error / bad_fraction.
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "engine/frame/pose.h"
#include "perf/accuracy/frame_cases.h"
#include "shaders_es/surface/surface_limits.h"

namespace halfframe::accuracy {
namespace {

/// 10 km, whole metres, along which no coordinate stays small.
const glm::dvec3 kFar_m{4800.0, 6000.0, 6400.0};
constexpr double kPerMetre_mm = 1000.0;
constexpr float kWide_rad = 0.03f;

constexpr FrameBound kExact{};
constexpr FrameBound kUnits{4, 5e-3,
                            "a vertex in the middle of two steps of 16 bits goes to the other one: 1 / 0.0023"};
constexpr FrameBound kUnitsHalf{4, 0.064, "as in full, and other roundings of lamps' numbers in half: 2 / 0.032"};
/// A box of more than 32 m has steps of 0.5 mm, and 32-bit vertices beside 16-bit ones: silhouettes of far, thin
/// things.
constexpr FrameBound kUnitsLarge{62, 9e-3, "steps of 0.5 mm and more, so that silhouettes change hands: 31 / 0.0043"};
constexpr FrameBound kUnitsLargeHalf{62, 0.048, "as in full, and a code more often in half: 31 / 0.024"};
constexpr FrameBound kAtALamp{22, 5e-3, "as in other units, right before the lamp's own highlight: 11 / 0.0010"};
constexpr FrameBound kAtALampHalf{22, 0.048, "as in full, and a code more often in half: 11 / 0.017"};
constexpr FrameBound kLight{2, 3e-4, "10^4 is no power of two: a code where light falls between two: 1 / 0.0001"};
constexpr FrameBound kHalved{2, 3e-4, "a lamp's light is rounded before it is doubled: 1 / 0.0001"};
constexpr FrameBound kHalvedHalf{2, 0.12, "a lamp's light is rounded before it is doubled, not after: 1 / 0.060"};
constexpr FrameBound kBrighterHalf{2, 4e-4, "half may round down where a lamp adds next to nothing: 1 / 0.0002"};
constexpr FrameBound kWide{2, 4e-3, "a pixel's place is a sum of other roundings in a wide picture: 1 / 0.0020"};
constexpr float kLarge_m = 32.0f;

class Cases {
public:
    explicit Cases(const Scene& scene) : shot_(std::make_shared<Shot>()) {
        shot_->scene = scene;
        shot_->camera =
            scene.cameras.empty() ? camera_framing(world_box(scene), 160.0f / 90.0f) : scene.cameras.front();
        const Box box = world_box(scene);
        large_ = !box.empty() && glm::any(glm::greaterThan(box.high - box.low, glm::vec3(kLarge_m)));
        for (const Light& light : scene.lights) lamps_ += light.kind != LightKind::sun ? 1 : 0;
    }

    std::vector<FrameCase> all() {
        add_places();
        add_lights();
        add_times();
        add_sizes();
        return std::move(list_);
    }

private:
    using Change = std::function<Shot(Shot)>;

    FrameCase& add(const std::string& change, const Change& plain, const Change& changed, const FrameBound& full,
                   const FrameBound& half) {
        FrameCase& made = list_.emplace_back();
        made.kind = "scene";
        made.change = fmt::format("{}: {}", shot_->scene.name, change);
        made.plain = [shot = shot_, plain] { return plain(*shot); };
        made.changed = [shot = shot_, changed] { return changed(*shot); };
        made.full = full;
        made.half = half;
        made.least_covered = 0.02;  // most of some scenes is background
        return made;
    }

    static Shot same(Shot shot) { return shot; }
    static Shot in_mm(Shot shot) { return in_units(std::move(shot), kPerMetre_mm); }
    static Shot far(Shot shot) { return moved(std::move(shot), kFar_m); }
    static Shot with_far_places(Shot shot) { return with_places_of(std::move(shot), kFar_m); }
    /// Where the first lamp is, looking as before.
    static Shot at_a_lamp(Shot shot) {
        for (const Light& light : shot.scene.lights) {
            if (light.kind == LightKind::sun) continue;
            shot.camera.world_from_view[3] = glm::vec4(light.position, 1.0f);
            break;
        }
        shot.camera.orthographic = false;
        return shot;
    }
    /// A millimetre above the lowest place of the scene, below the camera.
    static Shot on_the_ground(Shot shot) {
        shot.camera.world_from_view[3].y = world_box(shot.scene).low.y + 0.001f;
        return shot;
    }

    void add_places() {
        add("10 km away, against its own places", with_far_places, far, kExact, kExact);
        add("lengths in mm", same, in_mm, large_ ? kUnitsLarge : kUnits, large_ ? kUnitsLargeHalf : kUnitsHalf);
        add(
            "eye 1 mm above the lowest place, 10 km away",
            [](Shot shot) { return with_far_places(on_the_ground(shot)); },
            [](Shot shot) { return far(on_the_ground(shot)); }, kExact, kExact)
            .least_covered = 0.0;
        if (lamps_ == 0) return;
        add(
            "eye at a lamp, in mm", at_a_lamp, [](Shot shot) { return in_mm(at_a_lamp(shot)); },
            large_ ? kUnitsLarge : kAtALamp, large_ ? kUnitsLargeHalf : kAtALampHalf)
            .least_covered = 0.0;
    }

    void add_lights() {
        const auto exposed = [](Shot shot) { return exposed_for(std::move(shot), 1e4f); };
        add("all light times 10^4, exposure 10^-4", same, exposed, kLight, kLight);
        if (shot_->scene.lights.empty()) return;
        add(
            "lights times 10^4", same, [](Shot shot) { return with_lights_times(std::move(shot), 1e4f); }, kExact,
            kBrighterHalf)
            .relation = Relation::never_darker;
        if (lamps_ > 0) add("lamps of no range, against none", without_lamps, with_lamps_of_no_range, kExact, kExact);
        add("lights in the opposite order", same, with_lights_reversed, kExact, kExact);
        // As long as no surface gets more than it may have.
        if (lamps_ > 0 && 2 * lamps_ <= SURFACE_LIGHT_LIMIT)
            add("every lamp as two halves", same, with_lamps_halved, kHalved, kHalvedHalf);
    }

    void add_times() {
        if (shot_->scene.animations.empty()) return;
        const double duration_s = shot_->scene.animations.front().duration_s;
        for (const auto& [words, time_s] : {std::pair{"after a minute", 60.0}, std::pair{"after an hour", 3600.0},
                                            std::pair{"after a day", 86400.0}}) {
            add(
                words, [=](Shot shot) { return at_time(std::move(shot), std::fmod(time_s, duration_s)); },
                [=](Shot shot) { return at_time(std::move(shot), time_s); }, kExact, kExact);
        }
    }

    void add_sizes() {
        if (shot_->camera.orthographic) return;
        const auto sized = [](int width, int height, float fov_y_rad) {
            return [=](Shot shot) {
                shot = with_field_of_view(std::move(shot), fov_y_rad);
                shot.width = width;
                shot.height = height;
                return shot;
            };
        };
        const float fov = shot_->camera.fov_y_rad;
        FrameCase& one = add("1x1, against the middle of 65x65", sized(65, 65, fov),
                             sized(1, 1, 2.0f * std::atan(std::tan(0.5f * fov) / 65.0f)), kExact, kExact);
        one.plain_part = Part{.x = 32, .y = 32};
        one.least_covered = 0.0;
        FrameCase& wide = add("4096x64, its middle against 64x64", sized(64, 64, kWide_rad), sized(4096, 64, kWide_rad),
                              kWide, kWide);
        wide.changed_part = Part{.x = 2016, .y = 0, .width = 64, .height = 64};
        wide.least_covered = 0.0;
    }

    std::shared_ptr<Shot> shot_;
    int lamps_ = 0;
    bool large_ = false;
    std::vector<FrameCase> list_;
};

}  // namespace

std::vector<FrameCase> scene_cases(const Scene& scene) { return Cases(scene).all(); }

}  // namespace halfframe::accuracy
