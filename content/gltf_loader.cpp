// load_gltf(): document, checks, bytes, model, then the node tree as surfaces and cameras.
#include "content/content.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <new>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include "content/environment/environment_strength.h"
#include "content/gltf_extensions.h"
#include "content/gltf_extras.h"
#include "content/gltf_instances.h"
#include "content/gltf_materials.h"
#include "content/gltf_motion.h"
#include "content/mesh_tools.h"
#include "engine/error.h"
#include "engine/frame/pose.h"
#include "engine/frame/skinning.h"

namespace halfframe::content {
namespace {

/// What an infinite far plane becomes [m]: with 24-bit depth and a near plane of 0.1 m, 60 m deep steps there.
constexpr float kFarOfInfinite_m = 10000.0f;
/// World coordinates beyond this leave float arithmetic when they are squared and multiplied in shaders [m].
constexpr float kLargestCoordinate_m = 1e9f;
/// Smallest |determinant| over the product of the axes' lengths: flatter transforms have no inverse worth having.
constexpr double kFlattest = 1e-6;

glm::mat4 local_transform(const GltfNode& node) {
    if (node.matrix) return *node.matrix;
    return glm::translate(glm::mat4(1.0f), node.translation) * glm::mat4_cast(glm::normalize(node.rotation)) *
           glm::scale(glm::mat4(1.0f), node.scale);
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

/// The scene that was chosen, else the default one, else the first.
std::size_t drawn_scene(const GltfDocument& document) {
    const JsonPlace root = document.root();
    return document.chosen_scene.value_or(index_in(root, "scene", count_of(root, "scenes"), "scenes").value_or(0));
}

class SceneBuilder {
public:
    SceneBuilder(const GltfDocument& document, GltfModel& gltf, Scene& scene)
        : document_(document),
          gltf_(gltf),
          scene_(scene),
          materials_(document, gltf, scene),
          moving_(moving_nodes(document.root(), gltf)),
          scene_nodes_(gltf.nodes.size(), -1) {}

    /// Nodes first, then all that hangs on them: a skin may name joints anywhere in the tree.
    void add_nodes() {
        walk();
        keep_moving_nodes();
        scene_.animations = read_animations(document_, gltf_, scene_nodes_, scene_.notices);
        for (const Visit& visit : visits_) {
            add_all_surfaces(visit);
            add_camera(visit);
            if (gltf_.nodes[visit.node].has_extensions) add_light(visit);
        }
        place(scene_);
        for (std::size_t i = 0; i < scene_.surfaces.size(); ++i) expect_in_range(i);
    }

private:
    [[noreturn]] void fail(const std::string& place, const std::string& what) const {
        throw Error(Fault::input, fmt::format("{}: {}: {}; {}", gltf_.source.file, place, what, gltf_.source.advice));
    }

    /// A node of the scene, parents before their children.
    struct Visit {
        std::size_t node;
        int parent;  ///< in visits_; -1: none
        glm::mat4 world_from_local;
        bool animated;  ///< it or one above it
        bool moves;     ///< as `animated`, or hangs on a joint
    };

    void walk() {
        struct Open {
            std::size_t node;
            int parent;
        };
        std::vector<Open> open;
        for (const std::size_t root : root_nodes()) open.push_back({root, -1});
        while (!open.empty()) {  // the tree was checked: no cycles
            const Open next = open.back();
            open.pop_back();
            const GltfNode& node = gltf_.nodes.at(next.node);
            Visit visit{next.node, next.parent, local_transform(node), moving_.animated[next.node],
                        moving_.animated[next.node] || moving_.joint[next.node]};
            if (next.parent >= 0) {
                const Visit& above = visits_[static_cast<std::size_t>(next.parent)];
                visit.world_from_local = above.world_from_local * visit.world_from_local;
                visit.animated = visit.animated || above.animated;
                visit.moves = visit.moves || above.moves;
            }
            if (!is_finite(visit.world_from_local)) {
                fail(fmt::format("/nodes/{}", next.node), "the transforms down to this node leave the range of float");
            }
            visits_.push_back(visit);
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
                open.push_back({static_cast<std::size_t>(*child), static_cast<int>(visits_.size()) - 1});
        }
    }

    /// Scene::nodes: what moves or carries morph weights, and what that hangs on.
    void keep_moving_nodes() {
        std::vector<bool> kept(visits_.size());
        for (std::size_t i = visits_.size(); i-- > 0;) {
            kept[i] = kept[i] || visits_[i].moves || moving_.morphs[visits_[i].node];
            if (kept[i] && visits_[i].parent >= 0) kept[static_cast<std::size_t>(visits_[i].parent)] = true;
        }
        for (std::size_t i = 0; i < visits_.size(); ++i) {
            if (!kept[i]) continue;
            Node node = read_node(document_, gltf_, visits_[i].node);
            if (visits_[i].parent >= 0)
                node.parent = scene_nodes_[visits_[static_cast<std::size_t>(visits_[i].parent)].node];
            scene_nodes_[visits_[i].node] = static_cast<int>(scene_.nodes.size());
            scene_.nodes.push_back(std::move(node));
        }
    }

    /// The place in Scene::nodes for what hangs on a node; -1 where that never moves.
    int carrier(const Visit& visit) const { return visit.moves ? scene_nodes_[visit.node] : -1; }

    /// Place in Scene::skins of a skin of the document, read once.
    int skin_of(int skin) {
        if (const auto known = skins_.find(skin); known != skins_.end()) return known->second;
        scene_.skins.push_back(read_skin(document_, gltf_, static_cast<std::size_t>(skin), scene_nodes_));
        return skins_[skin] = static_cast<int>(scene_.skins.size()) - 1;
    }

    /// Does the skin, in the pose of the file, turn its mesh inside out?
    bool is_mirroring(const Skin& skin) const {
        const auto of_joint = std::ranges::find_if(
            visits_, [&](const Visit& visit) { return scene_nodes_[visit.node] == skin.joints.front(); });
        return glm::determinant(glm::dmat3(of_joint->world_from_local)) *
                   glm::determinant(glm::dmat3(skin.joint_from_mesh.front())) <
               0.0;
    }

    void expect_known_joints(const GltfNode& node, std::size_t primitive, const Mesh& mesh, const Skin& skin) const {
        for (std::size_t i = 0; i < mesh.joints.size(); ++i) {
            for (int k = 0; k < 4; ++k) {
                if (mesh.joints[i][k] < skin.joints.size()) continue;
                fail(fmt::format("/meshes/{}/primitives/{}/attributes/JOINTS_0", node.mesh, primitive),
                     fmt::format("vertex {} follows joint {} of skin {}, which has {}", i, mesh.joints[i][k], node.skin,
                                 skin.joints.size()));
            }
        }
    }

    /// Of the default scene, else of the first, else every node without a parent. In reverse, for a stack.
    std::vector<std::size_t> root_nodes() const {
        std::vector<std::size_t> result;
        if (!gltf_.model.scenes.empty()) {
            for (const int node : gltf_.model.scenes[drawn_scene(document_)].nodes) {
                result.push_back(static_cast<std::size_t>(node));
            }
        } else {
            std::vector<bool> is_child(gltf_.nodes.size(), false);
            for (const GltfNode& node : gltf_.nodes) {
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
    void add_all_surfaces(const Visit& visit) {
        const auto instances =
            gltf_.nodes[visit.node].has_extensions ? instances_of_node(document_, gltf_, visit.node) : std::nullopt;
        if (!instances) {
            add_surfaces(visit);
            return;
        }
        if (scene_.surfaces.size() + instances->size() > kMostSurfaces) {
            fail(fmt::format("/nodes/{}", visit.node),
                 fmt::format("its {} instances make more than {} surfaces", instances->size(), kMostSurfaces));
        }
        if (visit.moves) {
            add_notice(scene_.notices,
                       fmt::format("/nodes/{} moves and has instances; these stay where they are.", visit.node));
        }
        for (const glm::mat4& local_from_instance : *instances) {
            Visit instance = visit;
            instance.moves = false;
            instance.world_from_local = visit.world_from_local * local_from_instance;
            add_surfaces(instance);
        }
    }

    void add_surfaces(const Visit& visit) {
        const GltfNode& node = gltf_.nodes[visit.node];
        if (node.mesh < 0) {
            return;
        }
        const int skin = node.skin >= 0 ? skin_of(node.skin) : -1;
        const glm::dmat3 axes(visit.world_from_local);
        const double volume = glm::determinant(axes);
        const double box = glm::length(axes[0]) * glm::length(axes[1]) * glm::length(axes[2]);
        // What moves may be flat in the pose of the file and not in another.
        if (!(std::abs(volume) > kFlattest * box) && skin < 0 && !visit.moves) {
            add_notice(
                scene_.notices,
                fmt::format("/nodes/{} is scaled flat, so that it has no inverse, and was left out.", visit.node));
            return;
        }
        const bool mirror = skin >= 0 ? is_mirroring(scene_.skins[static_cast<std::size_t>(skin)]) : volume < 0.0;
        const auto mesh = static_cast<std::size_t>(node.mesh);
        for (std::size_t i = 0; i < gltf_.model.meshes[mesh].primitives.size(); ++i) {
            const int scene_mesh = mesh_of(mesh, i, mirror);
            if (scene_mesh < 0) {
                continue;
            }
            const Mesh& drawn = scene_.meshes[static_cast<std::size_t>(scene_mesh)];
            if (skin >= 0) {
                expect_known_joints(node, i, drawn, scene_.skins[static_cast<std::size_t>(skin)]);
            }
            Surface surface;
            surface.name = node.name.empty() ? drawn.name : node.name;
            surface.mesh = scene_mesh;
            surface.material = materials_.scene_material(gltf_.model.meshes[mesh].primitives[i].material);
            surface.world_from_local = visit.world_from_local;
            surface.dynamic = visit.animated || skin >= 0;
            surface.skin = skin;
            surface.node = drawn.morph_targets.empty() ? carrier(visit) : scene_nodes_[visit.node];
            const JsonPlace root = document_.root();
            apply_extras(root.at("meshes").at(mesh), ExtrasOwner::mesh, {.surface = &surface});
            if (node.has_extras)
                apply_extras(root.at("nodes").at(visit.node), ExtrasOwner::node, {.surface = &surface});
            scene_.surfaces.push_back(std::move(surface));
            nodes_of_surfaces_.push_back(visit.node);
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
            boxes_.push_back(box_of(scene_.meshes.back().positions));
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
        if (uv.of_normal_map && source.attributes.contains("TANGENT")) {
            key += " with tangents";
        } else if (uv.of_normal_map) {
            const UvMapping& map = *uv.of_normal_map;  // tangents are made for it
            key += fmt::format(" {} {} {} {} {}", map.set, map.scale.x, map.scale.y, map.rotation_rad, map.offset.x);
        }
        for (const auto& target : source.targets) {
            key += " target";
            for (const auto& [name, accessor] : target) key += fmt::format(" {} {}", name, accessor);
        }
        return key;
    }

    void expect_in_range(std::size_t surface) const {
        const Surface& drawn = scene_.surfaces[surface];
        const Mesh& mesh = scene_.meshes[static_cast<std::size_t>(drawn.mesh)];
        const auto is_near = [&](const Box& local) {
            const Box box = world_box(local, drawn.world_from_local);
            if (box.empty()) return true;
            for (int axis = 0; axis < 3; ++axis) {
                if (!(std::abs(box.low[axis]) <= kLargestCoordinate_m) ||
                    !(std::abs(box.high[axis]) <= kLargestCoordinate_m))
                    return false;
            }
            return true;
        };
        // Whose vertices are all near needs no look at which of them are drawn.
        const bool right = changes_shape(scene_, drawn)
                               ? is_near(posed_box(scene_, static_cast<int>(surface)))
                               : is_near(boxes_[static_cast<std::size_t>(drawn.mesh)]) || is_near(local_box(mesh));
        if (!right)
            fail(fmt::format("/nodes/{}", nodes_of_surfaces_[surface]),
                 fmt::format("its mesh reaches beyond {} m", kLargestCoordinate_m));
    }

    void add_light(const Visit& visit) {
        if (auto light = light_of_node(document_, visit.node, visit.world_from_local)) {
            light->node = carrier(visit);
            scene_.lights.push_back(std::move(*light));
        }
    }

    void add_camera(const Visit& visit) {
        const GltfNode& node = gltf_.nodes[visit.node];
        if (node.camera < 0) {
            return;
        }
        const tinygltf::Camera& source = gltf_.model.cameras[static_cast<std::size_t>(node.camera)];
        Camera camera;
        camera.name = !source.name.empty() ? source.name
                      : !node.name.empty() ? node.name
                                           : fmt::format("camera {}", scene_.cameras.size());
        camera.world_from_view = without_scale(visit.world_from_local);
        camera.node = carrier(visit);
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
    MovingNodes moving_;
    std::vector<int> scene_nodes_;  ///< place in Scene::nodes of each node of the document; -1: none
    std::vector<Visit> visits_;
    std::map<int, int> skins_;
    std::map<std::tuple<std::size_t, std::size_t, bool>, int> meshes_;
    std::map<std::string, int> meshes_by_streams_;
    std::vector<Box> boxes_;                      ///< of all vertices of Scene::meshes, as they are
    std::vector<std::size_t> nodes_of_surfaces_;  ///< of the document
    ReadSoFar so_far_;
};

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
    SceneBuilder(document, gltf, scene).add_nodes();
    if (count_of(document.root(), "scenes") > 0) {
        Surroundings surroundings;
        apply_extras(document.root().at("scenes").at(drawn_scene(document)), ExtrasOwner::scene,
                     {.scene = &scene, .surroundings = &surroundings});
        if (!surroundings.name.empty()) {
            scene.environment = environment(surroundings.name, {.size = surroundings.size}).map;
            if (surroundings.strength != 1.0f) multiply(*scene.environment, surroundings.strength);
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
