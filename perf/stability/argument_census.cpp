// One card records every argument of the surface shader, each in pixels of its own, where the colour would go.
#include "perf/stability/argument_census.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "content/content.h"
#include "engine/error.h"
#include "engine/frame/renderer.h"
#include "perf/measure/planted_effect.h"
#include "perf/report/text_table.h"

namespace halfframe::stability {
namespace {

#define HALFFRAME_SEE(value) "{ highp float x = " value "; seen = vec2(min(seen.x, x), max(seen.y, x)); }"
#define HALFFRAME_SEE_ALL(value)                                                          \
    "{ highp vec3 x = " value                                                             \
    "; seen = vec2(min(seen.x, min(min(x.r, x.g), x.b)), max(seen.y, max(max(x.r, x.g), " \
    "x.b))); }"
// llvmpipe of Mesa 22.3 records nothing where both a condition and the value under it are of uniforms alone, so such
// values carry a billionth of a direction.
#define HALFFRAME_SEE_SPOT(value)                    \
    "\n#ifdef SPOT_LIGHTS\n{ highp float x = " value \
    "; highp float w = light_color[i].w;\n"          \
    "seen = vec2(min(seen.x, w > 0.0 ? x : 1e30), max(seen.y, w > 0.0 ? x : -1e30)); }\n#endif\n"

/// And the recording's number: in blue, it tells a recorded pixel from any other. One that is blended over another of
/// the same recording may be a rounding off.
constexpr float kMark = 12345.0f, kMarkRounding = 0.05f;

/// How one argument is recorded. `once` stands behind the loops of surface.frag, `per_direction` in every light's
/// round, the sun's and the lamps', `per_lamp` in the lamps' alone.
struct Recording {
    const char* function;
    const char* parameter;
    const char* once = "";
    const char* per_direction = "";
    const char* per_lamp = "";
};

constexpr std::array kRecordings{
    Recording{.function = "direct_light", .parameter = "albedo", .once = HALFFRAME_SEE_ALL("albedo")},
    Recording{.function = "direct_light", .parameter = "specular", .once = HALFFRAME_SEE_ALL("specular")},
    Recording{.function = "direct_light", .parameter = "power", .once = HALFFRAME_SEE("power")},
    Recording{.function = "direct_light", .parameter = "radiance", .per_direction = HALFFRAME_SEE_ALL("radiance")},
    Recording{.function = "fresnel_schlick",
              .parameter = "l_dot_h",
              .per_direction = HALFFRAME_SEE("saturate(dot(l, normalize(l + v + vec3(1e-6))))")},
    Recording{.function = "fresnel_glossy", .parameter = "smoothness", .once = HALFFRAME_SEE("smoothness")},
    Recording{.function = "fresnel_glossy", .parameter = "n_dot_v", .once = HALFFRAME_SEE("n_dot_v")},
    Recording{
        .function = "power_from_roughness",
        .parameter = "roughness",
        .once = "\n#ifdef ONE_FETCH\n" HALFFRAME_SEE(
            "factors.y * packed_map.a") "\n#elif defined(METALLIC_ROUGHNESS_MAP)\n" HALFFRAME_SEE("factors.y * "
                                                                                                  "packed_factors."
                                                                                                  "g") "\n#"
                                                                                                       "endif\n"},
    Recording{.function = "smoothness_from_power", .parameter = "power", .once = HALFFRAME_SEE("power")},
    Recording{
        .function = "distance_falloff", .parameter = "distance_squared", .per_lamp = HALFFRAME_SEE("distance_squared")},
    Recording{.function = "distance_falloff",
              .parameter = "inverse_range_squared",
              .per_lamp = HALFFRAME_SEE("light_position[i].w")},
    Recording{.function = "cone_falloff",
              .parameter = "cosine",
              .per_lamp = HALFFRAME_SEE_SPOT("dot(-l, light_direction[i].xyz)")},
    Recording{.function = "cone_falloff",
              .parameter = "cos_outer",
              .per_lamp = HALFFRAME_SEE_SPOT("light_direction[i].w + 1e-9 * l.x")},
    Recording{.function = "cone_falloff",
              .parameter = "cos_scale",
              .per_lamp = HALFFRAME_SEE_SPOT("light_color[i].w + 1e-9 * l.x")},
    Recording{.function = "area_power", .parameter = "ratio", .per_lamp = HALFFRAME_SEE("ratio")},
    // ENVIRONMENT_RANGE stands where environment's functions do.
    Recording{.function = "reflection_level",
              .parameter = "smoothness",
              .once = "\n#ifdef ENVIRONMENT_RANGE\n" HALFFRAME_SEE("smoothness") "\n#endif\n"},
    Recording{.function = "reflection_level",
              .parameter = "roughest",
              .once = "\n#ifdef ENVIRONMENT_RANGE\n" HALFFRAME_SEE("reflection_scale.y + 1e-9 * n.x") "\n#endif\n"},
    Recording{.function = "unpacked_rgbm",
              .parameter = "root_range",
              .once = "\n#ifdef ENVIRONMENT_RANGE\n" HALFFRAME_SEE("reflection_scale.x + 1e-9 * n.x") "\n#endif\n"},
    // All nine terms, which have one domain; where fragments add them up themselves.
    Recording{.function = "irradiance",
              .parameter = "c0",
              .once =
                  "\n#if defined(ENVIRONMENT_RANGE) && !defined(IRRADIANCE_BY_VERTEX)\n"
                  "for (int k = 0; k < 9; k++) " HALFFRAME_SEE_ALL("irradiance_terms[k].rgb + 1e-9 * n") "\n#endif\n"},
};

/// What is stored is what this is called with: recorded in a picture of its own.
constexpr Recording kStored{.function = "tone_map", .parameter = "light"};

constexpr std::size_t kColumns = 5, kRows = 4;  ///< of a block of pixels, one for each recording
static_assert(kColumns * kRows >= kRecordings.size());

std::string parts(const char* Recording::*part) {
    std::string text;
    for (std::size_t i = 0; i < kRecordings.size(); ++i) {
        const std::string_view code = kRecordings[i].*part;
        if (!code.empty()) text += fmt::format("if (recorded == {}) {{ {} }}\n", i, code);
    }
    return text;
}

/// The least and the greatest of all lights go to red and green. What stands for a loop of surface.frag is that loop
/// again: insertions see its uniforms and what main() holds behind it.
std::string recording_code() {
    return fmt::format(R"(
#ifndef UNLIT
{{
    highp vec2 seen = vec2(1e30, -1e30);
    highp vec2 cell = mod(floor(gl_FragCoord.xy), vec2({0}.0, {1}.0));
    highp int recorded = int(cell.x + {0}.0 * cell.y);
    {2}
#ifdef SUN
    {{
        highp vec3 l = sun_direction.xyz;
        highp vec3 radiance = sun_light;
        {3}
    }}
#endif
#ifdef LOCAL_LIGHTS
    for (int i = 0; i < LIGHT_SLOTS; i++) {{
#ifdef COUNTED_LIGHTS
        if (float(i) >= light_count.x) break;
#endif
        highp vec3 to_light = light_position[i].xyz + vertex_to_eye;
        highp float distance_squared = dot(to_light, to_light);
        highp vec3 l = to_light * inversesqrt(max(distance_squared, 1e-8));
#ifdef AREA_LIGHTS
        distance_squared = max(distance_squared, light_size[i].y);
#endif
        highp vec3 radiance = light_color[i].rgb * distance_falloff(distance_squared, light_position[i].w);
        highp float ratio = 0.0;
#ifdef AREA_LIGHTS
        ratio = light_size[i].x * inversesqrt(max(distance_squared, 1e-8));
#endif
        {4}
        {3}
    }}
#endif
    color = vec3(seen, {5}.0);
}}
#endif
)",
                       kColumns, kRows, parts(&Recording::once), parts(&Recording::per_direction),
                       parts(&Recording::per_lamp), kMark);
}

EffectCard recording_card() {
    return perf::planted_effect([](const PlanContext&) {
        static const std::string code = recording_code();
        static const gl::Insertion insertions[] = {{"surface.color", nullptr, code.c_str()}};
        return std::span<const gl::Insertion>(insertions);
    });
}

EffectCard storing_card() {
    static constexpr gl::Insertion insertions[] = {{"surface.color", nullptr, "color = max(color, vec3(0.0));"}};
    return perf::planted_effect([](const PlanContext&) { return std::span<const gl::Insertion>(insertions); });
}

SeenArgument unseen(const Recording& recording, const std::vector<Declaration>& functions) {
    for (const Declaration& function : functions) {
        if (function.name != recording.function) continue;
        for (const DeclaredParameter& parameter : function.parameters) {
            if (parameter.name == recording.parameter)
                return {.function = recording.function,
                        .parameter = recording.parameter,
                        .low = std::numeric_limits<double>::infinity(),
                        .high = -std::numeric_limits<double>::infinity(),
                        .lowest_in = {},
                        .highest_in = {},
                        .declared = parameter.domain};
        }
    }
    throw Mistake(fmt::format("{} has no parameter {} to record", recording.function, recording.parameter));
}

void take(SeenArgument& argument, double low, double high, const std::string& scene) {
    if (low > high) return;  // no light of the kind reaches this pixel
    ++argument.pixels;
    if (low < argument.low) {
        argument.low = low;
        argument.lowest_in = scene;
    }
    if (high > argument.high) {
        argument.high = high;
        argument.highest_in = scene;
    }
}

void take_recorded(std::vector<SeenArgument>& arguments, const FloatPicture& picture, const std::string& scene) {
    const auto width = static_cast<std::size_t>(picture.width), height = static_cast<std::size_t>(picture.height);
    for (std::size_t y = 0; y < height; ++y) {
        const std::size_t cell_row = (height - 1 - y) % kRows;  // gl_FragCoord counts from below
        for (std::size_t x = 0; x < width; ++x) {
            const float* pixel = &picture.rgba[(y * width + x) * 4];
            const std::size_t recorded = cell_row * kColumns + x % kColumns;
            if (recorded < arguments.size() && pixel[2] == kMark) take(arguments[recorded], pixel[0], pixel[1], scene);
        }
    }
}

void take_stored(SeenArgument& argument, const FloatPicture& picture, const std::string& scene) {
    for (std::size_t at = 0; at < picture.rgba.size(); at += 4) {
        const auto [low, high] = std::minmax({picture.rgba[at], picture.rgba[at + 1], picture.rgba[at + 2]});
        take(argument, low, high, scene);
    }
}

FloatPicture drawn(Renderer& renderer, const gl::Caps& caps, std::span<const EffectCard* const> cards,
                   const Scene& scene, int width, int height) {
    Wishes wishes{.tier = Tier::console, .arithmetic = Arithmetic::full};
    wishes.census = true;
    for (const char* effect : {"bloom", "anti_alias"}) wishes.effect_switches.emplace_back(effect, false);
    View view = view_of(scene.cameras.at(0), width, height);
    view.exposure = scene.cameras.at(0).exposure;
    renderer.prepare(scene, plan_frame(scene, view, wishes, caps, cards));
    renderer.draw(view);
    const auto& targets = renderer.plan().targets;
    const auto target = std::ranges::find(targets, "scene_color", &Target::name);
    if (target == targets.end()) return {};  // a scene of nothing draws nothing into it
    return renderer.read_target(static_cast<int>(target - targets.begin()));
}

}  // namespace

const char* unrecorded_arguments() {
    return "not recorded: what the vertex stage computes (shadow_lift, irradiance by vertex), and the passes over the "
           "whole picture save what they read (bloom, sky, anti_alias: display values and texels by construction)";
}

std::vector<SeenArgument> see_arguments(gl::EntryPoints& gl, const gl::Caps& caps,
                                        const std::function<void(const std::string& scene)>& step) {
    constexpr int kWidth = 720, kHeight = 405;  // [pixels]: each argument has some 14 500
    const std::vector<Declaration> functions = all_functions();
    std::vector<SeenArgument> seen;
    for (const Recording& recording : kRecordings) seen.push_back(unseen(recording, functions));
    SeenArgument stored = unseen(kStored, functions);
    const EffectCard recording = recording_card(), storing = storing_card();
    const auto recording_effects = perf::all_effects_and(recording), storing_effects = perf::all_effects_and(storing);
    for (const content::BuiltInScene& built_in : content::built_in_scenes()) {
        const Scene scene = built_in.make();
        if (scene.cameras.empty()) continue;
        if (step) step(scene.name);
        Renderer recorder(gl, caps, {.program_cache_folder = {}, .effects = recording_effects});
        Renderer storer(gl, caps, {.program_cache_folder = {}, .effects = storing_effects});
        take_recorded(seen, drawn(recorder, caps, recording_effects, scene, kWidth, kHeight), scene.name);
        take_stored(stored, drawn(storer, caps, storing_effects, scene, 160, 90), scene.name);
    }
    seen.push_back(stored);
    return seen;
}

std::string arguments_text(const std::vector<SeenArgument>& seen) {
    perf::TextTable table({{"function", perf::Align::left},
                           {"argument", perf::Align::left},
                           {"pixels", perf::Align::right},
                           {"least", perf::Align::right},
                           {"in", perf::Align::left},
                           {"greatest", perf::Align::right},
                           {"in", perf::Align::left},
                           {"declared", perf::Align::left},
                           {"covered", perf::Align::left}});
    for (const SeenArgument& one : seen) {
        const bool any = one.pixels > 0;
        table.add_row({one.function, one.parameter, std::to_string(one.pixels),
                       any ? fmt::format("{:.5g}", one.low) : "-", one.lowest_in,
                       any ? fmt::format("{:.5g}", one.high) : "-", one.highest_in,
                       fmt::format("{:g}..{:g}", one.declared.low, one.declared.high), one.covered() ? "yes" : "no"});
    }
    return table.text() + unrecorded_arguments() + "\n";
}

std::vector<std::string> violations_of(const std::vector<SeenArgument>& seen) {
    std::vector<std::string> sentences;
    for (const SeenArgument& one : seen) {
        if (one.covered()) continue;
        sentences.push_back(fmt::format(
            "{}: {} is {:.6g}..{:.6g} in built-in scenes ({}, {}), and its domain says {:g}..{:g}", one.function,
            one.parameter, one.low, one.high, one.lowest_in, one.highest_in, one.declared.low, one.declared.high));
    }
    return sentences;
}

}  // namespace halfframe::stability
