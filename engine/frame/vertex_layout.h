// Attribute locations shared by every shader that draws scene meshes, and the interleaved vertex they read.
#pragma once

#include <cstdint>

namespace halfframe {

/// 8 is the minimum of ES 2.0.
enum VertexAttribute : int {
    kPosition = 0,
    kNormal = 1,
    kTangent = 2,
    kUv = 3,
    kColor = 4,
    kUv1 = 5,
    kJoints = 6,
    kWeights = 7,
};

/// 40 bytes. Directions are 16-bit normalised: 0.002 degrees worst error, which no tier can see.
struct PackedVertex {
    float position[3];        ///< [m] local
    std::int16_t normal[4];   ///< snorm, w unused
    std::int16_t tangent[4];  ///< snorm, w = handedness
    float uv[2];
    std::uint8_t color[4];  ///< unorm, linear
};
static_assert(sizeof(PackedVertex) == 40);

}  // namespace halfframe
