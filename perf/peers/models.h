// The models that are compared: real ones where they are installed, and two that are written here.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/frame/scene.h"

namespace halfframe::peers {

struct Model {
    std::string name;
    std::filesystem::path file;  ///< .glb
    std::string what;            ///< in a few words
};

/// Every model there is on this machine; those that are written here go into `folder`. What is missing is said in
/// `notices`.
[[nodiscard]] std::vector<Model> models(const std::filesystem::path& folder, std::vector<std::string>& notices);

/// A scene as a .glb file: positions, normals, tangents, uv, materials and their textures (as PNG).
void write_glb(const std::filesystem::path& file, const Scene& scene);

/// 7 x 5 spheres, metallic from left to right, roughness from top to bottom, no textures: 35 x 2880 triangles.
[[nodiscard]] Scene sphere_grid();
/// One sphere over the height of the picture with all four maps of 1024 x 1024: 32 760 triangles.
[[nodiscard]] Scene mapped_globe();

/// A camera from the front that stands as near as it can: the outermost vertex is 3 % inside the picture. Empty
/// background costs every renderer nearly the same and would hide the differences.
[[nodiscard]] Camera close_camera(const Scene& scene, float aspect);

[[nodiscard]] std::size_t triangle_count(const Scene& scene);

}  // namespace halfframe::peers
