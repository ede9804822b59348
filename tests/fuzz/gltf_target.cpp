// Writes the bytes beside two files that they may refer to, loads them, and checks the scene.
#include "tests/fuzz/gltf_target.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>

#include "content/content.h"
#include "engine/error.h"
#include "tests/content/temporary_gltf.h"

namespace halfframe::tests {
namespace {

const TemporaryFolder& folder() {
    static const TemporaryFolder once;
    static const bool filled = [] {
        once.write("data.bin", triangle_bytes());
        once.write("picture.png", two_pixel_png());
        return true;
    }();
    (void)filled;
    return once;
}

[[noreturn]] void stop(const std::string& why) {
    std::fputs(fmt::format("fuzz: {}\n", why).c_str(), stderr);
    std::abort();
}

void check_mesh(const Mesh& mesh) {
    const auto fits = [&](std::size_t size) { return size == 0 || size == mesh.positions.size(); };
    if (!fits(mesh.normals.size()) || !fits(mesh.tangents.size()) || !fits(mesh.uv.size()) || !fits(mesh.uv1.size()) ||
        !fits(mesh.colors.size())) {
        stop("streams of different lengths");
    }
    for (const std::uint32_t index : mesh.indices) {
        if (index >= mesh.positions.size()) stop("an index past the last vertex");
    }
    for (const glm::vec3& position : mesh.positions) {
        if (!std::isfinite(position.x + position.y + position.z)) stop("a position that is not finite");
    }
}

void check_scene(const Scene& scene) {
    for (const Mesh& mesh : scene.meshes) check_mesh(mesh);
    const auto in = [](int index, std::size_t count) { return index >= 0 && static_cast<std::size_t>(index) < count; };
    for (const Surface& surface : scene.surfaces) {
        if (!in(surface.mesh, scene.meshes.size()) || !in(surface.material, scene.materials.size()))
            stop("a surface without mesh or material");
    }
    for (const Material& material : scene.materials) {
        for (const Texture* texture :
             {&material.base_color_texture, &material.metallic_roughness_texture, &material.normal_texture,
              &material.emissive_texture, &material.occlusion_texture, &material.specular_texture,
              &material.specular_color_texture, &material.specular_smoothness_texture}) {
            if (*texture && !in(texture->image, scene.images.size())) stop("a texture without an image");
        }
    }
    for (const Light& light : scene.lights) {
        if (!(light.range_m > 0.0f) || !std::isfinite(light.color.r + light.color.g + light.color.b))
            stop("a light without range or colour");
    }
}

}  // namespace

bool load_bytes(std::string_view bytes) {
    const bool binary = bytes.starts_with("glTF");
    const char* name = binary ? "model.glb" : "model.gltf";
    std::filesystem::remove(folder().path() / name);  // ext4 flushes a file that is cut to nothing and written again
    return load_file(folder().write(name, std::string(bytes)));
}

bool load_file(const std::filesystem::path& file) {
    try {
        check_scene(content::load_gltf(file));
        return true;
    } catch (const Error& error) {
        if (error.fault() != Fault::input) stop(fmt::format("an error of another kind: {}", error.what()));
        if (!std::string_view(error.what()).starts_with(file.string())) stop("the file is not named");
        return false;
    }
}

}  // namespace halfframe::tests
