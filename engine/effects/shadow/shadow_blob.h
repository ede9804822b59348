// The low tier: a soft dark blob on the ground under every dynamic surface.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/frame/renderer.h"

namespace halfframe {

/// One blob on level ground.
struct Blob {
    glm::vec3 centre{0.0f};  ///< [m] world, on the ground
    glm::vec2 radius{0.0f};  ///< along x and z [m]
    float strength = 0.0f;   ///< 0..1: what the middle loses
    glm::vec4 span{0.0f};    ///< xy least, zw greatest x and z that have ground below [radii], -1..1
};

/// The blob that a dynamic surface with the world box `object` lays on the highest of `grounds` (world boxes of static
/// surfaces) whose top is under it and that its centre is above. A box that encloses the object (a room in one mesh)
/// says nothing of its floor: the object is then taken to stand. Nothing: no ground, or too high above it.
[[nodiscard]] std::optional<Blob> blob_under(const Box& object, std::span<const Box> grounds);

/// World boxes of the static surfaces that hide what is behind them.
[[nodiscard]] std::vector<Box> grounds_of(const Scene& scene);

class ShadowBlobs final : public EffectWork {
public:
    explicit ShadowBlobs(Renderer& renderer);
    void draw(Renderer& renderer, const View& view, int phase) override;

private:
    gl::Program* program_ = nullptr;
    int clip_from_local_ = -1, span_ = -1, blob_ = -1;
    DrawMesh square_;
    std::vector<int> objects_;  ///< surfaces
    std::vector<Box> grounds_;
};

}  // namespace halfframe
