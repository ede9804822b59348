// load_gltf(): document, checks, bytes, tinygltf, then the node tree as surfaces and cameras.
#include "content/content.h"

#include <cmath>
#include <map>
#include <new>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "content/gltf_extensions.h"
#include "content/gltf_extras.h"
#include "content/gltf_instances.h"
#include "content/gltf_materials.h"
#include "content/mesh_tools.h"
#include "engine/error.h"

namespace halfframe::content {
namespace {

/// What an infinite far plane becomes [m]: with 24-bit depth and a near plane of 0.1 m, 60 m deep steps there.
constexpr float kFarOfInfinite_m = 10000.0f;
/// World coordinates beyond this leave float arithmetic when they are squared and multiplied in shaders [m].
constexpr float kLargestCoordinate_m = 1e9f;
/// Smallest |determinant| over the product of the axes' lengths: flatter transforms have no inverse worth having.
constexpr double kFlattest = 1e-6;

glm::mat4 local_transform(const tinygltf::Node& node) {
    if (node.matrix.size() == 16) {
        glm::mat4 result;
        for (int i = 0; i < 16; ++i) {
            result[i / 4][i % 4] = static_cast<float>(node.matrix[static_cast<std::size_t>(i)]);
        }
        return result;
    }
    const auto number = [](const std::vector<double>& from, std::size_t i, double otherwise) {
        return static_cast<float>(from.empty() ? otherwise : from[i]);
    };
    const glm::vec3 translation(number(node.translation, 0, 0), number(node.translation, 1, 0),
                                number(node.translation, 2, 0));
    const glm::vec3 scale(number(node.scale, 0, 1), number(node.scale, 1, 1), number(node.scale, 2, 1));
    const glm::quat rotation(number(node.rotation, 3, 1), number(node.rotation, 0, 0), number(node.rotation, 1, 0),
                             number(node.rotation, 2, 0));
    return glm::translate(glm::mat4(1.0f), translation) * glm::mat4_cast(glm::normalize(rotation)) *
           glm::scale(glm::mat4(1.0f), scale);
}

bool is_finite(const glm::mat4& matrix) {
    for (int i = 0; i < 16; ++i) {
        if (!std::isfinite(matrix[i / 4][i % 4])) {
            return false;
        }
    }
    return true;
}

/// Axes of a camera node without scale or shear (glTF 2.0, 3.10: the scale of a camera node does not count).
glm::mat4 without_scale(const glm::mat4& matrix) {
    const glm::vec3 back(matrix[2]);
    const glm::vec3 right = glm::cross(glm::vec3(matrix[1]), back);
    if (!(glm::length(right) > 0.0f) || !(glm::length(back) > 0.0f)) {
        return glm::translate(glm::mat4(1.0f), glm::vec3(matrix[3]));
    }
    const glm::mat3 axes(matrix);
    const glm::mat3 squares = glm::transpose(axes) * axes;
    bool rigid = glm::determinant(axes) > 0.0f;
    for (int i = 0; i < 9; ++i) rigid = rigid && std::abs(squares[i / 3][i % 3] - (i % 4 == 0 ? 1.0f : 0.0f)) < 1e-6f;
    if (rigid) {
        return matrix;  // without a second rounding
    }
    const glm::vec3 z = glm::normalize(back);
    const glm::vec3 x = glm::normalize(right);
    return {glm::vec4(x, 0.0f), glm::vec4(glm::cross(z, x), 0.0f), glm::vec4(z, 0.0f), matrix[3]};
}

/// Nodes that an animation moves, from the document: tinygltf is not given animations.
std::vector<bool> animated_nodes(const JsonPlace& root) {
    std::vector<bool> result(count_of(root, "nodes"), false);
    for_each_object(root, "animations", [&](const JsonPlace& animation, std::size_t) {
        for_each_object(animation, "channels", [&](const JsonPlace& channel, std::size_t) {
            if (channel.at("target").has("node")) {
                result[static_cast<std::size_t>(channel.at("target").at("node").whole())] = true;
            }
        });
    });
    return result;
}

class SceneBuilder {
public:
    SceneBuilder(const GltfDocument& document, GltfModel& gltf, Scene& scene)
        : document_(document),
          gltf_(gltf),
          scene_(scene),
          materials_(document, gltf, scene),
          animated_(animated_nodes(document.root())) {}

    void add_nodes() {
        struct Visit {
            std::size_t node;
            glm::mat4 world_from_parent;
            bool moves;
        };
        std::vector<Visit> open;
        for (const std::size_t root : root_nodes()) {
            open.push_back({root, glm::mat4(1.0f), false});
        }
        while (!open.empty()) {  // the tree was checked: no cycles
            const Visit visit = open.back();
            open.pop_back();
            const tinygltf::Node& node = gltf_.model.nodes.at(visit.node);
            const glm::mat4 world_from_local = visit.world_from_parent * local_transform(node);
            if (!is_finite(world_from_local)) {
                fail(fmt::format("/nodes/{}", visit.node), "the transforms down to this node leave the range of float");
            }
            const bool moves = visit.moves || animated_[visit.node];
            add_all_surfaces(visit.node, world_from_local, moves);
            add_camera(visit.node, world_from_local);
            if (auto light = light_of_node(document_, visit.node, world_from_local)) {
                scene_.lights.push_back(std::move(*light));
            }
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child) {
                open.push_back({static_cast<std::size_t>(*child), world_from_local, moves});
            }
        }
    }

private:
    [[noreturn]] void fail(const std::string& place, const std::string& what) const {
        throw Error(Fault::input, fmt::format("{}: {}: {}; {}", gltf_.source.file, place, what, gltf_.source.advice));
    }

    /// Of the default scene, else of the first, else every node without a parent. In reverse, for a stack.
    std::vector<std::size_t> root_nodes() const {
        std::vector<std::size_t> result;
        if (!gltf_.model.scenes.empty()) {
            const std::size_t scene =
                index_in(document_.root(), "scene", gltf_.model.scenes.size(), "scenes").value_or(0);
            for (const int node : gltf_.model.scenes[scene].nodes) {
                result.push_back(static_cast<std::size_t>(node));
            }
        } else {
            std::vector<bool> is_child(gltf_.model.nodes.size(), false);
            for (const tinygltf::Node& node : gltf_.model.nodes) {
                for (const int child : node.children) {
                    is_child[static_cast<std::size_t>(child)] = true;
                }
            }
            for (std::size_t i = 0; i < is_child.size(); ++i) {
                if (!is_child[i]) {
                    result.push_back(i);
                }
            }
        }
        return {result.rbegin(), result.rend()};
    }

    /// One set of surfaces, or one for every instance.
    void add_all_surfaces(std::size_t node, const glm::mat4& world_from_local, bool moves) {
        const auto instances = instances_of_node(document_, gltf_, node);
        if (!instances) {
            add_surfaces(node, world_from_local, moves);
            return;
        }
        if (scene_.surfaces.size() + instances->size() > kMostSurfaces) {
            fail(fmt::format("/nodes/{}", node),
                 fmt::format("its {} instances make more than {} surfaces", instances->size(), kMostSurfaces));
        }
        for (const glm::mat4& local_from_instance : *instances) {
            add_surfaces(node, world_from_local * local_from_instance, moves);
        }
    }

    void add_surfaces(std::size_t node_index, const glm::mat4& world_from_local, bool moves) {
        const tinygltf::Node& node = gltf_.model.nodes[node_index];
        if (node.mesh < 0) {
            return;
        }
        const glm::dmat3 axes(world_from_local);
        const double volume = glm::determinant(axes);
        const double box = glm::length(axes[0]) * glm::length(axes[1]) * glm::length(axes[2]);
        if (!(std::abs(volume) > kFlattest * box)) {
            add_notice(
                scene_.notices,
                fmt::format("/nodes/{} is scaled flat, so that it has no inverse, and was left out.", node_index));
            return;
        }
        const auto mesh = static_cast<std::size_t>(node.mesh);
        for (std::size_t i = 0; i < gltf_.model.meshes[mesh].primitives.size(); ++i) {
            const int scene_mesh = mesh_of(mesh, i, volume < 0.0);
            if (scene_mesh < 0) {
                continue;
            }
            Surface surface;
            surface.name = node.name.empty() ? scene_.meshes[static_cast<std::size_t>(scene_mesh)].name : node.name;
            surface.mesh = scene_mesh;
            surface.material = materials_.scene_material(gltf_.model.meshes[mesh].primitives[i].material);
            surface.world_from_local = world_from_local;
            surface.dynamic = moves || node.skin >= 0;
            const JsonPlace root = document_.root();
            apply_extras(root.at("meshes").at(mesh), ExtrasOwner::mesh, {.surface = &surface});
            apply_extras(root.at("nodes").at(node_index), ExtrasOwner::node, {.surface = &surface});
            expect_in_range(node_index, surface);
            scene_.surfaces.push_back(std::move(surface));
        }
    }

    /// The scene mesh of a primitive, read once; -1 when there is nothing to draw.
    int mesh_of(std::size_t mesh, std::size_t primitive, bool mirror) {
        const auto known = meshes_.find({mesh, primitive, mirror});
        if (known != meshes_.end()) {
            return known->second;
        }
        const MaterialUv uv = uv_of_material(document_, gltf_.model.meshes[mesh].primitives[primitive].material);
        const std::string streams = streams_of(mesh, primitive, uv, mirror);
        if (const auto same = meshes_by_streams_.find(streams); same != meshes_by_streams_.end()) {
            return meshes_[{mesh, primitive, mirror}] = same->second;
        }
        std::optional<Mesh> read = read_primitive(gltf_, mesh, primitive, uv, so_far_, scene_.notices);
        int result = -1;
        if (read) {
            scene_.meshes.push_back(mirror ? mirrored(*read) : std::move(*read));
            boxes_.push_back(local_box(scene_.meshes.back()));
            result = static_cast<int>(scene_.meshes.size()) - 1;
        }
        meshes_by_streams_[streams] = result;
        meshes_[{mesh, primitive, mirror}] = result;
        return result;
    }

    /// Equal for primitives that are one mesh in several materials.
    std::string streams_of(std::size_t mesh, std::size_t primitive, const MaterialUv& uv, bool mirror) const {
        const tinygltf::Primitive& source = gltf_.model.meshes[mesh].primitives[primitive];
        std::string key = fmt::format("{} {} {} {} {}", source.mode, source.indices, mirror, uv.reads[0], uv.reads[1]);
        for (const auto& [name, accessor] : source.attributes) {
            key += fmt::format(" {} {}", name, accessor);
        }
        if (uv.of_normal_map && !source.attributes.contains("TANGENT")) {
            const UvMapping& map = *uv.of_normal_map;  // tangents are made for it
            key += fmt::format(" {} {} {} {} {}", map.set, map.scale.x, map.scale.y, map.rotation_rad, map.offset.x);
        }
        const JsonPlace place = document_.root().at("meshes").at(mesh).at("primitives").at(primitive);
        return place.has("targets") ? key + place.at("targets").value().dump() : key;
    }

    void expect_in_range(std::size_t node, const Surface& surface) const {
        const Box box = world_box(boxes_[static_cast<std::size_t>(surface.mesh)], surface.world_from_local);
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::abs(box.low[axis]) <= kLargestCoordinate_m) ||
                !(std::abs(box.high[axis]) <= kLargestCoordinate_m)) {
                fail(fmt::format("/nodes/{}", node), fmt::format("its mesh reaches beyond {} m", kLargestCoordinate_m));
            }
        }
    }

    void add_camera(std::size_t node_index, const glm::mat4& world_from_local) {
        const tinygltf::Node& node = gltf_.model.nodes[node_index];
        if (node.camera < 0) {
            return;
        }
        const tinygltf::Camera& source = gltf_.model.cameras[static_cast<std::size_t>(node.camera)];
        Camera camera;
        camera.name = !source.name.empty() ? source.name
                      : !node.name.empty() ? node.name
                                           : fmt::format("camera {}", scene_.cameras.size());
        camera.world_from_view = without_scale(world_from_local);
        camera.orthographic = source.type == "orthographic";
        if (camera.orthographic) {
            camera.half_height_m = static_cast<float>(std::abs(source.orthographic.ymag));
            camera.near_m = static_cast<float>(source.orthographic.znear);
            camera.far_m = static_cast<float>(source.orthographic.zfar);
        } else {
            camera.fov_y_rad = static_cast<float>(source.perspective.yfov);
            camera.near_m = static_cast<float>(source.perspective.znear);
            camera.far_m = source.perspective.zfar > 0.0 ? static_cast<float>(source.perspective.zfar)
                                                         : std::max(kFarOfInfinite_m, 1000.0f * camera.near_m);
        }
        apply_extras(document_.root().at("cameras").at(static_cast<std::size_t>(node.camera)), ExtrasOwner::camera,
                     {.camera = &camera});
        scene_.cameras.push_back(std::move(camera));
    }

    const GltfDocument& document_;
    GltfModel& gltf_;
    Scene& scene_;
    GltfMaterials materials_;
    std::vector<bool> animated_;
    std::map<std::tuple<std::size_t, std::size_t, bool>, int> meshes_;
    std::map<std::string, int> meshes_by_streams_;
    std::vector<Box> boxes_;  ///< of Scene::meshes
    ReadSoFar so_far_;
};

void add_content_notices(const JsonPlace& root, std::vector<std::string>& notices) {
    if (count_of(root, "animations") > 0) {
        add_notice(notices, "Animations are not played: the nodes stand as the file has them.");
    }
    if (count_of(root, "skins") > 0) {
        add_notice(notices, "Skins are not applied: skinned meshes are drawn in their bind pose.");
    }
    for_each_object(root, "meshes", [&](const JsonPlace& mesh, std::size_t) {
        for_each_object(mesh, "primitives", [&](const JsonPlace& primitive, std::size_t) {
            if (primitive.has("targets")) {
                add_notice(notices, "Morph targets are not applied: meshes are drawn in their base shape.");
            }
        });
    });
}

Scene load_checked(const std::filesystem::path& file, const LoadOptions& options) {
    GltfDocument document = read_gltf_document(file);
    check_gltf(document);
    apply_choices(document, options);
    GltfResources resources = read_gltf_resources(document);
    document.binary_chunk.reset();
    decode_meshopt(document, resources);
    GltfModel gltf = parse_gltf_model(document, std::move(resources), images_used_by_materials(document));
    Scene scene;
    scene.name = file.stem().string();
    scene.notices = document.notices;
    add_content_notices(document.root(), scene.notices);
    SceneBuilder(document, gltf, scene).add_nodes();
    if (const std::size_t scenes = count_of(document.root(), "scenes"); scenes > 0) {
        Surroundings surroundings;
        const std::size_t chosen = index_in(document.root(), "scene", scenes, "scenes").value_or(0);
        apply_extras(document.root().at("scenes").at(chosen), ExtrasOwner::scene,
                     {.scene = &scene, .surroundings = &surroundings});
        if (!surroundings.name.empty()) {
            scene.environment = environment(surroundings.name, {.size = surroundings.size}).map;
        }
    }
    if (scene.surfaces.empty()) {
        add_notice(scene.notices, "There is nothing to draw in the scene.");
    }
    return scene;
}

}  // namespace

Scene load_gltf(const std::filesystem::path& file, const LoadOptions& options) {
    try {
        return load_checked(file, options);
    } catch (const std::bad_alloc&) {
        throw Error(Fault::input, fmt::format("{}: needs more memory than there is; split the asset", file.string()));
    } catch (const std::length_error&) {
        throw Error(Fault::input, fmt::format("{}: needs more memory than there is; split the asset", file.string()));
    }
}

}  // namespace halfframe::content
