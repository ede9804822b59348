// Reads joints, weights, morph targets, skins and animations.
#include "content/gltf_motion.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/error.h"

namespace halfframe::content {
namespace {

[[noreturn]] void fail(const GltfModel& gltf, const std::string& place, const std::string& what) {
    throw Error(Fault::input, fmt::format("{}: {}: {}; {}", gltf.source.file, place, what, gltf.source.advice));
}

int attribute(const tinygltf::Primitive& primitive, const std::string& name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
}

std::vector<float> read_finite_floats(const GltfModel& gltf, const std::string& place, int accessor) {
    std::vector<float> values = read_floats(gltf, accessor);
    const bool is_right = all_finite(values);
    for (std::size_t i = 0; !is_right && i < values.size(); ++i) {
        if (!std::isfinite(values[i])) {
            fail(gltf, place, fmt::format("number {} of accessor {} is infinite or not a number", i, accessor));
        }
    }
    return values;
}

struct Influence {
    std::uint16_t joint;
    float weight;
};

/// What became of weights that did not fit, over a primitive.
struct Losses {
    std::size_t dropped = 0;  ///< vertices that lost a joint
    float largest = 0.0f;     ///< share of the weight that one lost
    std::size_t weightless = 0;
    std::size_t unnormalized = 0;
};

/// The four strongest, which then sum to 1.
void keep_strongest(std::vector<Influence>& all, glm::u16vec4& joints, glm::vec4& weights, Losses& losses) {
    std::ranges::stable_sort(all, std::greater<>{}, &Influence::weight);
    float sum = 0.0f, kept = 0.0f;
    for (std::size_t i = 0; i < all.size(); ++i) {
        sum += all[i].weight;
        if (i < 4) kept += all[i].weight;
    }
    joints = glm::u16vec4(0);
    weights = glm::vec4(0.0f);
    if (!(kept > 0.0f)) {
        joints[0] = all[0].joint;
        weights[0] = 1.0f;
        ++losses.weightless;
        return;
    }
    if (sum > kept) {
        ++losses.dropped;
        losses.largest = std::max(losses.largest, (sum - kept) / sum);
    }
    // 8-bit weights of four joints are 4 * 0.5 / 255 from 1 at worst; more is the file's fault.
    if (std::abs(sum - 1.0f) > 0.01f) ++losses.unnormalized;
    const bool sums_to_one = std::abs(kept - 1.0f) < 1e-6f;  // as near as float gets: no second rounding
    for (std::size_t i = 0; i < std::min<std::size_t>(4, all.size()); ++i) {
        if (all[i].weight <= 0.0f) break;
        joints[static_cast<int>(i)] = all[i].joint;
        weights[static_cast<int>(i)] = sums_to_one ? all[i].weight : all[i].weight / kept;
    }
}

void add_notices(const std::string& place, const Losses& losses, std::vector<std::string>& notices) {
    if (losses.dropped > 0) {
        add_notice(notices, fmt::format("{} has {} vertices on more than four joints: the strongest four are kept, and "
                                        "one of them lost {:.1f} % of its weight.",
                                        place, losses.dropped, 100.0f * losses.largest));
    }
    if (losses.weightless > 0) {
        add_notice(notices, fmt::format("{} vertices of {} have no weight: they follow their first joint.",
                                        losses.weightless, place));
    }
    if (losses.unnormalized > 0) {
        add_notice(notices, fmt::format("The weights of {} vertices of {} did not sum to 1 and were scaled.",
                                        losses.unnormalized, place));
    }
}

void read_joints(const GltfModel& gltf, const tinygltf::Primitive& primitive, const std::string& place, Mesh& mesh,
                 std::vector<std::string>& notices) {
    std::vector<std::vector<Influence>> all;
    for (int set = 0;; ++set) {
        const int joints = attribute(primitive, fmt::format("JOINTS_{}", set));
        const std::string weights_name = fmt::format("WEIGHTS_{}", set);
        const int weights = attribute(primitive, weights_name);
        if (joints < 0 || weights < 0) break;
        const std::vector<float> indices = read_floats(gltf, joints);
        const std::vector<float> shares = read_finite_floats(gltf, place + "/attributes/" + weights_name, weights);
        all.resize(mesh.positions.size());
        for (std::size_t i = 0; i < shares.size(); ++i) {
            if (shares[i] < 0.0f) {
                fail(gltf, place + "/attributes/" + weights_name,
                     fmt::format("the weight of joint {} of vertex {} is {}", i % 4, i / 4, shares[i]));
            }
            all[i / 4].push_back({static_cast<std::uint16_t>(indices[i]), shares[i]});
        }
    }
    if (all.empty()) return;
    Losses losses;
    mesh.joints.resize(all.size());
    mesh.weights.resize(all.size());
    for (std::size_t i = 0; i < all.size(); ++i) keep_strongest(all[i], mesh.joints[i], mesh.weights[i], losses);
    add_notices(place, losses, notices);
}

std::vector<glm::vec3> read_offsets(const GltfModel& gltf, const std::map<std::string, int>& target,
                                    const std::string& place, const char* name) {
    const auto found = target.find(name);
    if (found == target.end()) return {};
    const std::vector<float> values = read_finite_floats(gltf, place + "/" + name, found->second);
    std::vector<glm::vec3> result(values.size() / 3);
    for (std::size_t i = 0; i < result.size(); ++i) result[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
    return result;
}

void read_targets(const GltfModel& gltf, const tinygltf::Primitive& primitive, const std::string& place, Mesh& mesh,
                  ReadSoFar& so_far) {
    for (std::size_t i = 0; i < primitive.targets.size(); ++i) {
        const std::string target_place = fmt::format("{}/targets/{}", place, i);
        so_far.vertices += mesh.positions.size();
        if (so_far.vertices > kMostVertices) {
            fail(gltf, target_place,
                 fmt::format("all primitives and morph targets up to here have over {} vertices", kMostVertices));
        }
        const auto& target = primitive.targets[i];
        MorphTarget read;
        read.name = fmt::format("target {}", i);
        read.positions = read_offsets(gltf, target, target_place, "POSITION");
        if (!mesh.normals.empty()) read.normals = read_offsets(gltf, target, target_place, "NORMAL");
        if (primitive.attributes.contains("TANGENT") && !mesh.normals.empty()) {
            std::vector<glm::vec3> tangents = read_offsets(gltf, target, target_place, "TANGENT");
            if (!mesh.tangents.empty()) read.tangents = std::move(tangents);  // else only refused if they are wrong
        }
        mesh.morph_targets.push_back(std::move(read));
    }
}

glm::mat4 matrix_of(std::span<const float> numbers) {
    glm::mat4 result;
    for (int i = 0; i < 16; ++i) result[i / 4][i % 4] = numbers[static_cast<std::size_t>(i)];
    return result;
}

std::vector<float> read_times(const GltfModel& gltf, const std::string& place, int accessor) {
    std::vector<float> times = read_finite_floats(gltf, place, accessor);
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (times[i] < 0.0f || (i > 0 && times[i] <= times[i - 1])) {
            fail(gltf, place,
                 fmt::format("time {} of accessor {} is {} s{}", i, accessor, times[i],
                             times[i] < 0.0f ? ", before 0" : fmt::format(", not after {} s", times[i - 1])));
        }
    }
    return times;
}

AnimatedValue value_of(const std::string& path) {
    if (path == "translation") return AnimatedValue::translation;
    if (path == "rotation") return AnimatedValue::rotation;
    return path == "scale" ? AnimatedValue::scale : AnimatedValue::morph_weights;
}

Interpolation interpolation_of(const JsonPlace& sampler) {
    if (!sampler.has("interpolation")) return Interpolation::linear;
    const std::string& way = sampler.at("interpolation").text();
    return way == "STEP"          ? Interpolation::step
           : way == "CUBICSPLINE" ? Interpolation::cubic_spline
                                  : Interpolation::linear;
}

/// Left alone where float gets no nearer to unit: no second rounding.
glm::quat unit(const glm::quat& q) { return std::abs(glm::dot(q, q) - 1.0f) < 1e-6f ? q : glm::normalize(q); }

/// Keys of a rotation must be quaternions: their direction is what counts, so 0 is none.
void expect_rotations(const GltfModel& gltf, const std::string& place, const AnimationChannel& channel) {
    if (channel.value != AnimatedValue::rotation) return;
    const bool is_cubic = channel.interpolation == Interpolation::cubic_spline;
    for (std::size_t key = 0; key < channel.times_s.size(); ++key) {
        const std::size_t at = is_cubic ? 12 * key + 4 : 4 * key;
        float squared = 0.0f;
        for (std::size_t i = 0; i < 4; ++i) squared += channel.values[at + i] * channel.values[at + i];
        if (squared < 0.25f) fail(gltf, place, fmt::format("rotation {} is not a unit quaternion", key));
    }
}

/// glTF asks for unit quaternions; a slerp between others would not turn evenly.
void normalise_keys(AnimationChannel& channel) {
    if (channel.value != AnimatedValue::rotation || channel.interpolation == Interpolation::cubic_spline) return;
    for (std::size_t at = 0; at + 3 < channel.values.size(); at += 4) {
        double squared = 0.0;
        for (std::size_t i = 0; i < 4; ++i) squared += double{channel.values[at + i]} * double{channel.values[at + i]};
        if (std::abs(squared - 1.0) < 1e-6) continue;  // as near as float gets: no second rounding
        for (std::size_t i = 0; i < 4; ++i)
            channel.values[at + i] = static_cast<float>(double{channel.values[at + i]} / std::sqrt(squared));
    }
}

}  // namespace

void read_moving_streams(const GltfModel& gltf, const tinygltf::Primitive& primitive, const std::string& place,
                         Mesh& mesh, ReadSoFar& so_far, std::vector<std::string>& notices) {
    read_joints(gltf, primitive, place, mesh, notices);
    read_targets(gltf, primitive, place, mesh, so_far);
}

std::size_t morph_targets_of(const GltfModel& gltf, const GltfNode& node) {
    if (node.mesh < 0) return 0;
    return gltf.model.meshes[static_cast<std::size_t>(node.mesh)].primitives.front().targets.size();
}

MovingNodes moving_nodes(const JsonPlace& root, const GltfModel& gltf) {
    const std::size_t count = gltf.nodes.size();
    MovingNodes moving{std::vector<bool>(count), std::vector<bool>(count), std::vector<bool>(count)};
    for_each_object(root, "animations", [&](const JsonPlace& animation, std::size_t) {
        for_each_object(animation, "channels", [&](const JsonPlace& channel, std::size_t) {
            if (channel.at("target").has("node"))
                moving.animated[static_cast<std::size_t>(channel.at("target").at("node").whole())] = true;
        });
    });
    for_each_object(root, "skins", [&](const JsonPlace& skin, std::size_t) {
        for (std::size_t i = 0; i < skin.at("joints").size(); ++i)
            moving.joint[static_cast<std::size_t>(skin.at("joints").at(i).whole())] = true;
    });
    for (std::size_t i = 0; i < count; ++i) moving.morphs[i] = morph_targets_of(gltf, gltf.nodes[i]) > 0;
    return moving;
}

Node read_node(const GltfDocument& document, const GltfModel& gltf, std::size_t index) {
    const GltfNode& node = gltf.nodes[index];
    Node result;
    result.name = node.name.empty() ? fmt::format("node {}", index) : node.name;
    result.parent_from_local = node.matrix;
    result.translation = node.translation;
    result.scale = node.scale;
    result.rotation = unit(node.rotation);
    if (node.mesh < 0) return result;
    const std::size_t targets = morph_targets_of(gltf, node);
    result.morph_weights.assign(targets, 0.0f);
    const JsonPlace root = document.root();
    const JsonPlace mesh = root.at("meshes").at(static_cast<std::size_t>(node.mesh));
    for (const JsonPlace& owner : {mesh, root.at("nodes").at(index)}) {  // the node's own go first
        if (!owner.has("weights")) continue;
        for (std::size_t i = 0; i < targets; ++i)
            result.morph_weights[i] = static_cast<float>(owner.at("weights").at(i).number());
    }
    return result;
}

Skin read_skin(const GltfDocument& document, const GltfModel& gltf, std::size_t index,
               std::span<const int> scene_nodes) {
    const JsonPlace source = document.root().at("skins").at(index);
    Skin skin;
    skin.name = source.has("name") ? source.at("name").text() : fmt::format("skin {}", index);
    const JsonPlace joints = source.at("joints");
    for (std::size_t i = 0; i < joints.size(); ++i) {
        const auto node = static_cast<std::size_t>(joints.at(i).whole());
        if (scene_nodes[node] < 0) {
            joints.at(i).fail(fmt::format("node {} is not in the scene that the skinned mesh is in", node));
        }
        skin.joints.push_back(scene_nodes[node]);
    }
    skin.joint_from_mesh.assign(skin.joints.size(), glm::mat4(1.0f));
    if (!source.has("inverseBindMatrices")) return skin;
    const auto accessor = static_cast<int>(source.at("inverseBindMatrices").whole());
    const std::vector<float> numbers =
        read_finite_floats(gltf, fmt::format("/skins/{}/inverseBindMatrices", index), accessor);
    for (std::size_t i = 0; i < skin.joints.size(); ++i)
        skin.joint_from_mesh[i] = matrix_of(std::span(numbers).subspan(16 * i, 16));
    return skin;
}

std::vector<Animation> read_animations(const GltfDocument& document, const GltfModel& gltf,
                                       std::span<const int> scene_nodes, std::vector<std::string>& notices) {
    std::vector<Animation> animations;
    std::uint64_t values = 0;
    for_each_object(document.root(), "animations", [&](const JsonPlace& source, std::size_t index) {
        Animation animation;
        animation.name = source.has("name") ? source.at("name").text() : fmt::format("animation {}", index);
        std::size_t left_out = 0;
        for_each_object(source, "channels", [&](const JsonPlace& channel, std::size_t) {
            const JsonPlace target = channel.at("target");
            const int node = target.has("node") ? scene_nodes[static_cast<std::size_t>(target.at("node").whole())] : -1;
            if (node < 0) {
                ++left_out;
                return;
            }
            const auto of_channel = static_cast<std::size_t>(channel.at("sampler").whole());
            const JsonPlace sampler = source.at("samplers").at(of_channel);
            const std::string place = fmt::format("/animations/{}/samplers/{}", index, of_channel);
            AnimationChannel read;
            read.node = node;
            read.value = value_of(target.at("path").text());
            read.interpolation = interpolation_of(sampler);
            read.times_s = read_times(gltf, place + "/input", static_cast<int>(sampler.at("input").whole()));
            read.values = read_finite_floats(gltf, place + "/output", static_cast<int>(sampler.at("output").whole()));
            values += read.values.size() + read.times_s.size();
            if (values > kMostAnimatedValues) {
                sampler.fail(fmt::format("all animations up to here have over {} values", kMostAnimatedValues));
            }
            expect_rotations(gltf, place + "/output", read);
            normalise_keys(read);
            animation.duration_s = std::max(animation.duration_s, read.times_s.back());
            animation.channels.push_back(std::move(read));
        });
        if (left_out > 0) {
            add_notice(notices, fmt::format("{} channels of animation {} move no node of this scene and were left out.",
                                            left_out, animation.name));
        }
        animations.push_back(std::move(animation));
    });
    return animations;
}

}  // namespace halfframe::content
