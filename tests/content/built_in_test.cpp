// Built-in scenes and the studio rig.
#include <cmath>

#include <gtest/gtest.h>

#include "content/content.h"
#include "engine/error.h"

namespace halfframe::tests {
namespace {

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

TEST(BuiltIn, TheListAndOpenSceneAgree) {
    ASSERT_EQ(content::built_in_scenes().size(), 9u);
    for (const content::BuiltInScene& each : content::built_in_scenes()) {
        EXPECT_EQ(content::open_scene(std::string(each.name)).name, each.name);
        EXPECT_FALSE(each.purpose.empty());
    }
}

TEST(BuiltIn, EverySceneKeepsThePromisesOfScene) {
    for (const content::BuiltInScene& each : content::built_in_scenes()) {
        const Scene scene = each.make();
        ASSERT_FALSE(scene.cameras.empty()) << each.name;
        for (const Mesh& mesh : scene.meshes) {
            ASSERT_FALSE(mesh.positions.empty());
            ASSERT_EQ(mesh.normals.size(), mesh.positions.size()) << mesh.name;
            ASSERT_EQ(mesh.tangents.size(), mesh.positions.size()) << mesh.name;
            ASSERT_EQ(mesh.uv.size(), mesh.positions.size()) << mesh.name;
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                EXPECT_TRUE(finite(mesh.positions[i])) << mesh.name;
                EXPECT_NEAR(glm::length(mesh.normals[i]), 1.0f, 1e-5) << mesh.name;  // rounding of sines and cosines
            }
            for (const std::uint32_t index : mesh.indices) {
                ASSERT_LT(index, mesh.positions.size()) << mesh.name;
            }
        }
        for (const Surface& surface : scene.surfaces) {
            EXPECT_LT(surface.mesh, static_cast<int>(scene.meshes.size()));
            EXPECT_LT(surface.material, static_cast<int>(scene.materials.size()));
        }
        for (const Material& material : scene.materials) {
            for (const Texture& texture : {material.base_color_texture, material.metallic_roughness_texture,
                                           material.normal_texture, material.emissive_texture}) {
                EXPECT_LT(texture.image, static_cast<int>(scene.images.size())) << material.name;
            }
        }
        for (const Light& light : scene.lights) {
            EXPECT_NEAR(glm::length(light.direction), 1.0f, 1e-6) << light.name;  // rounding of one normalize
            EXPECT_GE(std::min({light.color.x, light.color.y, light.color.z}), 0.0f) << light.name;
            EXPECT_LE(light.inner_cone_rad, light.outer_cone_rad) << light.name;
        }
        for (const Camera& camera : scene.cameras) {
            EXPECT_GT(camera.near_m, 0.0f) << camera.name;
            EXPECT_LT(camera.near_m, camera.far_m) << camera.name;
        }
    }
}

TEST(BuiltIn, TheRoomHasOneOfEverything) {
    const Scene room = content::open_scene("test_room");
    const Box box = world_box(room);
    // 1e-5: quarter turns by float sines.
    EXPECT_NEAR(box.low.x, -3.2f, 1e-5);  // roof and walls towards the sun are 20 cm thick
    EXPECT_NEAR(box.high.x, 3.2f, 1e-5);
    EXPECT_NEAR(box.low.y, -0.2f, 1e-5);
    EXPECT_NEAR(box.high.y, 3.2f, 1e-5);
    EXPECT_NEAR(box.high.z, 2.2f, 1e-5);
    int kinds[3] = {};
    for (const Light& light : room.lights) {
        ++kinds[static_cast<int>(light.kind)];
    }
    EXPECT_EQ(kinds[0], 1);
    EXPECT_EQ(kinds[1], 2);
    EXPECT_EQ(kinds[2], 1);
    int modes[3] = {};
    for (const Material& material : room.materials) {
        ++modes[static_cast<int>(material.alpha_mode)];
    }
    EXPECT_GT(modes[0], 0);
    EXPECT_EQ(modes[1], 1);
    EXPECT_EQ(modes[2], 1);
    ASSERT_EQ(room.cameras.size(), 2u);
    EXPECT_EQ(room.cameras[0].name, "door");
    EXPECT_EQ(room.cameras[1].name, "corner");
    for (const Camera& camera : room.cameras) {
        const glm::vec3 eye(camera.world_from_view[3]);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_GT(eye[axis], box.low[axis]) << camera.name;
            EXPECT_LT(eye[axis], box.high[axis]) << camera.name;
        }
    }
}

TEST(BuiltIn, TheFloorsTexturesAreSound) {
    const Scene room = content::open_scene("test_room");
    ASSERT_EQ(room.images.size(), 4u);
    const Image& normal = room.images.at(1);
    EXPECT_FALSE(normal.srgb);
    double shortest = 2.0;
    double flattest = 2.0;
    for (std::size_t i = 0; i < normal.rgba.size(); i += 4) {
        const glm::dvec3 n = glm::dvec3(normal.rgba[i], normal.rgba[i + 1], normal.rgba[i + 2]) / 127.5 - 1.0;
        shortest = std::min(shortest, glm::length(n));
        flattest = std::min(flattest, n.z);
    }
    EXPECT_NEAR(shortest, 1.0, 0.01);  // 8 bits a channel
    EXPECT_LT(flattest, 0.95) << "there are bevels";
    const Image& grille = room.images.at(3);
    bool hole = false;
    bool bar = false;
    for (std::size_t i = 3; i < grille.rgba.size(); i += 4) {
        hole = hole || grille.rgba[i] == 0;
        bar = bar || grille.rgba[i] == 255;
    }
    EXPECT_TRUE(hole && bar);
}

TEST(BuiltIn, TheFurnaceIsWhiteAllAround) {
    const Scene furnace = content::open_scene("furnace");
    EXPECT_TRUE(furnace.lights.empty());
    EXPECT_EQ(furnace.surfaces.size(), 3u);
    ASSERT_TRUE(furnace.sky.has_value());
    EXPECT_EQ(furnace.sky->zenith, furnace.sky->ground);
    EXPECT_EQ(furnace.sky->zenith, furnace.background);
    // The inverse of the tone curve, y = 1.0275 x / (x + 0.22), gives the ambient back.
    const float y = furnace.sky->zenith.x;
    EXPECT_NEAR(0.22f * y / (1.0275f - y), furnace.ambient.x, 1e-6);  // float rounding
}

TEST(BuiltIn, UnknownNamesOfferTheNearest) {
    try {
        (void)content::open_scene("test_rom");
        FAIL() << "opened";
    } catch (const Error& error) {
        EXPECT_EQ(error.fault(), Fault::input);
        EXPECT_NE(std::string(error.what()).find("did you mean 'test_room'?"), std::string::npos) << error.what();
        EXPECT_NE(
            std::string(error.what()).find("furnace, test_room, spheres, charts, lamps, wet_yard, street, memory_room, empty"),
            std::string::npos)
            << error.what();
    }
}

TEST(StudioRig, LightsASceneWithoutLightsOnly) {
    Scene room = content::open_scene("test_room");
    const std::size_t before = room.lights.size();
    EXPECT_FALSE(content::add_studio_rig(room));
    EXPECT_EQ(room.lights.size(), before);
    Scene furnace = content::open_scene("furnace");
    EXPECT_FALSE(content::add_studio_rig(furnace)) << "its ambient is its light";
    EXPECT_TRUE(furnace.lights.empty());

    for (const float size : {0.01f, 1.0f, 500.0f}) {
        Scene scene = content::open_scene("furnace");
        for (Surface& surface : scene.surfaces) {
            surface.world_from_local = glm::mat4(glm::mat3(size)) * surface.world_from_local;
            surface.world_from_local[3] = glm::vec4(glm::vec3(surface.world_from_local[3]), 1.0f);
        }
        scene.sky.reset();
        scene.ambient = glm::vec3(0.0f);
        const Box box = world_box(scene);
        const float radius_m = 0.5f * glm::length(box.high - box.low);
        ASSERT_TRUE(content::add_studio_rig(scene));
        ASSERT_EQ(scene.lights.size(), 3u);
        EXPECT_FALSE(scene.sky.has_value()) << "the rig brings lights, no sky";
        EXPECT_EQ(scene.lights[0].kind, LightKind::sun);
        for (std::size_t i = 1; i < 3; ++i) {
            const Light& light = scene.lights[i];
            const float distance_m = glm::length(light.position - 0.5f * (box.low + box.high));
            EXPECT_GT(distance_m, radius_m);
            // At the centre a point of the rig is as bright whatever the size of the scene; 1e-3: float rounding.
            EXPECT_NEAR(light.color.x / (distance_m * distance_m), i == 1 ? 0.12f : 0.20f, 1e-3);
            EXPECT_GT(light.range_m, distance_m + radius_m) << "reaches the far side";
        }
    }
    Scene empty = content::open_scene("empty");
    EXPECT_TRUE(content::add_studio_rig(empty));
}

}  // namespace
}  // namespace halfframe::tests
