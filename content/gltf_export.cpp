// gltf_binary(): a Scene as a GLB that loads back to the same frame. Floats are written as they are.
#include <algorithm>
#include <map>
#include <numbers>
#include <tuple>

#include <fmt/format.h>

#include "content/content.h"
#include "content/environment/environment_strength.h"
#include "content/glb_writer.h"
#include "content/gltf_export_materials.h"
#include "content/gltf_export_order.h"
#include "content/mesh_tools.h"
#include "engine/frame/pose.h"

namespace halfframe::content {
namespace {

using nlohmann::json;

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// The strength of a built-in environment that this one is. 0: another one, which glTF has no place for.
float exported_strength(const EnvironmentMap& map) {
    const auto names = environment_names();
    if (std::ranges::find(names, map.name) == names.end()) return 0.0f;
    return strength_between(environment(map.name, {.size = map.size}).map, map).value_or(0.0f);
}

class Exporter {
public:
    explicit Exporter(const Scene& scene)
        : scene_(scene),
          moves_(nodes_that_move(scene)),
          world_from_node_(scene.nodes.size()),
          file_nodes_(scene.nodes.size(), -1) {
        world_from_nodes(scene, world_from_node_);
    }

    std::string run() {
        MaterialExporter materials(scene_, file_);
        for (const Material& material : scene_.materials) file_.append("materials", materials.material_of(material));
        json roots = json::array();
        for (const ExportRoot& root : export_order(scene_, moves_)) roots.push_back(add_root(root));
        json& gltf_scene = file_.document["scenes"][0];
        gltf_scene["name"] = scene_.name;
        if (!roots.empty()) gltf_scene["nodes"] = roots;
        if (json extras = scene_extras(); !extras.empty()) gltf_scene["extras"] = std::move(extras);
        file_.document["scene"] = 0;
        for (const auto& [node, skin] : skin_of_node_) file_.document["nodes"][node]["skin"] = skin_of(skin);
        for (const Animation& animation : scene_.animations) add_animation(animation);
        return file_.bytes();
    }

private:
    // ---- nodes

    std::size_t add_node(const std::string& name, const glm::mat4& matrix = glm::mat4(1.0f)) {
        json node = json::object();
        if (!name.empty()) node["name"] = name;
        if (matrix != glm::mat4(1.0f)) node["matrix"] = array_of(matrix);
        return file_.append("nodes", std::move(node));
    }
    json& node_at(std::size_t index) { return file_.document["nodes"][index]; }

    std::size_t add_root(const ExportRoot& root) {
        if (root.surface >= 0) return add_standing(scene_.surfaces[at(root.surface)]);
        if (root.camera >= 0) {
            const Camera& camera = scene_.cameras[at(root.camera)];
            const std::size_t node = add_node(camera.name, camera.world_from_view);
            node_at(node)["camera"] = camera_of(camera);
            return node;
        }
        if (root.light >= 0) {
            const Light& light = scene_.lights[at(root.light)];
            const std::size_t node = add_node(light.name, place_of(light));
            file_.extension(node_at(node), "KHR_lights_punctual")["light"] = light_of(light);
            return node;
        }
        std::size_t top = moves_[at(root.node)] ? add_tree(root.node) : add_carrier(root.node);
        for (int above = scene_.nodes[at(root.node)].parent; above >= 0; above = scene_.nodes[at(above)].parent) {
            const std::size_t parent = add_scene_node(scene_.nodes[at(above)]);  // stands: a copy does no harm
            node_at(parent)["children"].push_back(top);
            top = parent;
        }
        return top;
    }

    std::size_t add_scene_node(const Node& node) {
        const std::size_t index = add_node(node.name, node.parent_from_local.value_or(glm::mat4(1.0f)));
        if (node.parent_from_local) return index;
        json& entry = node_at(index);
        const glm::quat& q = node.rotation;
        if (node.translation != glm::vec3(0.0f)) entry["translation"] = array_of(node.translation);
        if (q != glm::quat(1.0f, 0.0f, 0.0f, 0.0f)) entry["rotation"] = array_of(glm::vec4(q.x, q.y, q.z, q.w));
        if (node.scale != glm::vec3(1.0f)) entry["scale"] = array_of(node.scale);
        return index;
    }

    /// A node with what it carries, and all below it. The depth of the tree is that of a loaded file or of a skeleton.
    std::size_t add_tree(int node) {
        const std::size_t index = add_carrier(node);
        for (std::size_t child = at(node) + 1; child < scene_.nodes.size(); ++child) {
            if (scene_.nodes[child].parent != node) continue;
            const std::size_t added = add_tree(static_cast<int>(child));
            node_at(index)["children"].push_back(added);
        }
        return index;
    }

    std::size_t add_carrier(int node) {
        const std::size_t index = add_scene_node(scene_.nodes[at(node)]);
        file_nodes_[at(node)] = static_cast<int>(index);
        add_carried_surfaces(node, index);
        if (!moves_[at(node)]) return index;
        for (const Camera& camera : scene_.cameras) {
            if (camera.node != node) continue;
            const std::size_t holder = node_at(index).contains("camera") ? add_child(index, camera.name) : index;
            node_at(holder)["camera"] = camera_of(camera);
        }
        for (const Light& light : scene_.lights) {
            if (light.node != node) continue;
            const std::size_t holder = node_at(index).contains("extensions") ? add_child(index, light.name) : index;
            file_.extension(node_at(holder), "KHR_lights_punctual")["light"] = light_of(light);
        }
        return index;
    }

    std::size_t add_child(std::size_t parent, const std::string& name) {
        const std::size_t child = add_node(name);
        node_at(parent)["children"].push_back(child);
        return child;
    }

    // ---- surfaces

    /// One mesh for all that are alike but for mesh and material; children for the others. Morph weights belong to the
    /// node that has the mesh, so what morphs is never a child.
    void add_carried_surfaces(int node, std::size_t index) {
        std::vector<const Surface*> own, others;
        for (const Surface& surface : scene_.surfaces) {
            if (carrying_node(scene_, moves_, surface) != node) continue;
            const bool fits = own.empty()
                                  ? morphs(surface) || surface.name == scene_.nodes[at(node)].name
                                  : surface.skin == own.front()->skin && surface.dynamic == own.front()->dynamic &&
                                        morphs(surface) == morphs(*own.front());
            (fits ? own : others).push_back(&surface);
        }
        if (!own.empty()) {
            put_surfaces(index, own, determinant_at(*own.front(), world_from_node_[at(node)]));
            const std::vector<float>& weights = scene_.nodes[at(node)].morph_weights;
            if (morphs(*own.front()) && !weights.empty()) {
                json& array = node_at(index)["weights"] = json::array();
                for (const float weight : weights) array.push_back(static_cast<double>(weight));
            }
        }
        for (const Surface* surface : others) {
            put_surfaces(add_child(index, surface->name), {surface},
                         determinant_at(*surface, world_from_node_[at(node)]));
        }
    }

    std::size_t add_standing(const Surface& surface) {
        const bool skinned = surface.skin >= 0;  // its node's own place does not count
        const std::size_t node = add_node(surface.name, skinned ? glm::mat4(1.0f) : surface.world_from_local);
        put_surfaces(node, {&surface}, determinant_at(surface, glm::dmat4(surface.world_from_local)));
        return node;
    }

    bool morphs(const Surface& surface) const { return !scene_.meshes[at(surface.mesh)].morph_targets.empty(); }

    /// Below 0: the loader turns faces around, so they are written turned around.
    double determinant_at(const Surface& surface, const glm::dmat4& world_from_local) const {
        if (surface.skin < 0) return glm::determinant(glm::dmat3(world_from_local));
        const Skin& skin = scene_.skins[at(surface.skin)];
        return glm::determinant(glm::dmat3(world_from_node_[at(skin.joints.front())])) *
               glm::determinant(glm::dmat3(skin.joint_from_mesh.front()));
    }

    void put_surfaces(std::size_t node, const std::vector<const Surface*>& surfaces, double determinant) {
        const Surface& first = *surfaces.front();
        std::vector<std::pair<int, int>> parts;
        for (const Surface* surface : surfaces) parts.emplace_back(surface->mesh, surface->material);
        node_at(node)["mesh"] = mesh_of(parts, determinant < 0.0);
        if (first.skin >= 0) skin_of_node_[node] = first.skin;
        const bool loads_dynamic =
            first.skin >= 0 || (first.node >= 0 && moves_[at(first.node)] && is_animated_or_below(first.node));
        if (first.dynamic != loads_dynamic) node_at(node)["extras"]["hf_dynamic"] = first.dynamic;
    }

    bool is_animated_or_below(int node) const {
        for (; node >= 0; node = scene_.nodes[at(node)].parent) {
            for (const Animation& animation : scene_.animations) {
                for (const AnimationChannel& channel : animation.channels) {
                    if (channel.node == node) return true;
                }
            }
        }
        return false;
    }

    /// A mesh of one primitive for each (mesh, material).
    std::size_t mesh_of(const std::vector<std::pair<int, int>>& parts, bool mirror) {
        const auto [known, is_new] = meshes_.try_emplace({parts, mirror}, 0);
        if (!is_new) return known->second;
        json primitives = json::array();
        for (const auto& [mesh, material] : parts) {
            primitives.push_back(primitive_of(mesh, mirror));
            primitives.back()["material"] = material;
        }
        json entry = {{"primitives", std::move(primitives)}};
        const std::string& name = scene_.meshes[at(parts.front().first)].name;
        if (!name.empty()) entry["name"] = name;
        return known->second = file_.append("meshes", std::move(entry));
    }

    /// Streams, indices and mode of a mesh, written once; the loader turns the faces of a mirrored one around again.
    const json& primitive_of(int index, bool mirror) {
        const auto known = primitives_.find({index, mirror});
        if (known != primitives_.end()) return known->second;
        const Mesh& plain = scene_.meshes[at(index)];
        const Mesh mesh = mirror ? mirrored(plain) : plain;
        json primitive = {{"mode", static_cast<int>(mesh.primitive)}};
        json& attributes = primitive["attributes"];
        attributes["POSITION"] = file_.add_bounded(mesh.positions);
        const auto add = [&](const char* name, const auto& values, const char* type) {
            if (!values.empty()) attributes[name] = file_.add_accessor(values, kFloatComponents, type);
        };
        add("NORMAL", mesh.normals, "VEC3");
        add("TANGENT", mesh.tangents, "VEC4");
        add("TEXCOORD_0", mesh.uv, "VEC2");
        add("TEXCOORD_1", mesh.uv1, "VEC2");
        add("COLOR_0", mesh.colors, "VEC4");
        add("WEIGHTS_0", mesh.weights, "VEC4");
        if (!mesh.joints.empty()) attributes["JOINTS_0"] = file_.add_accessor(mesh.joints, kUint16Components, "VEC4");
        for (const MorphTarget& target : mesh.morph_targets) {
            json entry = json::object();
            if (!target.positions.empty()) entry["POSITION"] = file_.add_bounded(target.positions);
            if (!target.normals.empty()) entry["NORMAL"] = file_.add_accessor(target.normals, kFloatComponents, "VEC3");
            if (!target.tangents.empty())
                entry["TANGENT"] = file_.add_accessor(target.tangents, kFloatComponents, "VEC3");
            primitive["targets"].push_back(std::move(entry));
        }
        if (!mesh.indices.empty()) primitive["indices"] = file_.add_accessor(mesh.indices, kUint32Components, "SCALAR");
        return primitives_[{index, mirror}] = primitive;
    }

    // ---- what moves

    std::size_t skin_of(int index) {
        const auto [known, is_new] = skins_.try_emplace(index, 0);
        if (!is_new) return known->second;
        const Skin& skin = scene_.skins[at(index)];
        json entry = {{"joints", json::array()}};
        for (const int joint : skin.joints) entry["joints"].push_back(file_nodes_[at(joint)]);
        if (!skin.name.empty()) entry["name"] = skin.name;
        entry["inverseBindMatrices"] = file_.add_accessor(skin.joint_from_mesh, kFloatComponents, "MAT4");
        return known->second = file_.append("skins", std::move(entry));
    }

    void add_animation(const Animation& animation) {
        json samplers = json::array(), channels = json::array();
        for (const AnimationChannel& channel : animation.channels) {
            constexpr const char* kPaths[] = {"translation", "rotation", "scale", "weights"};
            constexpr const char* kWays[] = {"STEP", "LINEAR", "CUBICSPLINE"};
            const bool is_weights = channel.value == AnimatedValue::morph_weights;
            const int node = file_nodes_[at(channel.node)];
            if (is_weights && !node_at(at(node)).contains("weights")) continue;  // nothing there has a shape to change
            const bool is_rotation = channel.value == AnimatedValue::rotation;
            const char* type = is_weights ? "SCALAR" : is_rotation ? "VEC4" : "VEC3";
            samplers.push_back({{"input", file_.add_shared(channel.times_s, "SCALAR", 1)},
                                {"output", file_.add_shared(channel.values, type,
                                                            is_weights    ? 1
                                                            : is_rotation ? 4
                                                                          : 3)},
                                {"interpolation", kWays[static_cast<std::size_t>(channel.interpolation)]}});
            channels.push_back(
                {{"sampler", samplers.size() - 1},
                 {"target", {{"node", node}, {"path", kPaths[static_cast<std::size_t>(channel.value)]}}}});
        }
        if (channels.empty()) return;
        json entry = {{"samplers", std::move(samplers)}, {"channels", std::move(channels)}};
        if (!animation.name.empty()) entry["name"] = animation.name;
        file_.append("animations", std::move(entry));
    }

    // ---- cameras and lights

    std::size_t camera_of(const Camera& camera) {
        json lens = {{"znear", static_cast<double>(camera.near_m)}, {"zfar", static_cast<double>(camera.far_m)}};
        json entry = {{"type", camera.orthographic ? "orthographic" : "perspective"}};
        if (camera.orthographic) {
            lens["xmag"] = lens["ymag"] = static_cast<double>(camera.half_height_m);
        } else {
            lens["yfov"] = static_cast<double>(camera.fov_y_rad);
        }
        entry[camera.orthographic ? "orthographic" : "perspective"] = lens;
        if (!camera.name.empty()) entry["name"] = camera.name;
        if (camera.exposure != 1.0f) entry["extras"]["hf_exposure"] = static_cast<double>(camera.exposure);
        return file_.append("cameras", std::move(entry));
    }

    std::size_t light_of(const Light& light) {
        constexpr const char* kTypes[] = {"directional", "point", "spot"};
        const float scale = export_scale(light.color);
        json entry = {{"type", kTypes[static_cast<std::size_t>(light.kind)]},
                      {"color", array_of(light.color / scale)},
                      {"intensity", static_cast<double>(scale) * std::numbers::pi}};
        if (!light.name.empty()) entry["name"] = light.name;
        if (light.kind != LightKind::sun) entry["range"] = static_cast<double>(light.range_m);
        if (light.kind == LightKind::spot) {
            entry["spot"] = {{"innerConeAngle", static_cast<double>(light.inner_cone_rad)},
                             {"outerConeAngle", static_cast<double>(light.outer_cone_rad)}};
        }
        if (light.radius_m > 0.0f) entry["extras"]["hf_radius_m"] = static_cast<double>(light.radius_m);
        json& lights = file_.extension(file_.document, "KHR_lights_punctual")["lights"];
        lights.push_back(std::move(entry));
        return lights.size() - 1;
    }

    /// -Z is the way the light travels; the other two axes only have to stand across it.
    static glm::mat4 place_of(const Light& light) {
        const glm::vec3 back = -light.direction;
        const glm::vec3 other = std::abs(back.y) < 0.9f ? glm::vec3(0.0f, 1.0f, 0.0f) : glm::vec3(1.0f, 0.0f, 0.0f);
        const glm::vec3 right = glm::normalize(glm::cross(other, back));
        return {glm::vec4(right, 0.0f), glm::vec4(glm::cross(back, right), 0.0f), glm::vec4(back, 0.0f),
                glm::vec4(light.position, 1.0f)};
    }

    json scene_extras() const {
        json extras = json::object();
        if (scene_.ambient != glm::vec3(0.0f)) extras["hf_ambient"] = array_of(scene_.ambient);
        if (scene_.background != Scene{}.background) extras["hf_background"] = array_of(scene_.background);
        if (scene_.bloom) extras["hf_bloom_strength"] = static_cast<double>(scene_.bloom->strength);
        if (scene_.sky) {
            extras["hf_sky_zenith"] = array_of(scene_.sky->zenith);
            extras["hf_sky_horizon"] = array_of(scene_.sky->horizon);
            extras["hf_sky_ground"] = array_of(scene_.sky->ground);
        }
        if (scene_.wetness) {
            extras["hf_wetness"] = static_cast<double>(scene_.wetness->level);
            if (!scene_.wetness->is_static) extras["hf_wetness_live"] = true;
            if (scene_.wetness->since_s) extras["hf_rain_ended_s"] = static_cast<double>(*scene_.wetness->since_s);
            extras["hf_drying_s"] = static_cast<double>(scene_.wetness->dry_s);
        }
        if (scene_.puddles) extras["hf_puddles"] = static_cast<double>(scene_.puddles->level);
        const float strength = scene_.environment ? exported_strength(*scene_.environment) : 0.0f;
        if (strength > 0.0f) {
            extras["hf_environment"] = scene_.environment->name;
            extras["hf_environment_size"] = scene_.environment->size;
            if (strength != 1.0f) extras["hf_environment_strength"] = static_cast<double>(strength);
        }
        return extras;
    }

    const Scene& scene_;
    GlbWriter file_;
    std::vector<bool> moves_;
    std::vector<glm::dmat4> world_from_node_;
    std::vector<int> file_nodes_;              ///< of Scene::nodes; -1: not written, or a copy
    std::map<std::size_t, int> skin_of_node_;  ///< written last: joints may stand behind the mesh
    std::map<std::pair<int, bool>, json> primitives_;
    std::map<std::pair<std::vector<std::pair<int, int>>, bool>, std::size_t> meshes_;
    std::map<int, std::size_t> skins_;
};

}  // namespace

std::vector<std::string> not_exported(const Scene& scene) {
    std::vector<std::string> sentences;
    const auto is_elsewhere = [](const Material& material) {
        return material.water_texture && !(material.water_uv == material.base_color_uv);
    };
    if (std::ranges::any_of(scene.materials, is_elsewhere)) {
        sentences.emplace_back(
            "Water textures are exported at the coordinates of the base colour, which are not theirs everywhere.");
    }
    if (scene.environment && !(exported_strength(*scene.environment) > 0.0f)) {
        sentences.push_back(
            fmt::format("The environment {} is not a built-in one: the file has none.", scene.environment->name));
    }
    return sentences;
}

std::string gltf_binary(const Scene& scene) { return Exporter(scene).run(); }

}  // namespace halfframe::content
