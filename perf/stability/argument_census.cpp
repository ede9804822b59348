// Each argument is recorded by a card of its own, which writes it where the surface's colour would go.
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

// The least and the greatest of all lights go to red and green; blue tells a recorded pixel from any other. What stands
// for a loop of surface.frag is that loop again: insertions see its uniforms and what main() holds behind it.
#define HALFFRAME_RECORD(once, per_direction, per_lamp)                                                          \
    "#ifndef UNLIT\n"                                                                                            \
    "{ highp vec2 seen = vec2(1e30, -1e30);\n" once                                                              \
    "\n#ifdef SUN\n{ highp vec3 l = sun_direction.xyz; highp vec3 radiance = sun_light;\n" per_direction         \
    "\n}\n#endif\n"                                                                                              \
    "#ifdef LOCAL_LIGHTS\n"                                                                                      \
    "for (int i = 0; i < LIGHT_SLOTS; i++) {\n"                                                                  \
    "#ifdef COUNTED_LIGHTS\nif (float(i) >= light_count.x) break;\n#endif\n"                                     \
    "highp vec3 to_light = light_position[i].xyz + vertex_to_eye;\n"                                             \
    "highp float distance_squared = dot(to_light, to_light);\n"                                                  \
    "highp vec3 l = to_light * inversesqrt(max(distance_squared, 1e-8));\n"                                      \
    "#ifdef AREA_LIGHTS\ndistance_squared = max(distance_squared, light_size[i].y);\n#endif\n"                   \
    "highp vec3 radiance = light_color[i].rgb * distance_falloff(distance_squared, light_position[i].w);\n"      \
    "highp float ratio = 0.0;\n"                                                                                 \
    "#ifdef AREA_LIGHTS\nratio = light_size[i].x * inversesqrt(max(distance_squared, 1e-8));\n#endif\n" per_lamp \
    "\n" per_direction                                                                                           \
    "\n}\n#endif\n"                                                                                              \
    "color = vec3(seen, 12345.0); }\n#endif"
#define HALFFRAME_SEE(value) "{ highp float x = " value "; seen = vec2(min(seen.x, x), max(seen.y, x)); }"
#define HALFFRAME_SEE_ALL(value)                                                          \
    "{ highp vec3 x = " value                                                             \
    "; seen = vec2(min(seen.x, min(min(x.r, x.g), x.b)), max(seen.y, max(max(x.r, x.g), " \
    "x.b))); }"
// For spots alone. llvmpipe of Mesa 22.3 records nothing where both the condition and the value are of uniforms alone,
// so the values of two of these carry a billionth of a direction.
#define HALFFRAME_SEE_SPOT(value)                    \
    "\n#ifdef SPOT_LIGHTS\n{ highp float x = " value \
    "; highp float w = light_color[i].w;\n"          \
    "seen = vec2(min(seen.x, w > 0.0 ? x : 1e30), max(seen.y, w > 0.0 ? x : -1e30)); }\n#endif\n"

constexpr float kMark = 12345.0f;

struct Recording {
    const char* function;
    const char* parameter;
    const char* code;
};

constexpr std::array kRecordings{
    Recording{"direct_light", "albedo", HALFFRAME_RECORD(HALFFRAME_SEE_ALL("albedo"), "", "")},
    Recording{"direct_light", "specular", HALFFRAME_RECORD(HALFFRAME_SEE_ALL("specular"), "", "")},
    Recording{"direct_light", "power", HALFFRAME_RECORD(HALFFRAME_SEE("power"), "", "")},
    Recording{"direct_light", "radiance", HALFFRAME_RECORD("", HALFFRAME_SEE_ALL("radiance"), "")},
    Recording{"fresnel_schlick", "l_dot_h",
              HALFFRAME_RECORD("", HALFFRAME_SEE("saturate(dot(l, normalize(l + v + vec3(1e-6))))"), "")},
    Recording{"fresnel_glossy", "smoothness", HALFFRAME_RECORD(HALFFRAME_SEE("smoothness"), "", "")},
    Recording{"fresnel_glossy", "n_dot_v", HALFFRAME_RECORD(HALFFRAME_SEE("n_dot_v"), "", "")},
    Recording{
        "power_from_roughness", "roughness",
        HALFFRAME_RECORD(
            "\n#ifdef ONE_FETCH\n" HALFFRAME_SEE(
                "factors.y * packed_map.a") "\n#elif defined(METALLIC_ROUGHNESS_MAP)\n" HALFFRAME_SEE("factors.y * "
                                                                                                      "packed_factors."
                                                                                                      "g") "\n#endif\n",
            "", "")},
    Recording{"smoothness_from_power", "power", HALFFRAME_RECORD(HALFFRAME_SEE("power"), "", "")},
    Recording{"distance_falloff", "distance_squared", HALFFRAME_RECORD("", "", HALFFRAME_SEE("distance_squared"))},
    Recording{"distance_falloff", "inverse_range_squared",
              HALFFRAME_RECORD("", "", HALFFRAME_SEE("light_position[i].w"))},
    Recording{"cone_falloff", "cosine",
              HALFFRAME_RECORD("", "", HALFFRAME_SEE_SPOT("dot(-l, light_direction[i].xyz)"))},
    Recording{"cone_falloff", "cos_outer",
              HALFFRAME_RECORD("", "", HALFFRAME_SEE_SPOT("light_direction[i].w + 1e-9 * l.x"))},
    Recording{"cone_falloff", "cos_scale",
              HALFFRAME_RECORD("", "", HALFFRAME_SEE_SPOT("light_color[i].w + 1e-9 * l.x"))},
    Recording{"area_power", "ratio", HALFFRAME_RECORD("", "", HALFFRAME_SEE("ratio"))},
    // ENVIRONMENT_RANGE stands where environment's functions do; as above, a billionth of a direction goes with uniforms.
    Recording{"reflection_level", "smoothness",
              HALFFRAME_RECORD("\n#ifdef ENVIRONMENT_RANGE\n" HALFFRAME_SEE("smoothness") "\n#endif\n", "", "")},
    Recording{"reflection_level", "roughest",
              HALFFRAME_RECORD("\n#ifdef ENVIRONMENT_RANGE\n" HALFFRAME_SEE("reflection_scale.y + 1e-9 * n.x") "\n#endif\n",
                               "", "")},
    Recording{"unpacked_rgbm", "root_range",
              HALFFRAME_RECORD("\n#ifdef ENVIRONMENT_RANGE\n" HALFFRAME_SEE("reflection_scale.x + 1e-9 * n.x") "\n#endif\n",
                               "", "")},
    // All nine terms, which have one domain; where fragments add them up themselves.
    Recording{"irradiance", "c0",
              HALFFRAME_RECORD("\n#if defined(ENVIRONMENT_RANGE) && !defined(IRRADIANCE_BY_VERTEX)\n"
                               "for (int k = 0; k < 9; k++) " HALFFRAME_SEE_ALL("irradiance_terms[k].rgb + 1e-9 * n") "\n#endif\n",
                               "", "")},
    // What is stored is what these are called with.
    Recording{"tone_map", "light", "color = max(color, vec3(0.0));"},
};

template <std::size_t Index>
constexpr gl::Insertion kInsertions[] = {{"surface.color", nullptr, kRecordings[Index].code}};

template <std::size_t Index>
EffectCard card_of() {
    return perf::planted_effect([](const PlanContext&) { return std::span<const gl::Insertion>(kInsertions<Index>); });
}

template <std::size_t... Index>
std::array<EffectCard, sizeof...(Index)> all_cards(std::index_sequence<Index...>) {
    return {card_of<Index>()...};
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

void take(SeenArgument& argument, const FloatPicture& picture, bool marked, const std::string& scene) {
    for (std::size_t at = 0; at < picture.rgba.size(); at += 4) {
        if (marked && picture.rgba[at + 2] != kMark) continue;
        double low = picture.rgba[at], high = picture.rgba[at + 1];
        if (!marked) {
            low = std::min({low, high, static_cast<double>(picture.rgba[at + 2])});
            high = std::max({static_cast<double>(picture.rgba[at]), high, static_cast<double>(picture.rgba[at + 2])});
        }
        if (low > high) continue;  // no light of the kind reaches this pixel
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
}

FloatPicture drawn(Renderer& renderer, const gl::Caps& caps, std::span<const EffectCard* const> cards,
                   const Scene& scene) {
    constexpr int kWidth = 160, kHeight = 90;
    Wishes wishes{.tier = Tier::console, .arithmetic = Arithmetic::full};
    wishes.census = true;
    for (const char* effect : {"bloom", "anti_alias"}) wishes.effect_switches.emplace_back(effect, false);
    View view = view_of(scene.cameras.at(0), kWidth, kHeight);
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
    const std::array recording_cards = all_cards(std::make_index_sequence<kRecordings.size()>());
    const std::vector<Declaration> functions = all_functions();
    std::vector<Scene> scenes;
    for (const content::BuiltInScene& scene : content::built_in_scenes()) {
        scenes.push_back(scene.make());
        if (scenes.back().cameras.empty()) scenes.pop_back();
    }
    std::vector<SeenArgument> seen;
    for (std::size_t i = 0; i < kRecordings.size(); ++i) {
        std::vector<const EffectCard*> cards(all_effects().begin(), all_effects().end());
        cards.push_back(&recording_cards[i]);
        Renderer renderer(gl, caps, {.program_cache_folder = {}, .effects = cards});
        SeenArgument argument = unseen(kRecordings[i], functions);
        for (const Scene& scene : scenes) {
            if (step) step(fmt::format("{}.{} in {}", argument.function, argument.parameter, scene.name));
            const bool marked = std::string_view(kRecordings[i].function) != "tone_map";
            take(argument, drawn(renderer, caps, cards, scene), marked, scene.name);
        }
        seen.push_back(argument);
    }
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
