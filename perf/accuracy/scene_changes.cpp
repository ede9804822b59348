// Changes of a scene. Places are moved in double and rounded to float once, as a loader would.
#include "perf/accuracy/scene_changes.h"

#include <algorithm>

#include "engine/frame/pose.h"

namespace halfframe::accuracy {
namespace {

/// Calls `change` with every place of the shot: of surfaces, lamps and the camera.
template <typename Change>
void for_each_place(Shot& shot, Change change) {
    const auto of_matrix = [&](glm::mat4& matrix) {
        glm::vec3 place(matrix[3]);
        change(place);
        matrix[3] = glm::vec4(place, 1.0f);
    };
    for (Surface& surface : shot.scene.surfaces) of_matrix(surface.world_from_local);
    for (Light& light : shot.scene.lights) change(light.position);
    for (Camera& camera : shot.scene.cameras) of_matrix(camera.world_from_view);
    of_matrix(shot.camera.world_from_view);
}

/// Calls `change` with the place of every node, to its parent, that `wanted` names.
template <typename Wanted, typename Change>
void for_each_node(Scene& scene, Wanted wanted, Change change) {
    for (Node& node : scene.nodes) {
        if (!wanted(node)) continue;
        if (!node.parent_from_local) {
            change(node.translation);
            continue;
        }
        glm::vec3 place((*node.parent_from_local)[3]);
        change(place);
        (*node.parent_from_local)[3] = glm::vec4(place, 1.0f);
    }
}

/// Calls `change` with every key of an animated place of a node that `wanted` names; tangents are lengths too, but no
/// places: `tangents` says whether they are meant.
template <typename Wanted, typename Change>
void for_each_key(Scene& scene, Wanted wanted, bool tangents, Change change) {
    for (Animation& animation : scene.animations) {
        for (AnimationChannel& channel : animation.channels) {
            if (channel.value != AnimatedValue::translation) continue;
            if (!wanted(scene.nodes[static_cast<std::size_t>(channel.node)])) continue;
            const bool cubic = channel.interpolation == Interpolation::cubic_spline;
            for (std::size_t at = 0; at + 3 <= channel.values.size(); at += 3) {
                if (cubic && !tangents && at / 3 % 3 != 1) continue;
                glm::vec3 key(channel.values[at], channel.values[at + 1], channel.values[at + 2]);
                change(key);
                for (int i = 0; i < 3; ++i) channel.values[at + static_cast<std::size_t>(i)] = key[i];
            }
        }
    }
}

bool is_root(const Node& node) { return node.parent < 0; }
bool is_any(const Node&) { return true; }

bool is_lamp(const Light& light) { return light.kind != LightKind::sun; }

void rescale(Camera& camera, float factor) {
    camera.near_m *= factor;
    camera.far_m *= factor;
    camera.half_height_m *= factor;
}

/// A vertex like `like`, elsewhere, that no direction was given to.
std::uint32_t add_bare_vertex(Mesh& mesh, std::uint32_t like, const glm::vec3& position) {
    mesh.positions.push_back(position);
    if (!mesh.normals.empty()) mesh.normals.emplace_back(0.0f);
    if (!mesh.tangents.empty()) mesh.tangents.emplace_back(0.0f);
    if (!mesh.uv.empty()) mesh.uv.push_back(mesh.uv[like]);
    if (!mesh.colors.empty()) mesh.colors.push_back(mesh.colors[like]);
    return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

}  // namespace

Shot moved(Shot shot, const glm::dvec3& offset) {
    const auto move = [&](glm::vec3& place) { place = glm::vec3(glm::dvec3(place) + offset); };
    for_each_place(shot, move);
    for_each_node(shot.scene, is_root, move);
    for_each_key(shot.scene, is_root, false, move);
    return shot;
}

Shot with_places_of(Shot shot, const glm::dvec3& offset) {
    return moved(moved(std::move(shot), offset), -offset);  // the way back is exact: steps are finer here than there
}

Shot in_units(Shot shot, double per_metre) {
    const auto factor = static_cast<float>(per_metre);
    const auto scale = [&](glm::vec3& place) { place = glm::vec3(glm::dvec3(place) * per_metre); };
    for_each_place(shot, scale);
    for_each_node(shot.scene, is_any, scale);
    for_each_key(shot.scene, is_any, true, scale);
    for (Mesh& mesh : shot.scene.meshes) {
        std::ranges::for_each(mesh.positions, scale);
        for (MorphTarget& target : mesh.morph_targets) std::ranges::for_each(target.positions, scale);
    }
    for (Skin& skin : shot.scene.skins) {
        for (glm::mat4& joint_from_mesh : skin.joint_from_mesh) {
            glm::vec3 place(joint_from_mesh[3]);
            scale(place);
            joint_from_mesh[3] = glm::vec4(place, 1.0f);
        }
    }
    for (Light& light : shot.scene.lights) {
        light.range_m *= factor;
        light.radius_m *= factor;
        if (is_lamp(light)) light.color *= factor * factor;
    }
    for (Camera& camera : shot.scene.cameras) rescale(camera, factor);
    rescale(shot.camera, factor);
    return shot;
}

Shot turned(Shot shot, int quarters) {
    for (int turn = 0; turn < quarters; ++turn) {
        const auto turn_vector = [](const glm::vec3& v) { return glm::vec3(v.z, v.y, -v.x); };
        const auto turn_matrix = [&](glm::mat4& matrix) {
            for (int column = 0; column < 4; ++column) {
                matrix[column] = glm::vec4(turn_vector(glm::vec3(matrix[column])), matrix[column].w);
            }
        };
        for (Surface& surface : shot.scene.surfaces) turn_matrix(surface.world_from_local);
        for (Light& light : shot.scene.lights) {
            light.position = turn_vector(light.position);
            light.direction = turn_vector(light.direction);
        }
        for (Camera& camera : shot.scene.cameras) turn_matrix(camera.world_from_view);
        turn_matrix(shot.camera.world_from_view);
    }
    return shot;
}

Shot with_lights_reversed(Shot shot) {
    std::ranges::reverse(shot.scene.lights);
    return shot;
}

Shot with_lamps_halved(Shot shot) {
    std::vector<Light> lights;
    for (Light light : shot.scene.lights) {
        if (is_lamp(light)) {
            light.color *= 0.5f;
            lights.push_back(light);
        }
        lights.push_back(light);
    }
    shot.scene.lights = lights;
    return shot;
}

Shot without_lamps(Shot shot) {
    std::erase_if(shot.scene.lights, is_lamp);
    return shot;
}

Shot with_lamps_of_no_range(Shot shot) {
    for (Light& light : shot.scene.lights) {
        if (is_lamp(light)) light.range_m = 0.0f;
    }
    return shot;
}

Shot with_lights_times(Shot shot, float factor) {
    for (Light& light : shot.scene.lights) light.color *= factor;
    return shot;
}

Shot exposed_for(Shot shot, float factor) {
    shot = with_lights_times(std::move(shot), factor);
    shot.scene.ambient *= factor;
    if (shot.scene.environment) {
        for (auto& level : shot.scene.environment->levels) {
            for (glm::vec3& texel : level) texel *= factor;
        }
        for (glm::vec3& term : shot.scene.environment->irradiance) term *= factor;
    }
    for (Material& material : shot.scene.materials) material.emissive *= factor;
    shot.camera.exposure /= factor;
    return shot;
}

Shot with_empty_triangles(Shot shot) {
    for (Mesh& mesh : shot.scene.meshes) {
        if (mesh.primitive != Primitive::triangles || mesh.indices.size() < 3) continue;
        const std::uint32_t a = mesh.indices[0];
        const std::uint32_t b = mesh.indices[1];
        const std::uint32_t middle = add_bare_vertex(mesh, a, 0.5f * (mesh.positions[a] + mesh.positions[b]));
        const std::uint32_t again = add_bare_vertex(mesh, a, mesh.positions[a]);
        // In front of the others, so that nothing drawn before hides them.
        mesh.indices.insert(mesh.indices.begin(), {a, a, a, a, b, a, a, middle, b, again, a, again});
    }
    return shot;
}

Shot at_time(Shot shot, double time_s) {
    Animator animator(shot.scene);
    animator.pose(shot.scene, 0, time_s);
    place(shot.scene);
    return shot;
}

Shot with_field_of_view(Shot shot, float fov_y_rad) {
    shot.camera.fov_y_rad = fov_y_rad;
    return shot;
}

}  // namespace halfframe::accuracy
