// The list of models, and the two written scenes.
#include "perf/peers/models.h"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include <fmt/format.h>

namespace halfframe::peers {
namespace {

constexpr double kPi = std::numbers::pi;

/// A sphere of radius 1 with tangents towards growing u.
Mesh sphere(int slices, int stacks) {
    Mesh mesh;
    mesh.name = "sphere";
    for (int stack = 0; stack <= stacks; ++stack) {
        for (int slice = 0; slice <= slices; ++slice) {
            const double u = static_cast<double>(slice) / slices;
            const double v = static_cast<double>(stack) / stacks;
            const double around = 2.0 * kPi * u;
            const double down = kPi * v;
            const glm::vec3 n(static_cast<float>(std::sin(down) * std::sin(around)), static_cast<float>(std::cos(down)),
                              static_cast<float>(std::sin(down) * std::cos(around)));
            mesh.positions.push_back(n);
            mesh.normals.push_back(n);
            // glTF's bitangent points along growing v up the picture: down the sphere v grows, so the sign is +1.
            mesh.tangents.emplace_back(static_cast<float>(std::cos(around)), 0.0f,
                                       static_cast<float>(-std::sin(around)), 1.0f);
            mesh.uv.emplace_back(static_cast<float>(u), static_cast<float>(v));
        }
    }
    const auto at = [slices](int stack, int slice) { return static_cast<std::uint32_t>(stack * (slices + 1) + slice); };
    for (int stack = 0; stack < stacks; ++stack) {
        for (int slice = 0; slice < slices; ++slice) {
            const std::uint32_t a = at(stack, slice), b = at(stack + 1, slice), c = at(stack + 1, slice + 1),
                                d = at(stack, slice + 1);
            if (stack > 0) mesh.indices.insert(mesh.indices.end(), {a, b, d});
            if (stack + 1 < stacks) mesh.indices.insert(mesh.indices.end(), {b, c, d});
        }
    }
    return mesh;
}

/// Every texel from a function of u and v in 0..1 that gives 0..1.
template <typename Texel>
Image image(const char* name, bool srgb, Texel texel) {
    constexpr int kSize = 1024;
    Image result{.name = name, .width = kSize, .height = kSize, .srgb = srgb, .rgba = {}};
    for (int y = 0; y < kSize; ++y) {
        for (int x = 0; x < kSize; ++x) {
            const glm::vec3 value = glm::clamp(texel((x + 0.5) / kSize, (y + 0.5) / kSize), 0.0f, 1.0f);
            for (int i = 0; i < 3; ++i)
                result.rgba.push_back(static_cast<std::uint8_t>(std::lround(value[i] * 255.0f)));
            result.rgba.push_back(255);
        }
    }
    return result;
}

/// 0..1: two crossed waves, whole numbers of them, so that the seam does not show.
double waves(double u, double v) {
    return 0.5 + 0.25 * (std::sin(2.0 * kPi * 12.0 * u) + std::sin(2.0 * kPi * 8.0 * v));
}

bool is_tile(double u, double v) { return (static_cast<int>(u * 24.0) + static_cast<int>(v * 12.0)) % 2 == 0; }

glm::vec3 bump(double u, double v) {
    const double du = std::cos(2.0 * kPi * 12.0 * u), dv = std::cos(2.0 * kPi * 8.0 * v);
    const glm::dvec3 n = glm::normalize(glm::dvec3(-0.35 * du, 0.35 * dv, 1.0));
    return glm::vec3(n * 0.5 + 0.5);
}

}  // namespace

Scene sphere_grid() {
    Scene scene;
    scene.name = "spheres";
    scene.meshes.push_back(sphere(48, 31));
    for (int row = 0; row < 5; ++row) {
        for (int column = 0; column < 7; ++column) {
            Material material;
            material.base_color = glm::vec4(0.9f, 0.5f, 0.25f, 1.0f);
            material.metallic = static_cast<float>(column) / 6.0f;
            material.roughness = 0.1f + 0.9f * static_cast<float>(row) / 4.0f;
            Surface surface;
            surface.name = fmt::format("sphere {} {}", row, column);
            surface.material = static_cast<int>(scene.materials.size());
            surface.world_from_local[3] =
                glm::vec4(2.2f * static_cast<float>(column - 3), -2.2f * static_cast<float>(row - 2), 0.0f, 1.0f);
            scene.materials.push_back(material);
            scene.surfaces.push_back(surface);
        }
    }
    return scene;
}

Scene mapped_globe() {
    Scene scene;
    scene.name = "globe";
    scene.meshes.push_back(sphere(180, 92));
    scene.images.push_back(image("base colour", true, [](double u, double v) {
        const auto wave = static_cast<float>(waves(u, v));
        return is_tile(u, v) ? glm::vec3(0.75f, 0.55f * wave + 0.2f, 0.25f)
                             : glm::vec3(0.2f, 0.3f, 0.35f + 0.4f * wave);
    }));
    scene.images.push_back(image("metallic-roughness", false, [](double u, double v) {
        return glm::vec3(1.0f, 0.2f + 0.6f * static_cast<float>(waves(v, u)), is_tile(u, v) ? 1.0f : 0.0f);
    }));
    scene.images.push_back(image("normals", false, bump));
    scene.images.push_back(image("emission", true, [](double u, double v) {
        return waves(u, v) > 0.93 ? glm::vec3(0.9f, 0.4f, 0.1f) : glm::vec3(0.0f);
    }));
    Material material;
    material.emissive = glm::vec3(1.0f);
    material.base_color_texture.image = 0;
    material.metallic_roughness_texture.image = 1;
    material.normal_texture.image = 2;
    material.emissive_texture.image = 3;
    scene.materials.push_back(material);
    scene.surfaces.push_back({.name = "globe", .mesh = 0, .material = 0, .world_from_local = glm::mat4(1.0f)});
    return scene;
}

Camera close_camera(const Scene& scene, float aspect) {
    const Box box = world_box(scene);
    const glm::vec3 centre = 0.5f * (box.low + box.high);
    const float size = glm::length(box.high - box.low);
    // A little from the right and from above, with a long lens: flat models fill the picture, round ones show their
    // top.
    constexpr float kFov_rad = 0.35f;
    const glm::vec3 toward_eye = glm::normalize(glm::vec3(0.3f, 0.25f, 1.0f));
    Camera camera = camera_looking(centre + 10.0f * size * toward_eye, centre, kFov_rad, box);
    const float tan_y = std::tan(0.5f * kFov_rad);
    const glm::mat4 view_from_world = glm::inverse(camera.world_from_view);
    float advance = std::numeric_limits<float>::max();
    for (const Surface& surface : scene.surfaces) {
        const glm::mat4 view_from_local = view_from_world * surface.world_from_local;
        for (const glm::vec3& position : scene.meshes[static_cast<std::size_t>(surface.mesh)].positions) {
            const glm::vec4 at = view_from_local * glm::vec4(position, 1.0f);
            // How near the eye may come to this vertex: where it stands at 97 % of half the picture.
            const float nearest = std::max(std::abs(at.x) / aspect, std::abs(at.y)) / (0.97f * tan_y);
            advance = std::min(advance, -at.z - nearest);
        }
    }
    const glm::vec3 eye = centre + (10.0f * size - advance) * toward_eye;
    return camera_looking(eye, centre, kFov_rad, box);
}

std::size_t triangle_count(const Scene& scene) {
    std::size_t count = 0;
    for (const Surface& surface : scene.surfaces) {
        const Mesh& mesh = scene.meshes[static_cast<std::size_t>(surface.mesh)];
        count += (mesh.indices.empty() ? mesh.positions.size() : mesh.indices.size()) / 3;
    }
    return count;
}

std::vector<Model> models(const std::filesystem::path& folder, std::vector<std::string>& notices) {
    std::vector<Model> list;
    const auto add = [&](const char* name, const std::filesystem::path& file, const char* what, const char* from) {
        if (std::filesystem::exists(file)) {
            list.push_back({name, file, what});
        } else {
            notices.push_back(fmt::format("the model {} is left out: {} is not there ({})", name, file.string(), from));
        }
    };
    write_glb(folder / "spheres.glb", sphere_grid());
    write_glb(folder / "globe.glb", mapped_globe());
    add("spheres", folder / "spheres.glb", "35 materials without textures", "written here");
    add("globe", folder / "globe.glb", "base colour, metallic-roughness, normal and emission maps", "written here");
    add("engine", "/usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb",
        "many small parts, no textures", "Debian's assimp-testmodels");
    const char* assets = std::getenv("HALFFRAME_ASSETS");
    add("tangents",
        std::filesystem::path(assets ? assets : "HALFFRAME_ASSETS") /
            "khronos/NormalTangentTest/glTF-Binary/NormalTangentTest.glb",
        "base colour, metallic-roughness, normal and occlusion maps", "HALFFRAME_ASSETS names the folder");
    return list;
}

}  // namespace halfframe::peers
