// Attribute locations shared by every shader that draws scene meshes, and where each stream of a vertex lies.
#pragma once

#include <array>
#include <cstdint>

#include "engine/frame/vertex_storage.h"

namespace halfframe {

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
inline constexpr int kVertexAttributes = 8;  ///< the minimum of ES 2.0

/// One attribute of an interleaved vertex, in the words of glVertexAttribPointer.
struct VertexStream {
    VertexAttribute attribute = kPosition;
    std::uint32_t type = 0;  ///< GL_FLOAT, GL_SHORT, GL_UNSIGNED_SHORT, GL_UNSIGNED_BYTE
    int components = 0;
    bool normalized = false;
    int offset = 0;  ///< [bytes]
};

/// The streams of one vertex; absent ones take no bytes. Every offset is a multiple of 4.
struct VertexLayout {
    std::array<VertexStream, 6> streams{};
    int count = 0;
    int stride = 0;  ///< [bytes]
};

[[nodiscard]] VertexLayout vertex_layout(const MeshStorage& storage);

}  // namespace halfframe
