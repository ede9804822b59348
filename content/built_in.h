// The scenes that need no file, and what they are assembled with.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "engine/frame/scene.h"

namespace halfframe::content {

[[nodiscard]] Scene make_empty();
[[nodiscard]] Scene make_furnace();
[[nodiscard]] Scene make_spheres();
[[nodiscard]] Scene make_lamps();
[[nodiscard]] Scene make_test_room();
[[nodiscard]] Scene make_wet_yard();
[[nodiscard]] Scene make_street(std::uint32_t seed);
[[nodiscard]] Scene make_memory_room(std::uint32_t seed);

/// Each of these adds one thing to a scene and returns its index.
inline int add_mesh(Scene& scene, Mesh mesh, const std::string& name) {
    mesh.name = name;
    scene.meshes.push_back(std::move(mesh));
    return static_cast<int>(scene.meshes.size()) - 1;
}
inline int add_material(Scene& scene, Material material) {
    scene.materials.push_back(std::move(material));
    return static_cast<int>(scene.materials.size()) - 1;
}
inline int add_image(Scene& scene, Image image) {
    scene.images.push_back(std::move(image));
    return static_cast<int>(scene.images.size()) - 1;
}
inline void add_surface(Scene& scene, const std::string& name, int mesh, int material,
                        const glm::mat4& world_from_local) {
    Surface surface;
    surface.name = name;
    surface.mesh = mesh;
    surface.material = material;
    surface.world_from_local = world_from_local;
    scene.surfaces.push_back(std::move(surface));
}

}  // namespace halfframe::content
