// Splinters of glass round the path, and frames that hold what is remembered.
#include <array>
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "content/built_in.h"
#include "content/memory_room/memory_room.h"
#include "content/random.h"

namespace halfframe::content::memory_room {

namespace {

/// A flat splinter of 4 to 6 corners round the origin, facing +z; uv 0..1 over it.
Mesh splinter(Random& random, float size_m) {
    Mesh mesh;
    const int corners = 4 + random.below(3);
    mesh.positions.emplace_back(0.0f);
    for (int i = 0; i < corners; ++i) {
        const double angle = glm::two_pi<double>() * (i + 0.5 * static_cast<double>(random.unit())) / corners;
        const float radius = size_m * random.between(0.45f, 1.0f);
        mesh.positions.emplace_back(0.55f * radius * static_cast<float>(std::cos(angle)),
                                    radius * static_cast<float>(std::sin(angle)), 0.0f);
    }
    for (const glm::vec3& at : mesh.positions) {
        mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
        mesh.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
        mesh.uv.emplace_back(0.5f + 0.5f * at.x / size_m, 0.5f - 0.5f * at.y / size_m);
    }
    for (int i = 0; i < corners; ++i) {
        for (const int corner : {0, 1 + i, 1 + (i + 1) % corners})
            mesh.indices.push_back(static_cast<std::uint32_t>(corner));
    }
    return mesh;
}

/// Its rim: a band of light along the edges, 6 % wide.
Mesh rim_of(const Mesh& shard) {
    Mesh rim;
    const std::size_t corners = shard.positions.size() - 1;
    for (std::size_t i = 0; i <= corners; ++i) {
        const glm::vec3 at = shard.positions[1 + i % corners];
        for (const float scale : {1.0f, 0.94f}) {
            rim.positions.push_back(at * scale + glm::vec3(0.0f, 0.0f, 0.004f));
            rim.normals.emplace_back(0.0f, 0.0f, 1.0f);
            rim.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
            rim.uv.emplace_back(static_cast<float>(i), scale);
        }
    }
    for (std::uint32_t i = 0; i < corners; ++i) {
        const std::uint32_t outer = 2 * i;
        for (const std::uint32_t corner : {outer, outer + 2, outer + 1, outer + 1, outer + 2, outer + 3})
            rim.indices.push_back(corner);
    }
    return rim;
}

glm::mat4 placed(const glm::vec3& at, float yaw_rad, float pitch_rad, float roll_rad) {
    glm::mat4 place = glm::translate(glm::mat4(1.0f), at);
    place = glm::rotate(place, yaw_rad, {0.0f, 1.0f, 0.0f});
    place = glm::rotate(place, pitch_rad, {1.0f, 0.0f, 0.0f});
    return glm::rotate(place, roll_rad, {0.0f, 0.0f, 1.0f});
}

/// A square ring `width_m` of half `half`, its bars `bar_m` wide, facing +z.
Mesh ring(const glm::vec2& half, float bar_m) {
    Mesh mesh;
    const std::array<glm::vec2, 4> corners{{{-1.0f, -1.0f}, {1.0f, -1.0f}, {1.0f, 1.0f}, {-1.0f, 1.0f}}};
    for (const glm::vec2& corner : corners) {
        for (const float grow : {bar_m, 0.0f}) {
            mesh.positions.emplace_back(corner * (half + grow), 0.0f);
            mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
            mesh.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
            mesh.uv.emplace_back(0.5f + 0.5f * corner.x, 0.5f - 0.5f * corner.y);
        }
    }
    for (std::uint32_t i = 0; i < 4; ++i) {
        const std::uint32_t outer = 2 * i;
        const std::uint32_t next = 2 * ((i + 1) % 4);
        for (const std::uint32_t corner : {outer, next, outer + 1, outer + 1, next, next + 1})
            mesh.indices.push_back(corner);
    }
    return mesh;
}

Mesh pane(const glm::vec2& half) {
    Mesh mesh;
    for (const glm::vec2 corner :
         {glm::vec2(-1.0f, -1.0f), glm::vec2(1.0f, -1.0f), glm::vec2(1.0f, 1.0f), glm::vec2(-1.0f, 1.0f)}) {
        mesh.positions.emplace_back(corner * half, 0.0f);
        mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
        mesh.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
        mesh.uv.emplace_back(0.5f + 0.5f * corner.x, 0.5f - 0.5f * corner.y);
    }
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return mesh;
}

}  // namespace

void add_shards(Scene& scene, const Glass& glass, std::uint32_t seed) {
    Random random(seed, 1);
    constexpr int kShards = 54;
    for (int i = 0; i < kShards; ++i) {
        // Nearer together far away, none on the path itself.
        const float depth = 1.0f + 26.0f * static_cast<float>(i) / kShards + random.between(0.0f, 0.6f);
        const float side = i % 2 == 0 ? 1.0f : -1.0f;
        const glm::vec3 at(side * random.between(1.0f, 4.6f), random.between(0.3f, 4.4f), -depth);
        const Mesh shard = splinter(random, random.between(0.35f, 1.25f));
        const glm::mat4 place =
            placed(at, -side * random.between(0.2f, 0.9f), random.between(-0.4f, 0.4f), random.between(-0.7f, 0.7f));
        const std::string name = "shard " + std::to_string(i);
        add_surface(scene, name + " rim", add_mesh(scene, rim_of(shard), name + " rim"), glass.edge, place);
        add_surface(scene, name, add_mesh(scene, shard, name), i % 3 == 0 ? glass.milky : glass.clear, place);
    }
}

void add_frames(Scene& scene, const Glass& glass, std::uint32_t seed) {
    Random random(seed, 2);
    constexpr int kFrames = 9;
    for (int i = 0; i < kFrames; ++i) {
        const float depth = 3.0f + 2.7f * static_cast<float>(i);
        const float side = i % 2 == 0 ? -1.0f : 1.0f;
        const glm::vec2 half(random.between(0.6f, 1.1f), random.between(0.5f, 0.9f));
        const glm::vec3 at(side * random.between(1.1f, 1.9f), random.between(1.5f, 2.4f), -depth);
        const glm::mat4 place = placed(at, -side * random.between(0.25f, 0.6f), 0.0f, random.between(-0.05f, 0.05f));
        const std::string name = "frame " + std::to_string(i);
        add_surface(scene, name, add_mesh(scene, ring(half, 0.045f), name), glass.line, place);
        add_surface(scene, name + " picture", add_mesh(scene, pane(half), name + " picture"), glass.picture, place);
    }
    // Gates: the path leads through them.
    for (int i = 0; i < 6; ++i) {
        const float depth = 4.5f + 4.2f * static_cast<float>(i);
        const std::string name = "gate " + std::to_string(i);
        add_surface(scene, name, add_mesh(scene, ring({1.25f, 1.45f}, 0.05f), name), glass.edge,
                    placed({0.25f * std::sin(static_cast<float>(i)), 1.5f, -depth}, 0.0f, 0.0f,
                           0.03f * static_cast<float>(i % 3 - 1)));
    }
}

}  // namespace halfframe::content::memory_room
