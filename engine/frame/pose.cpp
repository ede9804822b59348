// Samples channels and multiplies transforms down the tree.
#include "engine/frame/pose.h"

#include <algorithm>
#include <cmath>

#include "engine/error.h"

namespace halfframe {

namespace {

glm::dmat4 parent_from_local(const Node& node) {
    if (node.parent_from_local) return glm::dmat4(*node.parent_from_local);
    const glm::dmat3 turned = glm::mat3_cast(glm::normalize(glm::dquat(node.rotation)));
    glm::dmat4 matrix(turned);
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= static_cast<double>(node.scale[axis]);
    matrix[3] = glm::dvec4(glm::dvec3(node.translation), 1.0);
    return matrix;
}

/// Between two unit quaternions by the shorter way round (glTF 2.0, appendix C.4).
void slerp(std::span<const float> from, std::span<const float> to, double share, std::span<double> value) {
    double cosine = 0.0;
    for (std::size_t i = 0; i < 4; ++i) cosine += double{from[i]} * double{to[i]};
    const double sign = cosine < 0.0 ? -1.0 : 1.0;
    const double angle = std::acos(std::min(std::abs(cosine), 1.0));
    const double sine = std::sin(angle);
    // Below a millionth of a radian sine is angle to 13 digits, and 0 / 0 is near: there the chord is the arc.
    const double a = sine > 1e-6 ? std::sin((1.0 - share) * angle) / sine : 1.0 - share;
    const double b = sign * (sine > 1e-6 ? std::sin(share * angle) / sine : share);
    for (std::size_t i = 0; i < 4; ++i) value[i] = a * double{from[i]} + b * double{to[i]};
}

/// The cubic through two keys with the tangents of the file, which are per second (glTF 2.0, appendix C.5).
void cubic(std::span<const float> from, std::span<const float> to, double share, double span_s,
           std::span<double> value) {
    const std::size_t count = value.size();
    const double t = share, t2 = t * t, t3 = t2 * t;
    for (std::size_t i = 0; i < count; ++i) {
        const double start = from[count + i], leaving = from[2 * count + i], arriving = to[i], end = to[count + i];
        value[i] = (2.0 * t3 - 3.0 * t2 + 1.0) * start + (t3 - 2.0 * t2 + t) * span_s * leaving +
                   (3.0 * t2 - 2.0 * t3) * end + (t3 - t2) * span_s * arriving;
    }
}

void normalise(std::span<double> quaternion) {
    double squared = 0.0;
    for (const double part : quaternion) squared += part * part;
    if (!(squared > 1e-24)) {  // a cubic may pass through 0, where no direction is better than another
        std::ranges::fill(quaternion, 0.0);
        quaternion[3] = 1.0;
        return;
    }
    for (double& part : quaternion) part /= std::sqrt(squared);
}

/// Axes without scale or shear; a camera looks and a light shines along -Z (glTF 2.0, 3.10: a camera's scale does not
/// count).
glm::mat4 rigid(const glm::dmat4& world_from_node) {
    const glm::dvec3 back(world_from_node[2]);
    const glm::dvec3 right = glm::cross(glm::dvec3(world_from_node[1]), back);
    glm::dmat4 result(1.0);
    result[3] = world_from_node[3];
    if (!(glm::length(right) > 0.0) || !(glm::length(back) > 0.0)) return glm::mat4(result);
    const glm::dvec3 z = glm::normalize(back), x = glm::normalize(right);
    result[0] = glm::dvec4(x, 0.0);
    result[1] = glm::dvec4(glm::cross(z, x), 0.0);
    result[2] = glm::dvec4(z, 0.0);
    return glm::mat4(result);
}

}  // namespace

std::size_t components_of(const AnimationChannel& channel) {
    switch (channel.value) {
        case AnimatedValue::translation:
        case AnimatedValue::scale: return 3;
        case AnimatedValue::rotation: return 4;
        case AnimatedValue::morph_weights: break;
    }
    const std::size_t keys = channel.times_s.size() * (channel.interpolation == Interpolation::cubic_spline ? 3 : 1);
    return keys == 0 ? 0 : channel.values.size() / keys;
}

void sample(const AnimationChannel& channel, double time_s, std::span<double> value) {
    const std::size_t count = components_of(channel);
    expect(!channel.times_s.empty() && value.size() == count, "a channel without keys, or a value of another length");
    const bool is_cubic = channel.interpolation == Interpolation::cubic_spline;
    const std::size_t stride = is_cubic ? 3 * count : count;
    const auto key = [&](std::size_t index) {
        return std::span<const float>(channel.values).subspan(index * stride, stride);
    };
    const auto after = std::ranges::upper_bound(channel.times_s, time_s, {}, [](float t) { return double{t}; });
    const auto next = static_cast<std::size_t>(after - channel.times_s.begin());
    const bool outside = next == 0 || next == channel.times_s.size();
    if (outside || channel.interpolation == Interpolation::step) {
        const std::size_t held = next == 0 ? 0 : next - 1;
        std::ranges::copy(key(held).subspan(is_cubic ? count : 0, count), value.begin());
    } else {
        const double from_s = channel.times_s[next - 1], span_s = double{channel.times_s[next]} - from_s;
        const double share = (time_s - from_s) / span_s;
        const auto from = key(next - 1), to = key(next);
        if (is_cubic) {
            cubic(from, to, share, span_s, value);
        } else if (channel.value == AnimatedValue::rotation) {
            slerp(from, to, share, value);
        } else {
            for (std::size_t i = 0; i < count; ++i) value[i] = (1.0 - share) * double{from[i]} + share * double{to[i]};
        }
    }
    if (channel.value == AnimatedValue::rotation) normalise(value);
}

double looped(double time_s, double duration_s) {
    if (!(duration_s > 0.0) || !std::isfinite(time_s)) return 0.0;
    if (time_s >= 0.0 && time_s <= duration_s) return time_s;
    const double rest = std::fmod(time_s, duration_s);
    return rest < 0.0 ? rest + duration_s : rest;
}

void world_from_nodes(const Scene& scene, std::span<glm::dmat4> world_from_node) {
    expect(world_from_node.size() == scene.nodes.size(), "one matrix a node");
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        expect(node.parent < static_cast<int>(i), "a node stands before its parent");
        const glm::dmat4 local = parent_from_local(node);
        world_from_node[i] = node.parent < 0 ? local : world_from_node[static_cast<std::size_t>(node.parent)] * local;
    }
}

void place(Scene& scene, std::span<const glm::dmat4> world_from_node) {
    const auto of = [&](int node) -> const glm::dmat4& { return world_from_node[static_cast<std::size_t>(node)]; };
    for (Surface& surface : scene.surfaces) {
        if (surface.skin >= 0) {
            const Skin& skin = scene.skins[static_cast<std::size_t>(surface.skin)];
            surface.world_from_local = glm::mat4(1.0f);
            surface.world_from_local[3] = glm::vec4(glm::vec3(of(skin.joints.front())[3]), 1.0f);
        } else if (surface.node >= 0) {
            surface.world_from_local = glm::mat4(of(surface.node));
        }
    }
    for (Light& light : scene.lights) {
        if (light.node < 0) continue;
        const glm::mat4 matrix = rigid(of(light.node));
        light.position = glm::vec3(matrix[3]);
        light.direction = -glm::vec3(matrix[2]);
    }
    for (Camera& camera : scene.cameras) {
        if (camera.node >= 0) camera.world_from_view = rigid(of(camera.node));
    }
}

void place(Scene& scene) {
    std::vector<glm::dmat4> world_from_node(scene.nodes.size());
    world_from_nodes(scene, world_from_node);
    place(scene, world_from_node);
}

Animator::Animator(const Scene& scene) : world_from_node_(scene.nodes.size()) {
    for (const Node& node : scene.nodes)
        rest_.push_back({node.translation, node.rotation, node.scale, node.morph_weights});
    std::size_t longest = 4;
    for (const Animation& animation : scene.animations) {
        for (const AnimationChannel& channel : animation.channels) longest = std::max(longest, components_of(channel));
    }
    value_.resize(longest);
}

void Animator::pose(Scene& scene, int animation, double time_s) {
    expect(scene.nodes.size() == rest_.size(), "the scene has other nodes than the one this animator was made for");
    for (std::size_t i = 0; i < rest_.size(); ++i) {
        Node& node = scene.nodes[i];
        node.translation = rest_[i].translation;
        node.rotation = rest_[i].rotation;
        node.scale = rest_[i].scale;
        std::ranges::copy(rest_[i].morph_weights, node.morph_weights.begin());
    }
    if (animation >= 0) {
        const Animation& played = scene.animations.at(static_cast<std::size_t>(animation));
        const double inside_s = looped(time_s, played.duration_s);
        for (const AnimationChannel& channel : played.channels)
            apply(channel, inside_s, scene.nodes[static_cast<std::size_t>(channel.node)]);
    }
    world_from_nodes(scene, world_from_node_);
    place(scene, world_from_node_);
}

void Animator::apply(const AnimationChannel& channel, double time_s, Node& node) {
    const std::span<double> value = std::span(value_).first(components_of(channel));
    sample(channel, time_s, value);
    const auto triple = [&] { return glm::vec3(glm::dvec3(value[0], value[1], value[2])); };
    switch (channel.value) {
        case AnimatedValue::translation: node.translation = triple(); break;
        case AnimatedValue::scale: node.scale = triple(); break;
        case AnimatedValue::rotation:
            node.rotation = glm::quat(glm::dquat(value[3], value[0], value[1], value[2]));
            break;
        case AnimatedValue::morph_weights:
            for (std::size_t i = 0; i < std::min(value.size(), node.morph_weights.size()); ++i)
                node.morph_weights[i] = static_cast<float>(value[i]);
            break;
    }
}

}  // namespace halfframe
