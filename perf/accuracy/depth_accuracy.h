// What a depth target keeps of a distance, and whether the prepass and the surface agree on it, on a real context.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "engine/effects/depth_prepass/depth_prepass_reference.h"
#include "engine/gl/program.h"
#include "perf/accuracy/function_list.h"

namespace halfframe::accuracy {

struct DepthAccuracy {
    gl::PixelFormat format = gl::PixelFormat::depth24;
    std::string missing;  ///< why nothing was measured; empty: it was
    std::size_t lanes = 0;
    double largest = 0.0;       ///< [steps of the format] against the depth before it was stored, like p99
    double p99 = 0.0;           ///< 99 of 100 errors are at most this
    double of_distance = 0.0;   ///< against the reference: the distance that is stored, less the distance, over it
    double worst_m = 0.0;       ///< the distance of that
    double worst_near_m = 0.0;  ///< and its camera's near plane
    std::size_t apart = 0;      ///< lanes where surface.vert's depth is another one than depth_prepass.vert's
    Bound bound;                ///< of `largest`
    Bound distance_bound;       ///< of `of_distance`
    std::vector<std::string> violations;
};

/// The distance that a depth stands for: a test may plant another one.
using DistanceAt = double (*)(double depth, const reference::DepthRange& range);

/// Both depth formats. `files`: a test may plant another vertex stage.
[[nodiscard]] std::vector<DepthAccuracy> measure_depth(gl::EntryPoints& gl, const gl::Caps& caps,
                                                       DistanceAt meant = &reference::distance_at,
                                                       std::span<const gl::ShaderFile> files = gl::shader_files());

}  // namespace halfframe::accuracy
