// The one place that calls tinygltf: a cleaned copy of the document in, its model and decoded images out.
#include "content/gltf_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <initializer_list>

#include <fmt/format.h>

#include "engine/error.h"

namespace halfframe::content {
namespace {

using nlohmann::json;

/// tinygltf wants 3 where JSON may say 3.0.
json with_whole_numbers(const json& value) {
    if (value.is_structured()) {
        json result = value;
        for (json& child : result) {
            child = with_whole_numbers(child);
        }
        return result;
    }
    if (value.is_number_float() && std::abs(value.get<double>()) < 1e9 &&
        std::trunc(value.get<double>()) == value.get<double>()) {
        return static_cast<std::int64_t>(value.get<double>());
    }
    return value;
}

/// Elements of root[key] with only the keys that were checked and are read.
json cleaned(const json& root, const char* key, std::initializer_list<const char*> kept) {
    json result = json::array();
    const auto found = root.find(key);
    if (found != root.end()) {
        for (const json& element : *found) {
            json copy = json::object();
            for (const char* name : kept) {
                const auto child = element.find(name);
                if (child != element.end()) {
                    copy[name] = with_whole_numbers(*child);
                }
            }
            const auto name = element.find("name");
            if (name != element.end() && name->is_string()) {
                copy["name"] = *name;
            }
            result.push_back(std::move(copy));
        }
    }
    return result;
}

/// Buffers under made-up names, for give_bytes(), and one more of a single byte with a view of it, for accessors
/// without a view: glTF says they are zero, tinygltf 2.7 refuses them. parse_gltf_model() takes that view off again.
void add_buffers(const json& root, const std::vector<bool>& buffer_has_data, json& result) {
    json buffers = cleaned(root, "buffers", {"byteLength"});
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        buffers[i]["uri"] = fmt::format("buffer{}", i);
        if (!buffer_has_data[i]) {
            buffers[i]["byteLength"] = 1;
        }
    }
    json views = cleaned(root, "bufferViews", {"buffer", "byteOffset", "byteLength", "byteStride"});
    views.push_back({{"buffer", buffers.size()}, {"byteLength", 1}});
    buffers.push_back({{"uri", fmt::format("buffer{}", buffers.size())}, {"byteLength", 1}});
    json accessors = cleaned(root, "accessors",
                             {"bufferView", "byteOffset", "componentType", "normalized", "count", "type", "sparse"});
    for (json& accessor : accessors) {
        if (!accessor.contains("bufferView")) {
            accessor["bufferView"] = views.size() - 1;
        }
    }
    result["buffers"] = std::move(buffers);
    result["bufferViews"] = std::move(views);
    result["accessors"] = std::move(accessors);
}

json cleaned_document(const json& root, const std::vector<bool>& buffer_has_data) {
    json result = {{"asset", {{"version", "2.0"}}}};
    add_buffers(root, buffer_has_data, result);
    result["images"] = cleaned(root, "images", {"bufferView", "mimeType"});
    for (std::size_t i = 0; i < result["images"].size(); ++i) {
        if (!result["images"][i].contains("bufferView")) {
            result["images"][i]["uri"] = fmt::format("image{}", i);
        }
    }
    result["samplers"] = cleaned(root, "samplers", {"magFilter", "minFilter", "wrapS", "wrapT"});
    result["textures"] = cleaned(root, "textures", {"sampler", "source"});
    result["materials"] = cleaned(root, "materials", {});  // read from the document, see gltf_materials.cpp
    result["meshes"] = cleaned(root, "meshes", {"primitives"});
    result["cameras"] = cleaned(root, "cameras", {"type", "perspective", "orthographic"});
    result["nodes"] =
        cleaned(root, "nodes", {"children", "mesh", "camera", "skin", "matrix", "translation", "rotation", "scale"});
    result["scenes"] = cleaned(root, "scenes", {"nodes"});
    return result;
}

/// Extensions and extras inside what was kept go too: tinygltf reads them recursively, and we read them ourselves.
void drop_extensions(json& value) {
    if (value.is_object()) {
        value.erase("extensions");
        value.erase("extras");
    }
    if (value.is_structured()) {
        for (json& child : value) {
            drop_extensions(child);
        }
    }
}

struct Callbacks {
    const GltfDocument* document = nullptr;
    const GltfModel* gltf = nullptr;
    GltfResources* resources = nullptr;
    const std::set<std::size_t>* used_images = nullptr;
    std::vector<DecodedImage> images;
    std::uint64_t pixels = 0;
};

/// "buffer7" or "image7" in what tinygltf made of it ("./buffer7"); nothing else is asked for.
std::string* bytes_named(GltfResources& resources, const std::string& path) {
    const std::size_t slash = path.rfind('/');
    const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
    const bool buffer = name.starts_with("buffer");
    std::vector<std::string>& list = buffer ? resources.buffers : resources.images;
    const auto index = static_cast<std::size_t>(std::stoul(name.substr(buffer ? 6 : 5)));
    return index < list.size() ? &list[index] : nullptr;
}

bool file_exists(const std::string& path, void* user) {
    return bytes_named(*static_cast<Callbacks*>(user)->resources, path) != nullptr;
}

std::string same_path(const std::string& path, void*) { return path; }

bool give_bytes(std::vector<unsigned char>* out, std::string*, const std::string& path, void* user) {
    std::string& bytes = *bytes_named(*static_cast<Callbacks*>(user)->resources, path);
    out->assign(bytes.begin(), bytes.end());
    std::string().swap(bytes);
    return true;
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

void check_size(Callbacks& callbacks, std::size_t index, const Size& size) {
    const JsonPlace place = callbacks.document->root().at("images").at(index);
    if (size.width == 0 || size.height == 0) {
        place.fail("has no pixels");
    }
    const std::string advice = "make the image smaller";
    if (size.width > kLargestImageSide || size.height > kLargestImageSide ||
        size.width * size.height > kLargestImagePixels) {
        place.fail(fmt::format("has {} x {} pixels; at most {} a side and {} in all are read", size.width, size.height,
                               kLargestImageSide, kLargestImagePixels),
                   advice);
    }
    callbacks.pixels += size.width * size.height;
    if (callbacks.pixels > kMostImagePixels) {
        place.fail(fmt::format("all images up to here have over {} pixels", kMostImagePixels), advice);
    }
}

/// Decodes one image through tinygltf's stb_image; 16 bits a channel are cut to the upper 8.
bool decode_image(tinygltf::Image* image, const int index, std::string*, std::string*, int, int,
                  const unsigned char* bytes, int count, void* user) {
    Callbacks& callbacks = *static_cast<Callbacks*>(user);
    const auto at = static_cast<std::size_t>(index);
    if (!callbacks.used_images->contains(at)) {
        return true;
    }
    const JsonPlace place = callbacks.document->root().at("images").at(at);
    if (image->bufferView >= 0) {
        callbacks.gltf->expect_data(static_cast<std::size_t>(image->bufferView));
    }
    const std::optional<Size> size = count > 0 ? size_in_header(bytes, static_cast<std::size_t>(count)) : std::nullopt;
    if (!size) {
        place.fail("is neither a PNG nor a JPEG", "convert it to PNG or JPEG");
    }
    check_size(callbacks, at, *size);
    tinygltf::Image decoded;
    std::string message;
    if (!tinygltf::LoadImageData(&decoded, index, &message, nullptr, 0, 0, bytes, count, nullptr) ||
        decoded.component != 4 || decoded.width != static_cast<int>(size->width) ||
        decoded.height != static_cast<int>(size->height)) {
        std::replace(message.begin(), message.end(), '\n', ' ');
        place.fail(fmt::format("cannot be decoded ({})", message), "save the image again as PNG or JPEG");
    }
    DecodedImage& result = callbacks.images[at];
    result.width = decoded.width;
    result.height = decoded.height;
    if (decoded.bits == 16) {
        result.rgba.resize(decoded.image.size() / 2);
        for (std::size_t i = 0; i < result.rgba.size(); ++i) {
            result.rgba[i] = decoded.image[2 * i + 1];  // the upper byte: samples are little-endian in memory
        }
    } else {
        result.rgba = std::move(decoded.image);
    }
    image->width = result.width;
    image->height = result.height;
    return true;
}

}  // namespace

void GltfModel::expect_data(std::size_t buffer_view) const {
    const auto buffer = static_cast<std::size_t>(model.bufferViews.at(buffer_view).buffer);
    if (!buffer_has_data.at(buffer)) {
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
    for (std::string& bytes : resources.buffers) {
        result.buffer_has_data.push_back(!bytes.empty());
        if (bytes.empty()) {
            bytes.resize(1);
        }
    }
    json cleaned_json = cleaned_document(document.json, result.buffer_has_data);
    drop_extensions(cleaned_json);
    const std::string text = cleaned_json.dump();
    cleaned_json = json();
    resources.buffers.emplace_back(1, '\0');
    Callbacks callbacks{&document, &result, &resources, &used_images, {}, 0};
    callbacks.images.resize(resources.images.size());
    tinygltf::TinyGLTF parser;
    parser.SetFsCallbacks({&file_exists, &same_path, &give_bytes, nullptr, &callbacks});
    parser.SetImageLoader(&decode_image, &callbacks);
    std::string error;
    std::string warning;
    bool done = false;
    try {
        done = parser.LoadASCIIFromString(&result.model, &error, &warning, text.data(),
                                          static_cast<unsigned int>(text.size()), ".");
    } catch (const Error&) {
        throw;  // ours, from decode_image
    } catch (const std::exception& exception) {
        error += exception.what();
    }
    if (!done) {
        std::replace(error.begin(), error.end(), '\n', ' ');
        throw Error(Fault::input, fmt::format("{}: tinygltf refused the file: {}; {}", document.source.file, error,
                                              document.source.advice));
    }
    result.images = std::move(callbacks.images);
    for (tinygltf::Accessor& accessor : result.model.accessors) {
        if (accessor.bufferView == static_cast<int>(result.model.bufferViews.size()) - 1) {
            accessor.bufferView = -1;
        }
    }
    return result;
}

}  // namespace halfframe::content
