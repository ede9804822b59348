// The one place that calls tinygltf: its types are filled from the document, images are decoded by its stb_image.
#include "content/gltf_model.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "content/gltf_extensions.h"
#include "engine/error.h"

namespace halfframe::content {
namespace {

int whole(const JsonPlace& place) { return static_cast<int>(place.whole()); }

int index_or_none(const JsonPlace& owner, std::string_view key) {
    const auto place = owner.find(key);
    return place ? whole(*place) : -1;
}

std::size_t offset_of(const JsonPlace& owner, std::string_view key) {
    const auto place = owner.find(key);
    return place ? static_cast<std::size_t>(place->whole(0, kMostBufferBytes)) : 0;
}

std::vector<int> indices(const JsonPlace& owner, std::string_view key) {
    std::vector<int> result;
    if (const auto list = owner.find(key)) {
        result.reserve(list->size());
        for (std::size_t i = 0; i < list->size(); ++i) result.push_back(whole(list->at(i)));
    }
    return result;
}

std::map<std::string, int> accessors_by_name(const JsonPlace& place) {
    std::map<std::string, int> result;
    for (const JsonMember& member : place.value().members())
        result.emplace_hint(result.end(), *member.key, whole(place.at(*member.key)));
    return result;
}

tinygltf::BufferView view_of(const JsonPlace& view) {
    tinygltf::BufferView result;
    result.buffer = whole(view.at("buffer"));
    result.byteOffset = offset_of(view, "byteOffset");
    result.byteLength = offset_of(view, "byteLength");
    result.byteStride = offset_of(view, "byteStride");
    return result;
}

int type_of(const std::string& type) {
    if (type == "SCALAR") return TINYGLTF_TYPE_SCALAR;
    if (type == "VEC2") return TINYGLTF_TYPE_VEC2;
    if (type == "VEC3") return TINYGLTF_TYPE_VEC3;
    if (type == "VEC4") return TINYGLTF_TYPE_VEC4;
    if (type == "MAT2") return TINYGLTF_TYPE_MAT2;
    return type == "MAT3" ? TINYGLTF_TYPE_MAT3 : TINYGLTF_TYPE_MAT4;
}

tinygltf::Accessor accessor_of(const JsonPlace& accessor) {
    tinygltf::Accessor result;
    result.bufferView = index_or_none(accessor, "bufferView");
    result.byteOffset = offset_of(accessor, "byteOffset");
    result.componentType = whole(accessor.at("componentType"));
    result.normalized = accessor.has("normalized") && accessor.at("normalized").boolean();
    result.count = static_cast<std::size_t>(accessor.at("count").whole());
    result.type = type_of(accessor.at("type").text());
    result.sparse.isSparse = accessor.has("sparse");
    if (!result.sparse.isSparse) return result;
    const JsonPlace sparse = accessor.at("sparse");
    result.sparse.count = whole(sparse.at("count"));
    result.sparse.indices.bufferView = whole(sparse.at("indices").at("bufferView"));
    result.sparse.indices.byteOffset = static_cast<int>(offset_of(sparse.at("indices"), "byteOffset"));
    result.sparse.indices.componentType = whole(sparse.at("indices").at("componentType"));
    result.sparse.values.bufferView = whole(sparse.at("values").at("bufferView"));
    result.sparse.values.byteOffset = static_cast<int>(offset_of(sparse.at("values"), "byteOffset"));
    return result;
}

tinygltf::Primitive primitive_of(const JsonPlace& primitive) {
    tinygltf::Primitive result;
    result.mode = primitive.has("mode") ? whole(primitive.at("mode")) : TINYGLTF_MODE_TRIANGLES;
    result.indices = index_or_none(primitive, "indices");
    result.material = index_or_none(primitive, "material");
    result.attributes = accessors_by_name(primitive.at("attributes"));
    for_each_object(primitive, "targets",
                    [&](const JsonPlace& target, std::size_t) { result.targets.push_back(accessors_by_name(target)); });
    return result;
}

tinygltf::Mesh mesh_of(const JsonPlace& mesh) {
    tinygltf::Mesh result;
    result.name = name_of(mesh);
    for_each_object(mesh, "primitives", [&](const JsonPlace& primitive, std::size_t) {
        result.primitives.push_back(primitive_of(primitive));
    });
    return result;
}

tinygltf::Camera camera_of(const JsonPlace& camera) {
    const auto number = [](const JsonPlace& lens, std::string_view key) {
        return lens.has(key) ? lens.at(key).number() : 0.0;
    };
    tinygltf::Camera result;
    result.name = name_of(camera);
    result.type = camera.at("type").text();
    const JsonPlace lens = camera.at(result.type);
    if (result.type == "orthographic") {
        result.orthographic.ymag = number(lens, "ymag");
        result.orthographic.znear = number(lens, "znear");
        result.orthographic.zfar = number(lens, "zfar");
    } else {
        result.perspective.yfov = number(lens, "yfov");
        result.perspective.znear = number(lens, "znear");
        result.perspective.zfar = number(lens, "zfar");
    }
    return result;
}

/// `count` numbers of a checked list.
void read_numbers(const JsonPlace& list, int count, float* into) {
    for (int i = 0; i < count; ++i)
        into[i] = static_cast<float>(list.value().elements()[static_cast<std::size_t>(i)].number());
}

GltfNode node_of(const JsonPlace& node) {
    GltfNode result;
    result.name = name_of(node);
    result.mesh = index_or_none(node, "mesh");
    result.camera = index_or_none(node, "camera");
    result.skin = index_or_none(node, "skin");
    result.children = indices(node, "children");
    if (const auto matrix = node.find("matrix")) read_numbers(*matrix, 16, &result.matrix.emplace()[0][0]);
    if (const auto translation = node.find("translation")) read_numbers(*translation, 3, &result.translation.x);
    if (const auto scale = node.find("scale")) read_numbers(*scale, 3, &result.scale.x);
    if (const auto rotation = node.find("rotation")) {
        glm::vec4 xyzw;
        read_numbers(*rotation, 4, &xyzw.x);
        result.rotation = glm::quat(xyzw.w, xyzw.x, xyzw.y, xyzw.z);
    }
    result.has_extensions = node.has("extensions");
    result.has_extras = node.has("extras");
    return result;
}

tinygltf::Sampler sampler_of(const JsonPlace& sampler) {
    tinygltf::Sampler result;
    result.minFilter = index_or_none(sampler, "minFilter");
    result.magFilter = index_or_none(sampler, "magFilter");
    if (sampler.has("wrapS")) result.wrapS = whole(sampler.at("wrapS"));
    if (sampler.has("wrapT")) result.wrapT = whole(sampler.at("wrapT"));
    return result;
}

tinygltf::Texture texture_of(const JsonPlace& texture) {
    tinygltf::Texture result;
    result.sampler = index_or_none(texture, "sampler");
    result.source = index_or_none(texture, "source");
    return result;
}

tinygltf::Image image_of(const JsonPlace& image) {
    tinygltf::Image result;
    result.name = name_of(image);
    result.bufferView = index_or_none(image, "bufferView");
    return result;
}

tinygltf::Scene scene_of(const JsonPlace& scene) {
    tinygltf::Scene result;
    result.nodes = indices(scene, "nodes");
    return result;
}

template <typename T>
void read_all(const JsonPlace& root, std::string_view key, T (*read)(const JsonPlace&), std::vector<T>& into) {
    into.reserve(count_of(root, key));
    for_each_object(root, key, [&](const JsonPlace& element, std::size_t) { into.push_back(read(element)); });
}

void apply_variant(const GltfDocument& document, tinygltf::Model& model) {
    if (!document.chosen_variant) return;
    for_each_object(document.root(), "meshes", [&](const JsonPlace& mesh, std::size_t i) {
        for_each_object(mesh, "primitives", [&](const JsonPlace& primitive, std::size_t k) {
            if (const auto material = material_of_variant(primitive, *document.chosen_variant))
                model.meshes[i].primitives[k].material = static_cast<int>(*material);
        });
    });
}

struct Size {
    std::uint64_t width = 0;
    std::uint64_t height = 0;
};

std::uint64_t big_endian(const unsigned char* bytes, std::size_t count) {
    std::uint64_t result = 0;
    for (std::size_t i = 0; i < count; ++i) {
        result = (result << 8) | bytes[i];
    }
    return result;
}

/// The size a PNG or JPEG says it has, before anything is decoded. Nothing: neither of the two, or cut off.
std::optional<Size> size_in_header(const unsigned char* bytes, std::size_t count) {
    static constexpr std::array<unsigned char, 8> kPng{0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
    if (count >= 24 && std::equal(kPng.begin(), kPng.end(), bytes)) {
        return Size{big_endian(bytes + 16, 4), big_endian(bytes + 20, 4)};
    }
    if (count < 4 || bytes[0] != 0xFF || bytes[1] != 0xD8) {
        return std::nullopt;
    }
    // JPEG: segments of FF, marker, length; the frame header (C0 to CF but C4, C8, CC) has height and width.
    for (std::size_t at = 2; at + 9 < count;) {
        const unsigned char marker = bytes[at + 1];
        if (bytes[at] != 0xFF) {
            return std::nullopt;
        }
        if (marker == 0xFF) {  // fill byte
            ++at;
            continue;
        }
        if (marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC) {
            return Size{big_endian(bytes + at + 7, 2), big_endian(bytes + at + 5, 2)};
        }
        at += 2 + big_endian(bytes + at + 2, 2);
    }
    return std::nullopt;
}

void check_size(const JsonPlace& image, const Size& size, std::uint64_t& pixels_so_far) {
    if (size.width == 0 || size.height == 0) {
        image.fail("has no pixels");
    }
    const std::string advice = "make the image smaller";
    if (size.width > kLargestImageSide || size.height > kLargestImageSide ||
        size.width * size.height > kLargestImagePixels) {
        image.fail(fmt::format("has {} x {} pixels; at most {} a side and {} in all are read", size.width, size.height,
                               kLargestImageSide, kLargestImagePixels),
                   advice);
    }
    pixels_so_far += size.width * size.height;
    if (pixels_so_far > kMostImagePixels) {
        image.fail(fmt::format("all images up to here have over {} pixels", kMostImagePixels), advice);
    }
}

/// Decodes one image through tinygltf's stb_image; 16 bits a channel are cut to the upper 8.
DecodedImage decoded(const JsonPlace& place, std::string_view bytes, std::uint64_t& pixels_so_far) {
    const auto* start = reinterpret_cast<const unsigned char*>(bytes.data());
    const std::optional<Size> size = size_in_header(start, bytes.size());
    if (!size) {
        place.fail("is neither a PNG nor a JPEG", "convert it to PNG or JPEG");
    }
    check_size(place, *size, pixels_so_far);
    tinygltf::Image image;
    std::string message;
    if (!tinygltf::LoadImageData(&image, 0, &message, nullptr, 0, 0, start, static_cast<int>(bytes.size()), nullptr) ||
        image.component != 4 || image.width != static_cast<int>(size->width) ||
        image.height != static_cast<int>(size->height)) {
        std::replace(message.begin(), message.end(), '\n', ' ');
        place.fail(fmt::format("cannot be decoded ({})", message), "save the image again as PNG or JPEG");
    }
    DecodedImage result{.width = image.width, .height = image.height, .rgba = std::move(image.image)};
    if (image.bits == 16) {  // in place: the upper byte, samples are little-endian in memory
        for (std::size_t i = 0; 2 * i + 1 < result.rgba.size(); ++i) result.rgba[i] = result.rgba[2 * i + 1];
        result.rgba.resize(result.rgba.size() / 2);
        result.rgba.shrink_to_fit();
    }
    return result;
}

void decode_images(const GltfDocument& document, GltfResources& resources, const std::set<std::size_t>& used_images,
                   GltfModel& gltf) {
    gltf.images.resize(resources.images.size());
    std::uint64_t pixels = 0;
    for (const std::size_t at : used_images) {
        const JsonPlace place = document.root().at("images").at(at);
        const int view = gltf.model.images.at(at).bufferView;
        Bytes bytes = std::move(resources.images.at(at));
        if (view >= 0) {
            gltf.expect_data(static_cast<std::size_t>(view));
            const tinygltf::BufferView& range = gltf.model.bufferViews.at(static_cast<std::size_t>(view));
            bytes = gltf.buffers.at(static_cast<std::size_t>(range.buffer)).copy(range.byteOffset, range.byteLength);
        }
        gltf.images[at] = decoded(place, bytes, pixels);
    }
}

}  // namespace

void GltfModel::expect_data(std::size_t buffer_view) const {
    const auto buffer = static_cast<std::size_t>(model.bufferViews.at(buffer_view).buffer);
    if (buffers.at(buffer).empty()) {
        throw Error(Fault::input, fmt::format("{}: /buffers/{}: has no 'uri' and there is no binary chunk for it; {}",
                                              source.file, buffer, source.advice));
    }
}

void add_notice(std::vector<std::string>& notices, const std::string& sentence) {
    if (std::find(notices.begin(), notices.end(), sentence) == notices.end()) {
        notices.push_back(sentence);
    }
}

GltfModel parse_gltf_model(const GltfDocument& document, GltfResources resources,
                           const std::set<std::size_t>& used_images) {
    GltfModel result;
    result.source = document.source;
    result.buffers = std::move(resources.buffers);
    const JsonPlace root = document.root();
    tinygltf::Model& model = result.model;
    read_all(root, "bufferViews", &view_of, model.bufferViews);
    for (const auto& [view, buffer] : resources.unpacked_views) {
        model.bufferViews[view].buffer = static_cast<int>(buffer);
        model.bufferViews[view].byteOffset = 0;
    }
    read_all(root, "accessors", &accessor_of, model.accessors);
    read_all(root, "images", &image_of, model.images);
    read_all(root, "samplers", &sampler_of, model.samplers);
    read_all(root, "textures", &texture_of, model.textures);
    read_all(root, "meshes", &mesh_of, model.meshes);
    apply_variant(document, model);
    read_all(root, "cameras", &camera_of, model.cameras);
    read_all(root, "nodes", &node_of, result.nodes);
    read_all(root, "scenes", &scene_of, model.scenes);
    decode_images(document, resources, used_images, result);
    return result;
}

}  // namespace halfframe::content
