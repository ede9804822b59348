// A memory as one walks through it: a white space of glass, frames and light, translucent at many depths.
#pragma once

#include <cstdint>

#include "engine/frame/scene.h"

namespace halfframe::content::memory_room {

constexpr std::uint32_t kDefaultSeed = 2084;

/// The parts, each surface of its own, so that they can be sorted by distance: what blends lies at that many depths.
[[nodiscard]] Scene build(std::uint32_t seed);

/// Adds the shards of glass, the frames and the lines of light to a scene that has materials of these indices.
struct Glass {
    int clear = -1, milky = -1, edge = -1, picture = -1, line = -1, veil = -1, shaft = -1;
};
void add_shards(Scene& scene, const Glass& glass, std::uint32_t seed);
void add_frames(Scene& scene, const Glass& glass, std::uint32_t seed);
void add_air(Scene& scene, const Glass& glass, std::uint32_t seed);

}  // namespace halfframe::content::memory_room
