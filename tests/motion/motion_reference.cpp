// Animations and skins word by word.
#include "tests/motion/motion_reference.h"

#include <cmath>

namespace halfframe::tests {
namespace {

Quadruple product(const Quadruple& a, const Quadruple& b) {
    return {
        a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1], a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
        a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3], a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2]};
}

Quadruple unit(Quadruple q) {
    const double length = std::sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (double& part : q) part /= length;
    return q;
}

Quadruple conjugate(const Quadruple& q) { return {-q[0], -q[1], -q[2], q[3]}; }

Triple turned(const Quadruple& q, const Triple& v) {
    const Quadruple result = product(product(q, {v[0], v[1], v[2], 0.0}), conjugate(q));
    return {result[0], result[1], result[2]};
}

/// a (a^-1 b)^share, by the shorter way.
Quadruple between(const Quadruple& a, const Quadruple& b, double share) {
    Quadruple step = product(conjugate(a), b);
    if (step[3] < 0.0) {
        for (double& part : step) part = -part;
    }
    const double sine = std::sqrt(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]);
    const double half = std::atan2(sine, step[3]) * share;
    const double scale = sine > 0.0 ? std::sin(half) / sine : 0.0;
    return product(a, {step[0] * scale, step[1] * scale, step[2] * scale, std::cos(half)});
}

/// Hermite's cubic as Bezier's, by de Casteljau.
double cubic(double start, double leaving, double arriving, double end, double span_s, double share) {
    std::array<double, 4> points{start, start + span_s * leaving / 3.0, end - span_s * arriving / 3.0, end};
    for (std::size_t count = 3; count > 0; --count) {
        for (std::size_t i = 0; i < count; ++i) points[i] += share * (points[i + 1] - points[i]);
    }
    return points[0];
}

}  // namespace

Triple applied(const Frame& frame, const Triple& at) {
    Triple result = frame.origin;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t i = 0; i < 3; ++i) result[i] += frame.axes[axis][i] * at[axis];
    }
    return result;
}

Frame after(const Frame& outer, const Frame& inner) {
    Frame result;
    result.origin = applied(outer, inner.origin);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Triple tip = applied(outer, inner.axes[axis]);
        for (std::size_t i = 0; i < 3; ++i) result.axes[axis][i] = tip[i] - outer.origin[i];
    }
    return result;
}

std::vector<double> reference_sample(const AnimationChannel& channel, double time_s) {
    const bool is_cubic = channel.interpolation == Interpolation::cubic_spline;
    const std::size_t keys = channel.times_s.size();
    const std::size_t components = channel.values.size() / keys / (is_cubic ? 3 : 1);
    const auto value = [&](std::size_t key, std::size_t which, std::size_t i) {
        return double{channel.values[(is_cubic ? 3 * key + which : key) * components + i]};
    };
    std::vector<double> result(components);
    std::size_t before = 0;
    while (before + 1 < keys && double{channel.times_s[before + 1]} <= time_s) ++before;
    const bool held =
        time_s < double{channel.times_s[0]} || before + 1 == keys || channel.interpolation == Interpolation::step;
    for (std::size_t i = 0; i < components; ++i) result[i] = value(before, 1, i);
    if (!held) {
        const double span_s = double{channel.times_s[before + 1]} - double{channel.times_s[before]};
        const double share = (time_s - double{channel.times_s[before]}) / span_s;
        for (std::size_t i = 0; i < components; ++i) {
            result[i] = is_cubic ? cubic(value(before, 1, i), value(before, 2, i), value(before + 1, 0, i),
                                         value(before + 1, 1, i), span_s, share)
                                 : value(before, 1, i) + share * (value(before + 1, 1, i) - value(before, 1, i));
        }
        if (channel.value == AnimatedValue::rotation && !is_cubic) {
            Quadruple a, b;
            for (std::size_t i = 0; i < 4; ++i) {
                a[i] = value(before, 1, i);
                b[i] = value(before + 1, 1, i);
            }
            const Quadruple q = between(unit(a), unit(b), share);
            result.assign(q.begin(), q.end());
        }
    }
    if (channel.value == AnimatedValue::rotation) {
        const Quadruple q = unit({result[0], result[1], result[2], result[3]});
        result.assign(q.begin(), q.end());
    }
    return result;
}

std::vector<Frame> reference_nodes(const Scene& scene, int animation, double time_s) {
    std::vector<Frame> world;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const Node& node = scene.nodes[n];
        std::vector<double> translation{node.translation.x, node.translation.y, node.translation.z};
        std::vector<double> rotation{node.rotation.x, node.rotation.y, node.rotation.z, node.rotation.w};
        std::vector<double> scale{node.scale.x, node.scale.y, node.scale.z};
        if (animation >= 0) {
            for (const AnimationChannel& channel : scene.animations[static_cast<std::size_t>(animation)].channels) {
                if (channel.node != static_cast<int>(n)) continue;
                if (channel.value == AnimatedValue::translation) translation = reference_sample(channel, time_s);
                if (channel.value == AnimatedValue::rotation) rotation = reference_sample(channel, time_s);
                if (channel.value == AnimatedValue::scale) scale = reference_sample(channel, time_s);
            }
        }
        Frame local;
        if (node.parent_from_local) {
            for (std::size_t axis = 0; axis < 4; ++axis) {
                for (std::size_t i = 0; i < 3; ++i)
                    (axis < 3 ? local.axes[axis] : local.origin)[i] =
                        double{(*node.parent_from_local)[static_cast<int>(axis)][static_cast<int>(i)]};
            }
        } else {
            const Quadruple q = unit({rotation[0], rotation[1], rotation[2], rotation[3]});
            for (std::size_t axis = 0; axis < 3; ++axis) {
                Triple tip{};
                tip[axis] = scale[axis];
                local.axes[axis] = turned(q, tip);
            }
            local.origin = {translation[0], translation[1], translation[2]};
        }
        world.push_back(node.parent < 0 ? local : after(world[static_cast<std::size_t>(node.parent)], local));
    }
    return world;
}

Triple reference_skinned(const Scene& scene, const Surface& surface, const std::vector<Frame>& nodes, const Triple& at,
                         const std::array<int, 4>& joints, const Quadruple& weights) {
    const Skin& skin = scene.skins[static_cast<std::size_t>(surface.skin)];
    Triple sum{};
    for (std::size_t k = 0; k < 4; ++k) {
        if (weights[k] == 0.0) continue;
        const auto joint = static_cast<std::size_t>(joints[k]);
        Frame joint_from_mesh;
        for (std::size_t axis = 0; axis < 4; ++axis) {
            for (std::size_t i = 0; i < 3; ++i)
                (axis < 3 ? joint_from_mesh.axes[axis] : joint_from_mesh.origin)[i] =
                    double{skin.joint_from_mesh[joint][static_cast<int>(axis)][static_cast<int>(i)]};
        }
        const Triple place = applied(nodes[static_cast<std::size_t>(skin.joints[joint])], applied(joint_from_mesh, at));
        for (std::size_t i = 0; i < 3; ++i) sum[i] += weights[k] * place[i];
    }
    return sum;
}

}  // namespace halfframe::tests
