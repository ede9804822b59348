// The changes of scenes do what they say, by the numbers.
#include "perf/accuracy/scene_changes.h"

#include <gtest/gtest.h>

namespace halfframe::accuracy {
namespace {

Shot small_shot() {
    Shot shot;
    Mesh mesh;
    mesh.positions = {{0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}};
    mesh.normals.assign(3, {0.0f, 0.0f, 1.0f});
    mesh.indices = {0, 1, 2};
    shot.scene.meshes.push_back(mesh);
    shot.scene.surfaces.push_back({});
    shot.scene.surfaces[0].world_from_local[3] = {-2.2f, 2.1f, 0.9f, 1.0f};
    shot.scene.lights.push_back({.kind = LightKind::sun, .color = glm::vec3(1.0f), .direction = {1.0f, 0.0f, 0.0f}});
    shot.scene.lights.push_back({.color = glm::vec3(2.0f), .position = {1.0f, 2.0f, 3.0f}, .range_m = 5.0f});
    shot.camera.world_from_view[3] = {0.1f, 0.2f, 0.3f, 1.0f};
    return shot;
}

TEST(SceneChanges, PlacesFarAwayKeepTheStepsOfFloats) {
    const glm::dvec3 offset(4800.0, 6000.0, 6400.0);
    const Shot far = moved(small_shot(), offset);
    EXPECT_EQ(far.scene.surfaces[0].world_from_local[3].x, 4797.7998046875f);
    const Shot back = with_places_of(small_shot(), offset);
    EXPECT_EQ(back.scene.surfaces[0].world_from_local[3].x, -2.2001953125f);  // not -2.2: what a float keeps there
    EXPECT_EQ(back.scene.lights[1].position, glm::vec3(1.0f, 2.0f, 3.0f));
    EXPECT_NE(back.camera.world_from_view[3].x, 0.1f);
}

TEST(SceneChanges, ALampsColourGrowsWithTheSquareOfTheUnit) {
    const Shot small = in_units(small_shot(), 1000.0);
    EXPECT_EQ(small.scene.meshes[0].positions[1].x, 1000.0f);
    EXPECT_EQ(small.scene.lights[0].color.x, 1.0f);
    EXPECT_EQ(small.scene.lights[1].color.x, 2e6f);
    EXPECT_EQ(small.scene.lights[1].range_m, 5000.0f);
    EXPECT_EQ(small.camera.near_m, 100.0f);
}

TEST(SceneChanges, FourQuarterTurnsAreNone) {
    const Shot once = turned(small_shot(), 1);
    EXPECT_EQ(once.scene.lights[0].direction, glm::vec3(0.0f, 0.0f, -1.0f));
    EXPECT_EQ(once.scene.lights[1].position, glm::vec3(3.0f, 2.0f, -1.0f));
    const Shot full = turned(small_shot(), 4);
    EXPECT_EQ(full.scene.surfaces[0].world_from_local, small_shot().scene.surfaces[0].world_from_local);
    EXPECT_EQ(full.camera.world_from_view, small_shot().camera.world_from_view);
}

TEST(SceneChanges, HalvesOfLampsAddUpAndTheSunIsWhole) {
    const Shot halved = with_lamps_halved(small_shot());
    ASSERT_EQ(halved.scene.lights.size(), 3u);
    EXPECT_EQ(halved.scene.lights[0].color.x, 1.0f);
    EXPECT_EQ(halved.scene.lights[1].color.x + halved.scene.lights[2].color.x, 2.0f);
}

TEST(SceneChanges, ExposureTakesBackWhatLightGains) {
    const Shot exposed = exposed_for(small_shot(), 1e4f);
    EXPECT_EQ(exposed.scene.lights[0].color.x, 1e4f);
    EXPECT_EQ(exposed.camera.exposure, 1e-4f);
}

TEST(SceneChanges, WhatMovesGoesAlongWithItsCourse) {
    Shot shot = small_shot();
    shot.scene.nodes = {{.name = "root", .translation = {1.0f, 2.0f, 3.0f}},
                        {.name = "child", .parent = 0, .translation = {0.5f, 0.0f, 0.0f}}};
    shot.scene.skins = {{.name = "skin", .joints = {0, 1}, .joint_from_mesh = {glm::mat4(1.0f), glm::mat4(1.0f)}}};
    shot.scene.skins[0].joint_from_mesh[1][3] = {0.0f, -2.0f, 0.0f, 1.0f};
    const auto channel = [](int node) {
        return AnimationChannel{.node = node, .times_s = {0.0f, 2.0f}, .values = {1.0f, 2.0f, 3.0f, 1.0f, 2.0f, 5.0f}};
    };
    shot.scene.animations = {{.name = "walk", .channels = {channel(0), channel(1)}, .duration_s = 2.0f}};
    const Shot away = moved(shot, {100.0, 0.0, 0.0});
    EXPECT_EQ(away.scene.nodes[0].translation, glm::vec3(101.0f, 2.0f, 3.0f));
    EXPECT_EQ(away.scene.nodes[1].translation, glm::vec3(0.5f, 0.0f, 0.0f)) << "it is relative to its parent";
    EXPECT_EQ(away.scene.animations[0].channels[0].values[3], 101.0f);
    EXPECT_EQ(away.scene.animations[0].channels[1].values[3], 1.0f);
    const Shot small = in_units(shot, 1000.0);
    EXPECT_EQ(small.scene.nodes[1].translation, glm::vec3(500.0f, 0.0f, 0.0f));
    EXPECT_EQ(small.scene.skins[0].joint_from_mesh[1][3].y, -2000.0f);
    EXPECT_EQ(small.scene.animations[0].channels[1].values[5], 5000.0f);
    const Shot later = at_time(shot, 5.0);  // the second round's middle
    EXPECT_EQ(later.scene.nodes[0].translation, glm::vec3(1.0f, 2.0f, 4.0f));
}

TEST(SceneChanges, ExposureTakesBackWhatTheEnvironmentGains) {
    Shot shot = small_shot();
    shot.scene.environment = EnvironmentMap{.size = 1, .levels = {{glm::vec3(2.0f)}}};
    shot.scene.environment->irradiance[0] = glm::vec3(3.0f);
    const Shot exposed = exposed_for(shot, 100.0f);
    EXPECT_EQ(exposed.scene.environment->levels[0][0], glm::vec3(200.0f));
    EXPECT_EQ(exposed.scene.environment->irradiance[0], glm::vec3(300.0f));
}

TEST(SceneChanges, TheAddedTrianglesHaveNoArea) {
    const Mesh mesh = with_empty_triangles(small_shot()).scene.meshes[0];
    ASSERT_EQ(mesh.indices.size(), 15u);
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const glm::vec3 a = mesh.positions.at(mesh.indices[i]);
        const glm::vec3 edge = mesh.positions.at(mesh.indices[i + 1]) - a;
        const glm::vec3 other = mesh.positions.at(mesh.indices[i + 2]) - a;
        EXPECT_EQ(glm::length(glm::cross(edge, other)), i < 12 ? 0.0f : 1.0f) << i;
    }
    EXPECT_EQ(mesh.normals.size(), mesh.positions.size());
}

}  // namespace
}  // namespace halfframe::accuracy
