// Strips on bones, and a square that grows.
#include "tests/motion/moving_scenes.h"

#include <algorithm>
#include <cmath>

#include <glm/gtc/matrix_transform.hpp>

namespace halfframe::tests {
namespace {

constexpr float kHalfWidth = 0.25f;

void add_surface(Scene& scene, Mesh mesh, int node, int skin) {
    if (scene.materials.empty()) scene.materials.push_back({.name = "plain", .metallic = 0.0f, .double_sided = true});
    scene.meshes.push_back(std::move(mesh));
    scene.surfaces.push_back({.name = scene.meshes.back().name,
                              .mesh = static_cast<int>(scene.meshes.size()) - 1,
                              .material = 0,
                              .dynamic = node >= 0 || skin >= 0,
                              .node = node,
                              .skin = skin});
}

Mesh strip(int rows) {
    Mesh mesh;
    mesh.name = "strip";
    for (int row = 0; row < rows; ++row) {
        const float y = 2.0f * static_cast<float>(row) / static_cast<float>(rows - 1);
        for (const float x : {-kHalfWidth, kHalfWidth}) {
            mesh.positions.emplace_back(x, y, 0.0f);
            mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
        }
        if (row == 0) continue;
        const auto at = static_cast<std::uint32_t>(2 * row);
        mesh.indices.insert(mesh.indices.end(), {at - 2, at - 1, at, at, at - 1, at + 1});
    }
    return mesh;
}

AnimationChannel bend(int node) {
    const float half = std::sqrt(0.5f);
    return {.node = node,
            .value = AnimatedValue::rotation,
            .interpolation = Interpolation::linear,
            .times_s = {0.0f, 1.0f},
            .values = {0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, half, half}};
}

}  // namespace

Scene two_bones(const glm::vec3& away) {
    Scene scene;
    scene.name = "two_bones";
    Mesh mesh = strip(9);
    for (const glm::vec3& at : mesh.positions) {
        const float upper = std::clamp((at.y - 0.75f) / 0.5f, 0.0f, 1.0f);
        mesh.joints.emplace_back(0, 1, 0, 0);
        mesh.weights.emplace_back(1.0f - upper, upper, 0.0f, 0.0f);
    }
    scene.nodes.push_back({.name = "lower", .translation = away});
    scene.nodes.push_back({.name = "upper", .parent = 0, .translation = {0.0f, 1.0f, 0.0f}});
    scene.skins.push_back(
        {.name = "bones",
         .joints = {0, 1},
         .joint_from_mesh = {glm::mat4(1.0f), glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, -1.0f, 0.0f))}});
    scene.animations.push_back({.name = "bend", .channels = {bend(1)}, .duration_s = 1.0f});
    add_surface(scene, std::move(mesh), -1, 0);
    return scene;
}

Scene many_bones(int joints) {
    Scene scene;
    scene.name = "many_bones";
    Mesh mesh = strip(joints);
    Skin skin{.name = "bones", .joints = {}, .joint_from_mesh = {}};
    for (int joint = 0; joint < joints; ++joint) {
        for (int side = 0; side < 2; ++side) {
            mesh.joints.emplace_back(static_cast<std::uint16_t>(joint), 0, 0, 0);
            mesh.weights.emplace_back(1.0f, 0.0f, 0.0f, 0.0f);
        }
        const float y = mesh.positions[static_cast<std::size_t>(2 * joint)].y;
        scene.nodes.push_back({.name = "bone", .translation = {0.0f, y, 0.0f}});
        skin.joints.push_back(joint);
        skin.joint_from_mesh.push_back(glm::translate(glm::mat4(1.0f), glm::vec3(0.0f, -y, 0.0f)));
    }
    scene.skins.push_back(std::move(skin));
    scene.animations.push_back({.name = "bend", .channels = {bend(joints - 1)}, .duration_s = 1.0f});
    add_surface(scene, std::move(mesh), -1, 0);
    return scene;
}

Scene morphing_square() {
    Scene scene;
    scene.name = "morphing_square";
    Mesh mesh;
    mesh.name = "square";
    mesh.positions = {{-0.5f, -0.5f, 0.0f}, {0.5f, -0.5f, 0.0f}, {0.5f, 0.5f, 0.0f}, {-0.5f, 0.5f, 0.0f}};
    mesh.normals.assign(4, {0.0f, 0.0f, 1.0f});
    mesh.indices = {0, 1, 2, 0, 2, 3};
    MorphTarget lift{.name = "lift", .positions = {}, .normals = {}, .tangents = {}};
    lift.positions.assign(4, {0.0f, 1.0f, 0.0f});
    MorphTarget widen{.name = "widen", .positions = {}, .normals = {}, .tangents = {}};
    for (const glm::vec3& at : mesh.positions) widen.positions.emplace_back(at.x, 0.0f, 0.0f);
    mesh.morph_targets = {lift, widen};
    scene.nodes.push_back({.name = "square", .morph_weights = {0.0f, 0.0f}});
    scene.animations.push_back({.name = "grow",
                                .channels = {{.node = 0,
                                              .value = AnimatedValue::morph_weights,
                                              .interpolation = Interpolation::linear,
                                              .times_s = {0.0f, 1.0f},
                                              .values = {0.0f, 0.0f, 1.0f, 1.0f}}},
                                .duration_s = 1.0f});
    add_surface(scene, std::move(mesh), 0, -1);
    return scene;
}

Scene moving_scene() {
    Scene scene = two_bones();
    scene.name = "moving_scene";
    const Scene square = morphing_square();
    Mesh mesh = square.meshes[0];
    for (glm::vec3& at : mesh.positions) at += glm::vec3(1.5f, 0.6f, 0.0f);
    scene.nodes.push_back(square.nodes[0]);
    AnimationChannel grow = square.animations[0].channels[0];
    grow.node = 2;
    scene.animations[0].channels.push_back(grow);
    add_surface(scene, std::move(mesh), 2, -1);
    Mesh ground;
    ground.name = "ground";
    ground.positions = {{-3.0f, 0.0f, -3.0f}, {-3.0f, 0.0f, 3.0f}, {3.0f, 0.0f, 3.0f}, {3.0f, 0.0f, -3.0f}};
    ground.normals.assign(4, {0.0f, 1.0f, 0.0f});
    ground.indices = {0, 1, 2, 0, 2, 3};
    add_surface(scene, std::move(ground), -1, -1);
    scene.lights.push_back({.kind = LightKind::sun,
                            .name = "sun",
                            .color = glm::vec3(1.0f),
                            .direction = glm::normalize(glm::vec3(-0.3f, -1.0f, -0.5f))});
    scene.lights.push_back({.kind = LightKind::point, .name = "lamp", .position = {0.0f, 1.0f, 1.0f}});
    scene.ambient = glm::vec3(0.1f);
    return scene;
}

}  // namespace halfframe::tests
