// The scenes that are made from a seed, and walks over their triangles.
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>

#include "content/content.h"
#include "content/memory_room/memory_room.h"
#include "content/street/street.h"

namespace halfframe::tests {

/// Seeds that every test of form tries; 2084 is the scenes' own.
constexpr std::array<std::uint32_t, 3> kSeeds{2084, 1, 4294967295u};

/// Made once in a run: a street takes about a second.
inline const Scene& made(const std::string& name, std::uint32_t seed = 2084) {
    static std::map<std::pair<std::string, std::uint32_t>, Scene> scenes;
    const auto [found, is_new] = scenes.try_emplace({name, seed});
    if (is_new) found->second = content::open_scene(name, {.seed = seed});
    return found->second;
}

template <typename Function>
void each_triangle(const Mesh& mesh, Function&& function) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        function(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]);
}

inline const Material& material_of(const Scene& scene, const Surface& surface) {
    return scene.materials[static_cast<std::size_t>(surface.material)];
}
inline const Mesh& mesh_of(const Scene& scene, const Surface& surface) {
    return scene.meshes[static_cast<std::size_t>(surface.mesh)];
}

}  // namespace halfframe::tests
