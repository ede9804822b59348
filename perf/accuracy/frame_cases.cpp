// The pairs of frames. A bound that is not 0 is twice what was measured on llvmpipe (Mesa 22.3, 160x90 pixels), which
// its reason gives as max_channel_error / bad_fraction.
#include "perf/accuracy/frame_cases.h"

#include <cmath>

#include <fmt/format.h>

#include "content/content.h"

namespace halfframe::accuracy {
namespace {

/// A direction of length 1 along which no coordinate stays small.
const glm::dvec3 kAway{0.48, 0.60, 0.64};

struct Units {
    const char* name;
    double per_metre;
};
constexpr Units kMetres{"m", 1.0};
constexpr Units kCentimetres{"cm", 100.0};
constexpr Units kMillimetres{"mm", 1000.0};

Shot room() {
    Shot shot;
    shot.scene = content::open_scene("test_room");
    shot.camera = shot.scene.cameras.at(0);
    return shot;
}

/// The room seen from `eye` towards `target`.
Shot room_from(const glm::vec3& eye, const glm::vec3& target, float near_m) {
    Shot shot = room();
    shot.camera = camera_looking(eye, target, 1.0f, world_box(shot.scene));
    shot.camera.near_m = near_m;
    return shot;
}

/// The eye a millimetre above the floor.
Shot along_the_floor() { return room_from({-2.7f, 0.001f, 1.6f}, {0.9f, 0.001f, -0.6f}, 0.02f); }
/// The eye a millimetre before the back wall.
Shot along_the_wall() { return room_from({-2.7f, 1.4f, -1.999f}, {2.0f, 1.2f, -1.999f}, 0.02f); }
/// The eye where the warm lamp is, inside its sphere.
Shot inside_a_lamp() {
    Shot shot = room_from({-2.2f, 2.1f, 0.9f}, {0.9f, 1.0f, -0.6f}, 0.02f);
    for (Light& light : shot.scene.lights) {
        if (light.position == glm::vec3(-2.2f, 2.1f, 0.9f)) light.radius_m = 0.5f;
    }
    return shot;
}

/// A lamp 5 cm from a wall, and one 5 cm from the metal ball.
Shot lamps_near_things() {
    Shot shot = room();
    for (Light& light : shot.scene.lights) {
        if (light.name == "violet neon") light.position.z = -1.95f;
        if (light.name == "warm lamp") light.position = {-0.3f, 0.4f, -0.15f};
    }
    return shot;
}

/// The room from behind its back wall, which has no outside, with parallel rays, or from ten kilometres away with a
/// lens as narrow as that needs.
Shot room_from_the_back(bool orthographic) {
    constexpr float kHalfHeight = 1.7f;
    const float distance = orthographic ? 5.0f : 10000.0f;
    Shot shot = room_from({0.4f, 1.5f, -distance}, {0.4f, 1.5f, 0.0f}, 1.0f);
    shot.camera.orthographic = orthographic;
    shot.camera.half_height_m = kHalfHeight;
    shot.camera.fov_y_rad = 2.0f * std::atan(kHalfHeight / distance);
    shot.camera.near_m = distance - 4.0f;
    shot.camera.far_m = distance + 4.0f;
    return shot;
}

/// `distance_km` away, in whole units, so that going there and coming back is exact.
glm::dvec3 offset(const Units& units, double distance_km) {
    return glm::round(kAway * (distance_km * 1000.0 * units.per_metre));
}

std::function<Shot()> in(const Units& units, Shot (*shot)()) {
    return [=] { return in_units(shot(), units.per_metre); };
}

/// A few codes where a result falls between two: what other roundings of the same picture cost.
constexpr FrameBound kRoundedInFloat{
    4, 4e-4, "roundings of 6e-8 turn a code where light falls between two, and one pixel of a texture: 2 / 0.0002"};
/// In other units some places fall on the other side of the middle between two of the 65536 that 16 bits tell apart.
constexpr FrameBound kStoredInOtherUnits{
    4, 6e-3, "a vertex in the middle of two steps of 16 bits, 0.06 mm apart, goes to the other one: 2 / 0.0027"};
constexpr FrameBound kRoundedInHalf{
    4, 0.04, "half steps of 2^-11 turn a code in every fiftieth pixel when the numbers of a lamp change: 2 / 0.018"};

constexpr const char* kLengthOfNormal =
    "half leaves a normal 2^-11 too long or short, by the order of the axes, and this tier's lobe as written raises "
    "that to "
    "a power of 500: 29 codes in a pixel or two of a highlight";

/// Against the origin: what floats can say of a place that far away is in these.
void bound_moved(FrameCase& pair, const Units& units, double distance_km) {
    pair.full = units.per_metre != 1.0 ? kStoredInOtherUnits : kRoundedInFloat;
    pair.half = kRoundedInHalf;
    if (units.per_metre != 1.0) return;  // the room's places are whole centimetres, which need no rounding there
    if (distance_km < 5.0) {
        pair.full = {148, 0.018, "places keep steps of 0.06 mm there; silhouettes move by less: 74 / 0.009"};
        pair.half = {148, 0.022, "as in full, and half turns a code in few pixels more: 74 / 0.011"};
    } else {
        pair.full = {150, 0.059, "places keep steps of 0.5 mm there; silhouettes move by less: 75 / 0.029"};
        pair.half = {150, 0.070, "as in full, and half turns a code in few pixels more: 75 / 0.035"};
    }
}

/// One pair for every unit and distance.
template <typename Pair>
std::vector<FrameCase> far_pairs(Pair pair) {
    std::vector<FrameCase> list;
    for (const Units& units : {kMetres, kCentimetres, kMillimetres}) {
        for (const double distance_km : {1.0, 10.0}) {
            FrameCase made = pair(units, distance_km);
            const glm::dvec3 far = offset(units, distance_km);
            made.changed = [=] { return moved(in_units(room(), units.per_metre), far); };
            list.push_back(made);
        }
    }
    return list;
}

std::vector<FrameCase> moved_cases() {
    return far_pairs([](const Units& units, double distance_km) {
        FrameCase made;
        made.kind = "moved";
        made.change = fmt::format("{:.0f} km away, in {}, against the origin", distance_km, units.name);
        made.plain = room;
        bound_moved(made, units, distance_km);
        return made;
    });
}

/// Against places that were rounded alike: what is left is the renderer's own, and that is nothing.
std::vector<FrameCase> far_place_cases() {
    return far_pairs([](const Units& units, double distance_km) {
        FrameCase made;
        made.kind = "far_places";
        made.change = fmt::format("{:.0f} km away, in {}, against its own places", distance_km, units.name);
        const glm::dvec3 far = offset(units, distance_km);
        made.plain = [=] { return with_places_of(in_units(room(), units.per_metre), far); };
        return made;
    });
}

std::vector<FrameCase> unit_cases() {
    std::vector<FrameCase> list;
    for (const Units& units : {kCentimetres, kMillimetres}) {
        FrameCase made;
        made.kind = "units";
        made.change = fmt::format("lengths in {}", units.name);
        made.plain = room;
        made.changed = in(units, room);
        made.full = kStoredInOtherUnits;
        made.half = kRoundedInHalf;
        list.push_back(made);
    }
    return list;
}

std::vector<FrameCase> light_cases() {
    FrameCase exposed;
    exposed.kind = "lights";
    exposed.change = "all light times 10^4, exposure 10^-4";
    exposed.plain = room;
    exposed.changed = [] { return exposed_for(room(), 1e4f); };
    FrameCase bright;
    bright.kind = "lights";
    bright.change = "lights times 10^4";
    bright.plain = room;
    bright.changed = [] { return with_lights_times(room(), 1e4f); };
    bright.relation = Relation::never_darker;
    FrameCase reversed;
    reversed.kind = "lights";
    reversed.change = "lights in the opposite order";
    reversed.plain = room;
    reversed.changed = [] { return with_lights_reversed(room()); };
    FrameCase halved;
    halved.kind = "lights";
    halved.change = "every lamp as two halves";
    halved.plain = room;
    halved.changed = [] { return with_lamps_halved(room()); };
    halved.full = kRoundedInFloat;
    halved.half = {2, 0.12, "a lamp's light is rounded before it is doubled, not after: 1 / 0.057"};
    FrameCase near_things = bright;
    near_things.change = "lamps 5 cm from things, lights times 10^4";
    near_things.plain = lamps_near_things;
    near_things.changed = [] { return with_lights_times(lamps_near_things(), 1e4f); };
    FrameCase blinding = bright;
    blinding.change = "exposure times 10^6";
    blinding.changed = [] {
        Shot shot = room();
        shot.camera.exposure *= 1e6f;
        return shot;
    };
    return {exposed, bright, near_things, blinding, reversed, halved};
}

std::vector<FrameCase> eye_cases() {
    std::vector<FrameCase> list;
    const glm::dvec3 far = offset(kMetres, 10.0);
    struct Eye {
        const char* place;
        Shot (*shot)();
    };
    for (const Eye& eye : {Eye{"eye 1 mm above the floor", along_the_floor},
                           Eye{"eye 1 mm before a wall", along_the_wall}, Eye{"eye inside a lamp", inside_a_lamp}}) {
        FrameCase away;
        away.kind = "eye";
        away.change = fmt::format("{}, 10 km away", eye.place);
        away.plain = [=] { return with_places_of(eye.shot(), far); };
        away.changed = [=] { return moved(eye.shot(), far); };
        list.push_back(away);
        FrameCase small = away;
        small.change = fmt::format("{}, in mm", eye.place);
        small.plain = eye.shot;
        small.changed = in(kMillimetres, eye.shot);
        FrameCase bright = small;
        small.full = kStoredInOtherUnits;
        small.half = kRoundedInHalf;
        list.push_back(small);
        bright.change = fmt::format("{}, lights times 10^4", eye.place);
        bright.changed = [=] { return with_lights_times(eye.shot(), 1e4f); };
        bright.relation = Relation::never_darker;
        list.push_back(bright);
    }
    FrameCase parallel;
    parallel.kind = "eye";
    parallel.change = "parallel rays, against a lens 10 km away";
    parallel.plain = [] { return room_from_the_back(false); };
    parallel.changed = [] { return room_from_the_back(true); };
    parallel.full = {
        54, 0.4,
        "rays differ by up to 2e-4; of a sky that lies between two codes a fifth turns, and at silhouettes "
        "a pixel changes hands: 27 / 0.196"};
    parallel.half = {54, 0.1, "as in full: 27 / 0.047"};
    parallel.reference_half = {34, 0.1, kLengthOfNormal};
    list.push_back(parallel);
    return list;
}

std::vector<FrameCase> shape_cases() {
    std::vector<FrameCase> list;
    for (const int quarters : {1, 2, 3}) {
        FrameCase made;
        made.kind = "turned";
        made.change = fmt::format("turned by {} degrees", 90 * quarters);
        made.plain = room;
        made.changed = [=] { return turned(room(), quarters); };
        made.full = {2, 8e-4, "sums over x, y and z are taken in another order: 1 / 0.0004"};
        made.half = {2, 8e-4, "as in full: 1 / 0.0004"};
        made.reference_half = {58, 8e-4, kLengthOfNormal};
        list.push_back(made);
    }
    FrameCase empty;
    empty.kind = "triangles";
    empty.change = "triangles without area";
    empty.plain = room;
    empty.changed = [] { return with_empty_triangles(room()); };
    list.push_back(empty);
    return list;
}

/// Everything on: the grids of the shadow map and of the filters are in these bounds.
std::vector<FrameCase> whole_cases() {
    std::vector<FrameCase> list;
    const auto add = [&](const char* change, const std::function<Shot()>& changed, const FrameBound& bound) {
        FrameCase made;
        made.kind = "whole";
        made.change = change;
        made.plain = room;
        made.changed = changed;
        made.whole = true;
        made.full = made.half = bound;
        list.push_back(made);
    };
    const auto away = [](const Units& units) {
        return [=] { return moved(in_units(room(), units.per_metre), offset(units, 10.0)); };
    };
    add("10 km away, in cm, with every effect", away(kCentimetres),
        {62, 0.05, "edges of the sun's patch fall on other texels of the map, and half turns codes: 31 / 0.024"});
    add("10 km away, in m, with every effect", away(kMetres),
        {172, 0.14, "places keep steps of 0.5 mm, and shadows fall on other texels: 86 / 0.067"});
    add("lengths in mm, with every effect", in(kMillimetres, room), {62, 0.05, "as 10 km away in cm: 31 / 0.021"});
    add("turned by 90 degrees, with every effect", [] { return turned(room(), 1); },
        {24, 0.04, "the map turns with its sun; the reference tier in half as without shadows: 12 / 0.020"});
    add("lights in the opposite order, with every effect", [] { return with_lights_reversed(room()); }, {});
    add("all light times 10^4, exposure 10^-4, with every effect", [] { return exposed_for(room(), 1e4f); }, {});
    return list;
}

std::vector<FrameCase> size_cases() {
    const auto sized = [](int width, int height, float fov_y_rad) {
        return [=] {
            Shot shot = with_field_of_view(room(), fov_y_rad);
            shot.width = width;
            shot.height = height;
            return shot;
        };
    };
    FrameCase one;
    one.kind = "size";
    one.change = "1x1, against the middle of 65x65";
    one.plain = sized(65, 65, 1.0f);
    one.plain_part = Part{.x = 32, .y = 32};
    one.changed = sized(1, 1, 2.0f * std::atan(std::tan(0.5f) / 65.0f));  // as wide as that one pixel
    FrameCase wide;
    wide.kind = "size";
    wide.change = "4096x64, its middle against 64x64";
    wide.plain = sized(64, 64, 0.03f);
    wide.changed = sized(4096, 64, 0.03f);
    wide.changed_part = Part{.x = 2016, .y = 0, .width = 64, .height = 64};
    wide.full = wide.half = {2, 5e-4, "a pixel's place is a sum of other roundings in a wide picture: 1 / 0.00024"};
    return {one, wide};
}

}  // namespace

const FrameBound& bound_of(const FrameCase& pair, Tier tier, Arithmetic arithmetic) {
    if (arithmetic == Arithmetic::full) return pair.full;
    return tier == Tier::reference && pair.reference_half ? *pair.reference_half : pair.half;
}

std::vector<FrameCase> frame_cases() {
    std::vector<FrameCase> list;
    for (const std::vector<FrameCase>& part : {moved_cases(), far_place_cases(), unit_cases(), light_cases(),
                                               eye_cases(), shape_cases(), size_cases(), whole_cases()}) {
        list.insert(list.end(), part.begin(), part.end());
    }
    return list;
}

}  // namespace halfframe::accuracy
