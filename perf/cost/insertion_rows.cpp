// Asks every card about every built-in scene, under caps that keep nothing out.
#include "perf/cost/insertion_rows.h"

#include <algorithm>
#include <map>
#include <span>
#include <string>

#include "content/content.h"
#include "engine/frame/frame_plan.h"

namespace halfframe::cost {
namespace {

gl::Caps rich_caps() {
    gl::Caps caps;
    caps.es_version = 32;
    caps.max_texture_size = caps.max_cube_map_size = caps.max_renderbuffer_size = 4096;
    caps.max_vertex_attributes = 16;
    caps.max_vertex_uniform_vectors = caps.max_fragment_uniform_vectors = 1024;
    caps.max_varying_vectors = 31;
    caps.max_fragment_samplers = caps.max_vertex_samplers = 32;
    caps.max_combined_samplers = 64;
    caps.explicit_lod = caps.depth_texture = caps.derivatives = caps.npot_textures = true;
    caps.renders.fill(true);
    return caps;
}

std::size_t length(std::span<const gl::Insertion> insertions) {
    std::size_t sum = 0;
    for (const gl::Insertion& one : insertions)
        sum += std::string_view(one.code != nullptr ? one.code : "").size() +
               std::string_view(one.file != nullptr ? one.file : "").size();
    return sum;
}

using Answers = std::map<std::string, std::vector<gl::Insertion>, std::less<>>;

/// By tier and effect, the longest answer.
std::array<Answers, kTierCount> longest_answers() {
    const gl::Caps caps = rich_caps();
    std::array<Answers, kTierCount> answers;
    for (const content::BuiltInScene& built_in : content::built_in_scenes()) {
        const Scene scene = built_in.make();
        const Camera camera = scene.cameras.empty() ? camera_framing(world_box(scene), 1.0f) : scene.cameras.front();
        const View view = view_of(camera, 64, 64);
        for (std::size_t tier = 0; tier < kTierCount; ++tier) {
            const FramePlan plan = plan_frame(scene, view, {.tier = static_cast<Tier>(tier)}, caps, all_effects());
            for (const EffectDecision& decision : plan.effects) {
                std::vector<gl::Insertion>& kept = answers[tier][decision.effect];
                if (decision.in && length(decision.insertions) > length(kept)) kept = decision.insertions;
            }
        }
    }
    return answers;
}

}  // namespace

std::array<std::vector<InsertionRow>, kTierCount> insertion_rows() {
    std::array<std::vector<InsertionRow>, kTierCount> rows;
    const std::array<Answers, kTierCount> answers = longest_answers();
    for (std::size_t tier = 0; tier < kTierCount; ++tier) {
        for (const EffectCard* effect : all_effects()) {
            const auto answer = answers[tier].find(effect->name);
            if (answer == answers[tier].end()) continue;
            for (const EffectCard* host : all_effects()) {
                for (const ShaderVariant& variant : host->tiers[tier].shaders) {
                    InsertionRow row{.effect = effect, .host = host, .variant = variant, .insertions = {}};
                    for (const gl::Insertion& one : answer->second)
                        if (std::string_view(one.point).starts_with(insertion_prefix(variant)))
                            row.insertions.push_back(one);
                    if (!row.insertions.empty()) rows[tier].push_back(std::move(row));
                }
            }
        }
    }
    return rows;
}

}  // namespace halfframe::cost
