// Checks of the scene half of a glTF document: meshes, skins, animations, nodes and their tree, scenes.
#include "content/gltf_document.h"

#include <string>
#include <unordered_set>
#include <vector>

#include <fmt/format.h>

namespace halfframe::content {
namespace {

constexpr double kLargestFloat = 3.4e38;

std::size_t needed_index(const JsonPlace& owner, std::string_view key, std::size_t count, std::string_view what) {
    (void)owner.at(key);
    return *index_in(owner, key, count, what);
}

/// Every value of an object of accessor indices (attributes, a morph target).
void check_accessor_map(const JsonPlace& root, const JsonPlace& map) {
    map.expect_object();
    for (const JsonMember& member : map.value().members()) {
        (void)needed_index(map, *member.key, count_of(root, "accessors"), "accessors");
    }
}

struct Format {
    std::string type;
    std::uint64_t component = 0;
    bool normalized = false;
};

Format format_of(const JsonPlace& accessor) {
    return {accessor.at("type").text(), accessor.at("componentType").whole(),
            accessor.has("normalized") && accessor.at("normalized").boolean()};
}

/// What glTF 2.0 (section 3.7.2.1) and KHR_mesh_quantization allow for the attributes that are read.
bool is_allowed(const std::string& attribute, const Format& format, bool quantized) {
    const bool is_float = format.component == 5126;
    const bool small = format.component >= 5120 && format.component <= 5123;
    const bool small_signed_normalized = format.normalized && (format.component == 5120 || format.component == 5122);
    const bool small_unsigned_normalized = format.normalized && (format.component == 5121 || format.component == 5123);
    if (attribute == "POSITION") {
        return format.type == "VEC3" && (is_float || (quantized && small));
    }
    if (attribute == "NORMAL") {
        return format.type == "VEC3" && (is_float || (quantized && small_signed_normalized));
    }
    if (attribute == "TANGENT") {
        return format.type == "VEC4" && (is_float || (quantized && small_signed_normalized));
    }
    if (attribute.starts_with("TEXCOORD_")) {
        return format.type == "VEC2" && (is_float || small_unsigned_normalized || (quantized && small));
    }
    if (attribute.starts_with("COLOR_")) {
        return (format.type == "VEC3" || format.type == "VEC4") && (is_float || small_unsigned_normalized);
    }
    if (attribute.starts_with("JOINTS_")) {
        return format.type == "VEC4" && !format.normalized && (format.component == 5121 || format.component == 5123);
    }
    if (attribute.starts_with("WEIGHTS_")) {
        return format.type == "VEC4" && (is_float || small_unsigned_normalized);
    }
    return true;
}

void check_attributes(const GltfDocument& document, const JsonPlace& attributes) {
    const JsonPlace root = document.root();
    check_accessor_map(root, attributes);
    const bool quantized = document.uses_extension("KHR_mesh_quantization");
    std::uint64_t vertices = 0;
    for (const JsonMember& member : attributes.value().members()) {
        const std::string& name = *member.key;
        const JsonPlace place = attributes.at(name);
        const JsonPlace accessor = root.at("accessors").at(static_cast<std::size_t>(place.whole()));
        const Format format = format_of(accessor);
        if (!is_allowed(name, format, quantized)) {
            place.fail(fmt::format("accessor {} is {} of component type {}{}, which {} does not allow", place.whole(),
                                   format.type, format.component, format.normalized ? ", normalized" : "", name));
        }
        const std::uint64_t count = accessor.at("count").whole();
        if (vertices != 0 && count != vertices) {
            place.fail(fmt::format("has {} elements but another attribute of the primitive has {}", count, vertices));
        }
        vertices = count;
    }
}

void check_primitive(const GltfDocument& document, const JsonPlace& primitive) {
    const JsonPlace root = document.root();
    check_attributes(document, primitive.at("attributes"));
    if (primitive.has("mode")) {
        (void)primitive.at("mode").whole(0, 6);
    }
    (void)index_in(primitive, "material", count_of(root, "materials"), "materials");
    if (const auto indices = index_in(primitive, "indices", count_of(root, "accessors"), "accessors")) {
        const JsonPlace accessor = root.at("accessors").at(*indices);
        const Format format = format_of(accessor);
        const bool is_unsigned = format.component == 5121 || format.component == 5123 || format.component == 5125;
        if (format.type != "SCALAR" || !is_unsigned || format.normalized) {
            primitive.at("indices").fail(
                fmt::format("accessor {} is {} of component type {}{}, but indices are SCALAR of 5121, "
                            "5123 or 5125",
                            *indices, format.type, format.component, format.normalized ? ", normalized" : ""));
        }
        if (accessor.has("bufferView") &&
            root.at("bufferViews").at(static_cast<std::size_t>(accessor.at("bufferView").whole())).has("byteStride")) {
            primitive.at("indices").fail(
                fmt::format("accessor {} lies in a buffer view with a byteStride, which indices "
                            "do not allow",
                            *indices));
        }
    }
    for_each_object(primitive, "targets",
                    [&](const JsonPlace& target, std::size_t) { check_accessor_map(root, target); });
}

void check_meshes(const GltfDocument& document) {
    for_each_object(document.root(), "meshes", [&](const JsonPlace& mesh, std::size_t) {
        if (mesh.at("primitives").size() == 0) {
            mesh.at("primitives").fail("is empty");
        }
        for_each_object(mesh, "primitives",
                        [&](const JsonPlace& primitive, std::size_t) { check_primitive(document, primitive); });
    });
}

void check_index_list(const JsonPlace& owner, std::string_view key, std::size_t count, std::string_view what) {
    if (const auto list = owner.find(key)) {
        std::unordered_set<std::uint64_t> seen;
        for (std::size_t i = 0; i < list->size(); ++i) {
            const std::uint64_t index = list->at(i).whole();
            if (index >= count) {
                list->at(i).fail(fmt::format("points at number {} of {} {}", index, count, what));
            }
            if (!seen.insert(index).second) {
                list->at(i).fail(fmt::format("names number {} a second time", index));
            }
        }
    }
}

void check_skins_and_animations(const JsonPlace& root) {
    const std::size_t nodes = count_of(root, "nodes");
    const std::size_t accessors = count_of(root, "accessors");
    for_each_object(root, "skins", [&](const JsonPlace& skin, std::size_t) {
        (void)skin.at("joints").size();
        check_index_list(skin, "joints", nodes, "nodes");
        (void)index_in(skin, "skeleton", nodes, "nodes");
        (void)index_in(skin, "inverseBindMatrices", accessors, "accessors");
    });
    for_each_object(root, "animations", [&](const JsonPlace& animation, std::size_t) {
        for_each_object(animation, "samplers", [&](const JsonPlace& sampler, std::size_t) {
            (void)needed_index(sampler, "input", accessors, "accessors");
            (void)needed_index(sampler, "output", accessors, "accessors");
        });
        for_each_object(animation, "channels", [&](const JsonPlace& channel, std::size_t) {
            (void)needed_index(channel, "sampler", count_of(animation, "samplers"), "samplers of the animation");
            (void)index_in(channel.at("target"), "node", nodes, "nodes");
        });
    });
}

/// A node's matrix is a translation, a rotation and a scale (glTF 2.0, section 3.5.3): its last row is 0 0 0 1.
void expect_affine(const JsonPlace& matrix) {
    for (std::size_t column = 0; column < 4; ++column) {
        const double number = matrix.value().elements()[4 * column + 3].number();  // numbers, as was checked
        // 1e-4: what exporters leave of products of rounded matrices.
        if (std::abs(number - (column == 3 ? 1.0 : 0.0)) > 1e-4) {
            matrix.fail(fmt::format("has {} in its last row, which must be 0 0 0 1", number));
        }
    }
}

void check_node(const JsonPlace& root, const JsonPlace& node) {
    (void)index_in(node, "mesh", count_of(root, "meshes"), "meshes");
    (void)index_in(node, "camera", count_of(root, "cameras"), "cameras");
    (void)index_in(node, "skin", count_of(root, "skins"), "skins");
    check_index_list(node, "children", count_of(root, "nodes"), "nodes");
    struct Part {
        const char* key;
        std::size_t numbers;
    };
    for (const Part& part : {Part{"matrix", 16}, Part{"translation", 3}, Part{"rotation", 4}, Part{"scale", 3}}) {
        if (const auto place = node.find(part.key)) {
            place->expect_numbers(part.numbers, -kLargestFloat, kLargestFloat);
            if (part.numbers == 16) expect_affine(*place);
            if (part.numbers != 16 && node.has("matrix")) {
                node.fail(fmt::format("has a matrix and a {} too", part.key));
            }
        }
    }
    if (const auto rotation = node.find("rotation")) {
        double squared = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
            const double component = rotation->at(i).number(-1.0001, 1.0001);
            squared += component * component;
        }
        // Half of a unit quaternion is still a clear direction; a zero one is none. Exporters round to 3 digits and
        // less.
        if (squared < 0.25) {
            rotation->fail("is not a unit quaternion");
        }
    }
}

/// Every node has one parent at most, and nobody is his own ancestor.
std::vector<int> checked_parents(const JsonPlace& root) {
    std::vector<int> parent(count_of(root, "nodes"), -1);
    for_each_object(root, "nodes", [&](const JsonPlace& node, std::size_t index) {
        const auto children = node.find("children");
        for (std::size_t i = 0; children && i < children->size(); ++i) {
            const JsonPlace place = children->at(i);
            int& of_child = parent[static_cast<std::size_t>(place.whole())];
            if (of_child >= 0) {
                place.fail(fmt::format("node {} is already a child of node {}", place.whole(), of_child));
            }
            of_child = static_cast<int>(index);
        }
    });
    // With one parent each, a cycle is a walk upwards that comes back: colour each node by the walk that met it first.
    std::vector<int> walk_of(parent.size(), -1);
    for (std::size_t start = 0; start < parent.size(); ++start) {
        std::size_t at = start;
        while (walk_of[at] < 0) {
            walk_of[at] = static_cast<int>(start);
            if (parent[at] < 0) {
                break;
            }
            const auto above = static_cast<std::size_t>(parent[at]);
            if (walk_of[above] == static_cast<int>(start)) {
                root.at("nodes").at(above).fail(fmt::format("is its own ancestor, by way of node {}", at));
            }
            at = above;
        }
    }
    return parent;
}

void check_scenes(const JsonPlace& root, const std::vector<int>& parent) {
    for_each_object(root, "scenes", [&](const JsonPlace& scene, std::size_t) {
        check_index_list(scene, "nodes", parent.size(), "nodes");
        for (std::size_t i = 0; i < count_of(scene, "nodes"); ++i) {
            const JsonPlace place = scene.at("nodes").at(i);
            const int above = parent[static_cast<std::size_t>(place.whole())];
            if (above >= 0) {
                place.fail(fmt::format("node {} is not a root: it is a child of node {}", place.whole(), above));
            }
        }
    });
    (void)index_in(root, "scene", count_of(root, "scenes"), "scenes");
}

}  // namespace

void check_gltf_scenes(const GltfDocument& document) {
    const JsonPlace root = document.root();
    check_meshes(document);
    check_skins_and_animations(root);
    for_each_object(root, "nodes", [&](const JsonPlace& node, std::size_t) { check_node(root, node); });
    check_scenes(root, checked_parents(root));
}

}  // namespace halfframe::content
