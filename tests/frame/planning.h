// Caps, scenes and views for tests of planning, which needs no context.
#pragma once

#include "engine/frame/frame_plan.h"

namespace halfframe::tests {

/// A device that can do everything the plan asks about.
inline gl::Caps able_caps() {
    gl::Caps caps;
    caps.renderer = "a device made up for tests";
    caps.es_version = 30;
    caps.max_texture_size = 4096;
    caps.max_renderbuffer_size = 4096;
    caps.max_vertex_attributes = 16;
    caps.max_vertex_uniform_vectors = 256;
    caps.max_fragment_uniform_vectors = 224;
    caps.max_varying_vectors = 15;
    caps.max_fragment_samplers = 16;
    caps.sized_formats = true;
    caps.srgb_textures = true;
    caps.float_blend = true;
    caps.renders.fill(true);
    return caps;
}

/// Plain ES 2.0: 8-bit targets and 16-bit depth.
inline gl::Caps poor_caps() {
    gl::Caps caps = able_caps();
    caps.device = "a poor device";
    caps.es_version = 20;
    caps.fragment_highp = false;
    caps.sized_formats = false;
    caps.renders.fill(false);
    caps.renders[static_cast<std::size_t>(gl::PixelFormat::rgba8)] = true;
    caps.renders[static_cast<std::size_t>(gl::PixelFormat::depth16)] = true;
    return caps;
}

inline gl::Caps without(gl::Caps caps, std::initializer_list<gl::PixelFormat> formats) {
    for (const gl::PixelFormat format : formats) caps.renders[static_cast<std::size_t>(format)] = false;
    return caps;
}

/// One square of 1 m at z = 0, facing +Z.
inline Scene square_scene() {
    Scene scene;
    scene.name = "square";
    Mesh mesh;
    mesh.name = "square";
    mesh.positions = {{-0.5f, -0.5f, 0.0f}, {0.5f, -0.5f, 0.0f}, {0.5f, 0.5f, 0.0f}, {-0.5f, 0.5f, 0.0f}};
    mesh.normals.assign(4, {0.0f, 0.0f, 1.0f});
    mesh.tangents.assign(4, {1.0f, 0.0f, 0.0f, 1.0f});
    mesh.uv = {{0.0f, 1.0f}, {1.0f, 1.0f}, {1.0f, 0.0f}, {0.0f, 0.0f}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    scene.meshes.push_back(mesh);
    scene.materials.push_back({});
    scene.surfaces.push_back(
        {.name = "square", .mesh = 0, .material = 0, .world_from_local = glm::mat4(1.0f), .dynamic = false});
    return scene;
}

/// From 2 m in front of the square; it covers about a third of the picture.
inline View square_view(int width = 64, int height = 64) {
    Camera camera;
    camera.world_from_view[3] = {0.0f, 0.0f, 2.0f, 1.0f};
    return view_of(camera, width, height);
}

inline FramePlan plan(const Scene& scene, const Wishes& wishes = {}, const gl::Caps& caps = able_caps()) {
    return plan_frame(scene, square_view(), wishes, caps, all_effects());
}

inline std::vector<std::string> pass_names(const FramePlan& frame_plan) {
    std::vector<std::string> names;
    for (const Pass& pass : frame_plan.passes) names.push_back(pass.name);
    return names;
}

}  // namespace halfframe::tests
