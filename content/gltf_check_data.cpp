// Checks of the data half of a glTF document: buffers, views, accessors, images, samplers, textures, materials,
// cameras.
#include "content/gltf_document.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "content/gltf_extensions.h"

namespace halfframe::content {
namespace {

constexpr double kLargestFloat = 3.4e38;
// Offsets and lengths in JSON: below 2^53 they are exact, so sums of three of them cannot wrap in 64 bits.
constexpr std::uint64_t kLargestOffset = 1ull << 53;

std::uint64_t whole_or(const JsonPlace& owner, std::string_view key, std::uint64_t otherwise) {
    const auto place = owner.find(key);
    return place ? place->whole(0, kLargestOffset) : otherwise;
}

void check_buffers(const JsonPlace& root) {
    std::uint64_t total = 0;
    for_each_object(root, "buffers", [&](const JsonPlace& buffer, std::size_t) {
        total += buffer.at("byteLength").whole(1, kMostBufferBytes);
        if (total > kMostBufferBytes) {
            buffer.fail(fmt::format("all buffers up to here have over {} bytes", kMostBufferBytes), "split the asset");
        }
        if (buffer.has("uri")) {
            (void)buffer.at("uri").text();
        }
    });
}

void check_buffer_views(const JsonPlace& root) {
    for_each_object(root, "bufferViews", [&](const JsonPlace& view, std::size_t) {
        (void)view.at("buffer");
        const std::size_t buffer = *index_in(view, "buffer", count_of(root, "buffers"), "buffers");
        const std::uint64_t offset = whole_or(view, "byteOffset", 0);
        const std::uint64_t length = view.at("byteLength").whole(1, kLargestOffset);
        const std::uint64_t available = root.at("buffers").at(buffer).at("byteLength").whole();
        if (offset + length > available) {
            view.fail(fmt::format("ends at byte {} of buffer {}, which has {}", offset + length, buffer, available));
        }
        if (view.has("byteStride") && view.at("byteStride").whole(4, 252) % 4 != 0) {
            view.at("byteStride").fail("is not a multiple of 4");
        }
    });
}

/// `bytes` bytes from `offset` on must lie inside the buffer view that `owner` names.
void check_inside_view(const JsonPlace& root, const JsonPlace& owner, std::uint64_t bytes) {
    const std::uint64_t offset = whole_or(owner, "byteOffset", 0);
    const auto view = static_cast<std::size_t>(owner.at("bufferView").whole());
    const std::uint64_t available = root.at("bufferViews").at(view).at("byteLength").whole(1, kLargestOffset);
    if (offset + bytes > available) {
        owner.fail(fmt::format("ends at byte {} of buffer view {}, which has {}", offset + bytes, view, available));
    }
}

void check_sparse(const JsonPlace& root, const JsonPlace& accessor, std::uint64_t count, std::uint64_t bytes_each) {
    const JsonPlace sparse = accessor.at("sparse");
    const std::uint64_t replaced = sparse.at("count").whole(1, count);
    const JsonPlace indices = sparse.at("indices");
    const JsonPlace values = sparse.at("values");
    for (const JsonPlace& part : {indices, values}) {
        (void)part.at("bufferView");
        (void)index_in(part, "bufferView", count_of(root, "bufferViews"), "buffer views");
    }
    const std::uint64_t type = indices.at("componentType").whole();
    if (type != 5121 && type != 5123 && type != 5125) {
        indices.at("componentType").fail(fmt::format("{} is not an unsigned integer type (5121, 5123, 5125)", type));
    }
    check_inside_view(root, indices, replaced * component_bytes(type));
    check_inside_view(root, values, replaced * bytes_each);
}

void check_accessor(const JsonPlace& root, const JsonPlace& accessor) {
    const std::uint64_t component_type = accessor.at("componentType").whole();
    if (component_bytes(component_type) == 0) {
        accessor.at("componentType")
            .fail(fmt::format("{} is not one of 5120, 5121, 5122, 5123, 5125, 5126", component_type));
    }
    const std::uint64_t bytes_each = element_bytes(component_type, accessor.at("type").text());
    if (bytes_each == 0) {
        accessor.at("type").fail("is not one of SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3, MAT4");
    }
    if (accessor.has("normalized") && accessor.at("normalized").boolean() &&
        (component_type == 5125 || component_type == 5126)) {
        accessor.at("normalized").fail("only 8 and 16 bit integers can be normalized");
    }
    const std::uint64_t count = accessor.at("count").whole(1, kMostElements);
    const auto view = index_in(accessor, "bufferView", count_of(root, "bufferViews"), "buffer views");
    if (view) {
        const std::uint64_t stride = whole_or(root.at("bufferViews").at(*view), "byteStride", bytes_each);
        if (stride < bytes_each) {
            root.at("bufferViews")
                .at(*view)
                .at("byteStride")
                .fail(fmt::format("is {} but an element of {} has {} bytes", stride, accessor.pointer(), bytes_each));
        }
        check_inside_view(root, accessor, stride * (count - 1) + bytes_each);
    } else if (accessor.has("byteOffset")) {
        accessor.at("byteOffset").fail("has no meaning without a bufferView");
    }
    if (accessor.has("sparse")) {
        check_sparse(root, accessor, count, bytes_each);
    }
}

void check_images(const JsonPlace& root) {
    for_each_object(root, "images", [&](const JsonPlace& image, std::size_t) {
        const auto view = index_in(image, "bufferView", count_of(root, "bufferViews"), "buffer views");
        if (image.has("uri") == view.has_value()) {
            image.fail("needs either a 'uri' or a 'bufferView', one of the two");
        }
        if (image.has("uri")) {
            (void)image.at("uri").text();
        }
        const std::string mime = image.has("mimeType") ? image.at("mimeType").text() : std::string();
        if (!mime.empty() && mime != "image/png" && mime != "image/jpeg") {
            image.at("mimeType")
                .fail(fmt::format("'{}' is not image/png or image/jpeg", mime), "convert it to PNG or JPEG");
        }
    });
}

void expect_one_of(const JsonPlace& owner, std::string_view key, std::initializer_list<std::uint64_t> allowed) {
    if (owner.has(key)) {
        const std::uint64_t value = owner.at(key).whole();
        if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) {
            owner.at(key).fail(fmt::format("{} is not a value that glTF allows here", value));
        }
    }
}

void check_samplers_and_textures(const JsonPlace& root) {
    for_each_object(root, "samplers", [&](const JsonPlace& sampler, std::size_t) {
        expect_one_of(sampler, "wrapS", {10497, 33071, 33648});
        expect_one_of(sampler, "wrapT", {10497, 33071, 33648});
        expect_one_of(sampler, "magFilter", {9728, 9729});
        expect_one_of(sampler, "minFilter", {9728, 9729, 9984, 9985, 9986, 9987});
    });
    for_each_object(root, "textures", [&](const JsonPlace& texture, std::size_t) {
        (void)index_in(texture, "source", count_of(root, "images"), "images");
        (void)index_in(texture, "sampler", count_of(root, "samplers"), "samplers");
    });
}

void check_number(const JsonPlace& owner, std::string_view key, double lowest, double highest) {
    if (const auto number = owner.find(key)) (void)number->number(lowest, highest);
}

void check_material(const JsonPlace& root, const JsonPlace& material) {
    if (material.has("pbrMetallicRoughness")) {
        const JsonPlace pbr = material.at("pbrMetallicRoughness");
        if (pbr.has("baseColorFactor")) {
            pbr.at("baseColorFactor").expect_numbers(4, 0.0, 1.0);
        }
        check_number(pbr, "metallicFactor", 0.0, 1.0);
        check_number(pbr, "roughnessFactor", 0.0, 1.0);
        check_texture_use(root, pbr, "baseColorTexture");
        check_texture_use(root, pbr, "metallicRoughnessTexture");
    }
    check_texture_use(root, material, "normalTexture");
    check_texture_use(root, material, "occlusionTexture");
    check_texture_use(root, material, "emissiveTexture");
    if (material.has("emissiveFactor")) {
        material.at("emissiveFactor").expect_numbers(3, 0.0, 1.0);
    }
    if (material.has("alphaMode")) {
        const std::string& mode = material.at("alphaMode").text();
        if (mode != "OPAQUE" && mode != "MASK" && mode != "BLEND") {
            material.at("alphaMode").fail(fmt::format("'{}' is not OPAQUE, MASK or BLEND", mode));
        }
    }
    check_number(material, "alphaCutoff", 0.0, kLargestFloat);
    if (material.has("doubleSided")) {
        (void)material.at("doubleSided").boolean();
    }
}

void check_camera(const JsonPlace& camera) {
    const std::string& type = camera.at("type").text();
    if (type != "perspective" && type != "orthographic") {
        camera.at("type").fail(fmt::format("'{}' is not perspective or orthographic", type));
    }
    const JsonPlace lens = camera.at(type);
    constexpr double kSmallest = 1e-30;
    if (type == "perspective") {
        (void)lens.at("yfov").number(1e-6, 3.14159);
        (void)lens.at("znear").number(kSmallest, kLargestFloat);
        check_number(lens, "aspectRatio", kSmallest, kLargestFloat);
    } else {
        (void)lens.at("xmag").number(-kLargestFloat, kLargestFloat);
        if (std::abs(lens.at("ymag").number(-kLargestFloat, kLargestFloat)) < kSmallest) {
            lens.at("ymag").fail("is 0, so nothing would be seen");
        }
        (void)lens.at("znear").number(0.0, kLargestFloat);
        (void)lens.at("zfar");
    }
    if (lens.has("zfar") && lens.at("zfar").number(0.0, kLargestFloat) <= lens.at("znear").number()) {
        lens.at("zfar").fail("is not beyond znear");
    }
}

}  // namespace

void check_texture_use(const JsonPlace& root, const JsonPlace& owner, std::string_view key) {
    if (const auto use = owner.find(key)) {
        (void)use->at("index");
        (void)index_in(*use, "index", count_of(root, "textures"), "textures");
        if (const auto set = use->find("texCoord")) (void)set->whole(0, 15);
        check_number(*use, "scale", -kLargestFloat, kLargestFloat);
        check_number(*use, "strength", 0.0, 1.0);
        check_texture_transform(*use);
    }
}

std::uint64_t component_bytes(std::uint64_t component_type) {
    switch (component_type) {
        case 5120:
        case 5121: return 1;
        case 5122:
        case 5123: return 2;
        case 5125:
        case 5126: return 4;
        default: return 0;
    }
}

std::uint64_t element_bytes(std::uint64_t component_type, const std::string& type) {
    struct Shape {
        const char* type;
        std::uint64_t rows;
        std::uint64_t columns;
    };
    static constexpr std::array<Shape, 7> kShapes{{{"SCALAR", 1, 1},
                                                   {"VEC2", 2, 1},
                                                   {"VEC3", 3, 1},
                                                   {"VEC4", 4, 1},
                                                   {"MAT2", 2, 2},
                                                   {"MAT3", 3, 3},
                                                   {"MAT4", 4, 4}}};
    for (const Shape& shape : kShapes) {
        if (type == shape.type) {
            const std::uint64_t column = shape.rows * component_bytes(component_type);
            return shape.columns == 1 ? column : shape.columns * ((column + 3) / 4 * 4);
        }
    }
    return 0;
}

void check_gltf_data(const GltfDocument& document) {
    const JsonPlace root = document.root();
    check_buffers(root);
    check_buffer_views(root);
    for_each_object(root, "accessors", [&](const JsonPlace& accessor, std::size_t) { check_accessor(root, accessor); });
    check_images(root);
    check_samplers_and_textures(root);
    for_each_object(root, "materials", [&](const JsonPlace& material, std::size_t) { check_material(root, material); });
    for_each_object(root, "cameras", [&](const JsonPlace& camera, std::size_t) { check_camera(camera); });
}

}  // namespace halfframe::content
