// Checks of what moves in a glTF document: joints and weights, morph targets, skins, animations.
#include "content/gltf_document.h"

#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace halfframe::content {
namespace {

constexpr std::uint64_t kFloat = 5126;

std::size_t accessor_in(const JsonPlace& root, const JsonPlace& owner, std::string_view key) {
    (void)owner.at(key);
    return *index_in(owner, key, count_of(root, "accessors"), "accessors");
}

struct Format {
    std::string type;
    std::uint64_t component = 0;
    bool normalized = false;
    std::uint64_t count = 0;
};

Format format_of(const JsonPlace& root, std::size_t index) {
    const JsonPlace accessor = root.at("accessors").at(index);
    return {accessor.at("type").text(), accessor.at("componentType").whole(),
            accessor.has("normalized") && accessor.at("normalized").boolean(), accessor.at("count").whole()};
}

bool is_signed_normalized(const Format& format) {
    return format.normalized && (format.component == 5120 || format.component == 5122);
}

void check_target(const GltfDocument& document, const JsonPlace& target, std::uint64_t vertices) {
    target.expect_object();
    const JsonPlace root = document.root();
    const bool quantized = document.uses_extension("KHR_mesh_quantization");
    for (const JsonMember& member : target.value().members()) {
        const std::string& name = *member.key;
        const Format format = format_of(root, accessor_in(root, target, name));
        if (name == "POSITION" || name == "NORMAL" || name == "TANGENT") {
            const bool small = quantized && (name == "POSITION" ? format.component >= 5120 && format.component <= 5123
                                                                : is_signed_normalized(format));
            if (format.type != "VEC3" || !(format.component == kFloat || small)) {
                target.at(name).fail(fmt::format("a morph target's {} is VEC3 of float{}", name,
                                                 quantized ? ", or of small integers" : ""));
            }
        }
        if (format.count != vertices) {
            target.at(name).fail(
                fmt::format("has {} elements but the primitive has {} vertices", format.count, vertices));
        }
    }
}

std::size_t check_targets(const GltfDocument& document, const JsonPlace& mesh) {
    std::size_t targets = 0;
    for_each_object(mesh, "primitives", [&](const JsonPlace& primitive, std::size_t index) {
        const std::size_t here = count_of(primitive, "targets");
        if (index > 0 && here != targets) {
            primitive.fail(fmt::format("has {} morph targets but the first primitive has {}", here, targets));
        }
        targets = here;
        if (here == 0 || !primitive.at("attributes").has("POSITION")) return;
        const JsonPlace root = document.root();
        const std::uint64_t vertices = format_of(root, accessor_in(root, primitive.at("attributes"), "POSITION")).count;
        for (std::size_t i = 0; i < here; ++i) check_target(document, primitive.at("targets").at(i), vertices);
    });
    if (mesh.has("weights")) mesh.at("weights").expect_numbers(targets, -3.4e38, 3.4e38);
    return targets;
}

void check_skin(const JsonPlace& root, const JsonPlace& skin) {
    if (skin.at("joints").size() == 0) skin.at("joints").fail("is empty");
    if (!skin.has("inverseBindMatrices")) return;
    const Format format = format_of(root, accessor_in(root, skin, "inverseBindMatrices"));
    if (format.type != "MAT4" || format.component != kFloat) {
        skin.at("inverseBindMatrices").fail("is not an accessor of MAT4 of float");
    }
    if (format.count < skin.at("joints").size()) {
        skin.at("inverseBindMatrices")
            .fail(fmt::format("has {} matrices for {} joints", format.count, skin.at("joints").size()));
    }
}

/// A skinned mesh has joints and weights in every primitive (glTF 2.0, section 3.7.3.1).
void check_skinned_node(const JsonPlace& root, const JsonPlace& node) {
    if (!node.has("mesh")) node.at("skin").fail("skins a node without a mesh");
    const JsonPlace mesh = root.at("meshes").at(static_cast<std::size_t>(node.at("mesh").whole()));
    for_each_object(mesh, "primitives", [&](const JsonPlace& primitive, std::size_t) {
        for (const char* name : {"JOINTS_0", "WEIGHTS_0"}) {
            if (!primitive.at("attributes").has(name)) {
                node.at("skin").fail(fmt::format("skins {}, which has no {}", primitive.pointer(), name));
            }
        }
    });
}

void check_node(const JsonPlace& root, const JsonPlace& node) {
    if (node.has("skin")) check_skinned_node(root, node);
    if (!node.has("weights")) return;
    std::size_t targets = 0;
    if (node.has("mesh")) {
        const JsonPlace mesh = root.at("meshes").at(static_cast<std::size_t>(node.at("mesh").whole()));
        if (mesh.at("primitives").size() > 0) targets = count_of(mesh.at("primitives").at(std::size_t{0}), "targets");
    }
    node.at("weights").expect_numbers(targets, -3.4e38, 3.4e38);
}

struct Output {
    const char* type;
    std::uint64_t components;  ///< 0: one a morph target
};

/// The shape that a channel's path asks of its output.
Output output_of(const JsonPlace& target) {
    const std::string& path = target.at("path").text();
    if (path == "translation" || path == "scale") return {"VEC3", 3};
    if (path == "rotation") return {"VEC4", 4};
    if (path == "weights") return {"SCALAR", 0};
    target.at("path").fail(fmt::format("'{}' is not translation, rotation, scale or weights", path));
}

std::uint64_t targets_of(const JsonPlace& root, const JsonPlace& target) {
    const JsonPlace node = root.at("nodes").at(static_cast<std::size_t>(target.at("node").whole()));
    if (node.has("mesh")) {
        const JsonPlace mesh = root.at("meshes").at(static_cast<std::size_t>(node.at("mesh").whole()));
        if (mesh.at("primitives").size() > 0) {
            const std::size_t targets = count_of(mesh.at("primitives").at(std::size_t{0}), "targets");
            if (targets > 0) return targets;
        }
    }
    target.at("path").fail("moves morph targets of a node that has none");
}

void check_channel(const JsonPlace& root, const JsonPlace& animation, const JsonPlace& channel) {
    const JsonPlace target = channel.at("target");
    if (!target.has("node")) return;  // left out, with a notice
    const Output wanted = output_of(target);
    const JsonPlace node = root.at("nodes").at(static_cast<std::size_t>(target.at("node").whole()));
    if (wanted.components != 0 && node.has("matrix")) {
        target.at("node").fail(fmt::format("{} has a matrix, which cannot be animated", node.pointer()),
                               "give the node a translation, rotation and scale");
    }
    const std::uint64_t values_each = wanted.components == 0 ? targets_of(root, target) : 1;
    const JsonPlace sampler = animation.at("samplers").at(static_cast<std::size_t>(channel.at("sampler").whole()));
    const Format times = format_of(root, accessor_in(root, sampler, "input"));
    const Format values = format_of(root, accessor_in(root, sampler, "output"));
    const bool is_plain = wanted.components == 3;  // translations and scales are floats, the others may be integers
    const bool integers = values.normalized && values.component >= 5120 && values.component <= 5123;
    if (values.type != wanted.type || !(values.component == kFloat || (!is_plain && integers))) {
        sampler.at("output").fail(fmt::format("{} needs {} of float{}", target.at("path").text(), wanted.type,
                                              is_plain ? "" : " or of normalized integers"));
    }
    const bool is_cubic = sampler.has("interpolation") && sampler.at("interpolation").text() == "CUBICSPLINE";
    const std::uint64_t each = (is_cubic ? 3 : 1) * values_each;
    if (values.count != times.count * each) {
        sampler.at("output").fail(
            fmt::format("has {} elements; {} times need {}", values.count, times.count, times.count * each));
    }
}

void check_animation(const JsonPlace& root, const JsonPlace& animation) {
    for_each_object(animation, "samplers", [&](const JsonPlace& sampler, std::size_t) {
        const Format times = format_of(root, accessor_in(root, sampler, "input"));
        if (times.type != "SCALAR" || times.component != kFloat) {
            sampler.at("input").fail("is not an accessor of SCALAR of float");
        }
        if (sampler.has("interpolation")) {
            const std::string& way = sampler.at("interpolation").text();
            if (way != "LINEAR" && way != "STEP" && way != "CUBICSPLINE") {
                sampler.at("interpolation").fail(fmt::format("'{}' is not LINEAR, STEP or CUBICSPLINE", way));
            }
        }
    });
    std::set<std::pair<std::uint64_t, std::string>> seen;
    for_each_object(animation, "channels", [&](const JsonPlace& channel, std::size_t) {
        check_channel(root, animation, channel);
        const JsonPlace target = channel.at("target");
        if (!target.has("node")) return;
        if (!seen.insert({target.at("node").whole(), target.at("path").text()}).second) {
            target.fail(fmt::format("another channel of the animation moves the {} of node {} too",
                                    target.at("path").text(), target.at("node").whole()));
        }
    });
}

}  // namespace

void check_gltf_motion(const GltfDocument& document) {
    const JsonPlace root = document.root();
    for_each_object(root, "meshes", [&](const JsonPlace& mesh, std::size_t) { (void)check_targets(document, mesh); });
    for_each_object(root, "skins", [&](const JsonPlace& skin, std::size_t) { check_skin(root, skin); });
    for_each_object(root, "nodes", [&](const JsonPlace& node, std::size_t) { check_node(root, node); });
    for_each_object(root, "animations",
                    [&](const JsonPlace& animation, std::size_t) { check_animation(root, animation); });
}

}  // namespace halfframe::content
