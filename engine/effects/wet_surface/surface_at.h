// What lies under a point, and how wet it is: for the sound of steps and for splashes. On the CPU, by the formulas of the
// shaders.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "engine/frame/scene.h"

namespace halfframe {

enum class Footing : std::uint8_t { dry, wet, puddle };
[[nodiscard]] const char* name(Footing footing);

/// The nearest surface below a point.
struct SurfaceAt {
    Footing footing = Footing::dry;
    float height_m = 0.0f;        ///< world y of the ground; water stands puddle_depth_m above it
    float puddle_depth_m = 0.0f;  ///< of standing water, 0 outside of puddles
    float open = 0.0f;            ///< 0 sheltered or waterproof .. 1 under the sky
    float wetness = 0.0f;         ///< 0 dry .. 1 soaked: the shader's `wetness.x`
    float puddle = 0.0f;          ///< share of open water 0..1: the shader's `puddle`
    int surface = -1;             ///< index in Scene::surfaces
    int material = -1;            ///< index in Scene::materials
};

/// Answers surface_at() for what does not move in a scene: surfaces on nodes or skins, those marked dynamic and those
/// that blend are left out. Making it walks every triangle; asking allocates nothing. Wetness and puddles are those of
/// the scene at the time of asking; places are those of the time of making. The scene outlives it.
class GroundQuery {
public:
    explicit GroundQuery(const Scene& scene);

    /// The nearest triangle at or below `point` [m, world] whose upper or lower side faces it; nothing: there is none.
    /// Masks in textures are read from their largest level, filtered; the picture may show a smaller one.
    [[nodiscard]] std::optional<SurfaceAt> surface_at(const glm::vec3& point) const;

    [[nodiscard]] std::size_t triangles() const { return triangles_.size(); }

private:
    struct Corner {
        glm::vec3 position;  ///< world [m]
        glm::vec3 normal;    ///< world, unit; +Y without one
        glm::vec2 uv;        ///< of the water texture
        float alpha;
    };
    struct Triangle {
        Corner corners[3];
        int surface;
    };
    void add(int surface);
    void sort_into_cells();
    [[nodiscard]] SurfaceAt answer(const Triangle& triangle, const glm::dvec3& shares, float height_m) const;

    const Scene& scene_;
    std::vector<Triangle> triangles_;
    // A grid over x and z; cell c holds triangles of_cell_[first_of_cell_[c] .. first_of_cell_[c + 1]).
    glm::vec2 low_{0.0f};
    float cell_m_ = 1.0f;
    int columns_ = 0, rows_ = 0;
    std::vector<std::uint32_t> first_of_cell_, of_cell_;
};

}  // namespace halfframe
