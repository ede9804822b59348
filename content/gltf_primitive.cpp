// Accessors and primitives: bytes to vertex streams.
#include "content/gltf_model.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include <fmt/format.h>

#include "content/gltf_motion.h"
#include "content/mesh_tools.h"
#include "engine/error.h"

namespace halfframe::content {
namespace {

[[noreturn]] void fail(const GltfModel& gltf, const std::string& place, const std::string& what) {
    throw Error(Fault::input, fmt::format("{}: {}: {}; {}", gltf.source.file, place, what, gltf.source.advice));
}

/// Where a range of bytes lies.
struct Place {
    const GltfBuffer& buffer;
    std::size_t start;
};

Place place_of(const GltfModel& gltf, int view, std::size_t offset) {
    gltf.expect_data(static_cast<std::size_t>(view));
    const tinygltf::BufferView& buffer_view = gltf.model.bufferViews.at(static_cast<std::size_t>(view));
    return {gltf.buffers.at(static_cast<std::size_t>(buffer_view.buffer)), buffer_view.byteOffset + offset};
}

const unsigned char* unsigned_bytes(std::string_view bytes) {
    return reinterpret_cast<const unsigned char*>(bytes.data());
}

template <typename T>
T value_at(const unsigned char* bytes) {
    T result;
    std::memcpy(&result, bytes, sizeof result);  // no alignment is assumed
    return result;
}

/// Normalized integers: c / 255, max(c / 127, -1) and so on (glTF 2.0, section 3.11).
template <typename T>
float scaled(const unsigned char* bytes, bool normalized) {
    const auto value = static_cast<float>(value_at<T>(bytes));
    return normalized ? std::max(value / static_cast<float>(std::numeric_limits<T>::max()), -1.0f) : value;
}

float component_as_float(const unsigned char* bytes, int type, bool normalized) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE: return scaled<std::int8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return scaled<std::uint8_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_SHORT: return scaled<std::int16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return scaled<std::uint16_t>(bytes, normalized);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return static_cast<float>(value_at<std::uint32_t>(bytes));
        default: return value_at<float>(bytes);
    }
}

std::uint32_t component_as_index(const unsigned char* bytes, int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return value_at<std::uint8_t>(bytes);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT: return value_at<std::uint16_t>(bytes);
        default: return value_at<std::uint32_t>(bytes);
    }
}

/// Calls visit(element index, bytes of the element) for the base values, then for the sparse ones.
template <typename Visit>
void for_each_element(const GltfModel& gltf, int index, Visit&& visit) {
    const tinygltf::Accessor& accessor = gltf.model.accessors.at(static_cast<std::size_t>(index));
    const auto component =
        static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)));
    const std::size_t tight =
        component *
        static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
    if (accessor.bufferView >= 0) {
        const std::size_t given = gltf.model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView)).byteStride;
        const std::size_t stride = given == 0 ? tight : given;
        const Place place = place_of(gltf, accessor.bufferView, accessor.byteOffset);
        const unsigned char* bytes =
            unsigned_bytes(place.buffer.part(place.start, stride * (accessor.count - 1) + tight));
        for (std::size_t i = 0; i < accessor.count; ++i) visit(i, bytes + i * stride);
    }
    if (accessor.sparse.isSparse) {
        const auto& sparse = accessor.sparse;
        const auto index_bytes = static_cast<std::size_t>(
            tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(sparse.indices.componentType)));
        const auto count = static_cast<std::size_t>(sparse.count);
        const auto copy_of = [&](int view, int offset, std::size_t size) {
            const Place place = place_of(gltf, view, static_cast<std::size_t>(offset));
            return place.buffer.copy(place.start, size);
        };
        const Bytes index_copy = copy_of(sparse.indices.bufferView, sparse.indices.byteOffset, count * index_bytes);
        const Bytes value_copy = copy_of(sparse.values.bufferView, sparse.values.byteOffset, count * tight);
        const unsigned char *indices = unsigned_bytes(index_copy), *values = unsigned_bytes(value_copy);
        for (std::size_t i = 0; i < count; ++i) {
            const std::uint32_t element = component_as_index(indices + i * index_bytes, sparse.indices.componentType);
            if (element >= accessor.count) {
                fail(gltf, fmt::format("/accessors/{}/sparse/indices", index),
                     fmt::format("names element {} of {}", element, accessor.count));
            }
            visit(element, values + i * tight);
        }
    }
}

/// Refuses what read_elements() refuses, of elements that nobody asks for.
void expect_readable(const GltfModel& gltf, int index) {
    const tinygltf::Accessor& accessor = gltf.model.accessors.at(static_cast<std::size_t>(index));
    if (accessor.bufferView >= 0) gltf.expect_data(static_cast<std::size_t>(accessor.bufferView));
    if (accessor.sparse.isSparse) for_each_element(gltf, index, [](std::size_t, const unsigned char*) {});
}

/// The elements of a buffer that lie one after the other as Source, converted one by one: the common case, in which
/// nothing has to be written before it is read. Nothing: they do not lie so.
template <typename Source, typename T>
std::optional<std::vector<T>> plain_elements(const GltfModel& gltf, const tinygltf::Accessor& accessor) {
    if (accessor.sparse.isSparse || accessor.bufferView < 0) return std::nullopt;
    const std::size_t stride = gltf.model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView)).byteStride;
    if (stride != 0 && stride != sizeof(Source)) return std::nullopt;
    const Place place = place_of(gltf, accessor.bufferView, accessor.byteOffset);
    std::vector<T> result;
    result.reserve(accessor.count);
    if constexpr (std::is_same_v<Source, T>) {
        constexpr std::size_t kPart = (128u << 10) / sizeof(T);  // the zeros of a part are in the cache when it is read
        while (result.size() < accessor.count) {
            const std::size_t done = result.size();
            result.resize(std::min(done + kPart, accessor.count));
            const std::span<T> part = std::span(result).subspan(done);
            place.buffer.read(place.start + done * sizeof(T), part.size_bytes(), reinterpret_cast<char*>(part.data()));
        }
        return result;
    }
    bool is_aligned = true;
    place.buffer.for_each_piece(
        place.start, accessor.count * sizeof(Source), sizeof(Source), [&](std::string_view piece) {
            is_aligned = is_aligned && reinterpret_cast<std::uintptr_t>(piece.data()) % alignof(Source) == 0;
            if (!is_aligned) return;
            const auto* first = reinterpret_cast<const Source*>(piece.data());
            result.insert(result.end(), first, first + piece.size() / sizeof(Source));
        });
    return is_aligned ? std::optional(std::move(result)) : std::nullopt;
}

template <typename T>
bool is_finite(const T& vector) {
    for (int i = 0; i < T::length(); ++i) {
        if (!std::isfinite(vector[i])) {
            return false;
        }
    }
    return true;
}

/// As read_elements, and every value must be finite.
template <typename T>
std::vector<T> read_finite(const GltfModel& gltf, const std::string& place, int accessor) {
    std::vector<T> result = read_elements<T>(gltf, accessor);
    const bool is_right = result.empty() || all_finite({&result[0][0], result.size() * T::length()});
    for (std::size_t i = 0; !is_right && i < result.size(); ++i) {
        if (!is_finite(result[i])) {
            fail(gltf, place, fmt::format("element {} of accessor {} is infinite or not a number", i, accessor));
        }
    }
    return result;
}

Primitive primitive_of(int mode) {
    switch (mode) {
        case TINYGLTF_MODE_POINTS: return Primitive::points;
        case TINYGLTF_MODE_LINE: return Primitive::lines;
        case TINYGLTF_MODE_LINE_LOOP: return Primitive::line_loop;
        case TINYGLTF_MODE_LINE_STRIP: return Primitive::line_strip;
        case TINYGLTF_MODE_TRIANGLE_STRIP: return Primitive::triangle_strip;
        case TINYGLTF_MODE_TRIANGLE_FAN: return Primitive::triangle_fan;
        default: return Primitive::triangles;
    }
}

/// Fewest vertices that draw something, and the multiple that complete ones come in.
struct Complete {
    std::size_t fewest;
    std::size_t multiple;
};

Complete complete_of(Primitive primitive) {
    switch (primitive) {
        case Primitive::points: return {1, 1};
        case Primitive::lines: return {2, 2};
        case Primitive::line_loop:
        case Primitive::line_strip: return {2, 1};
        case Primitive::triangles: return {3, 3};
        default: return {3, 1};
    }
}

int attribute(const tinygltf::Primitive& primitive, const std::string& name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? -1 : found->second;
}

/// Counts what a primitive asks for before a byte of it is read.
void count_against_caps(const GltfModel& gltf, const tinygltf::Primitive& primitive, const std::string& place,
                        ReadSoFar& so_far) {
    const auto count = [&](int accessor) { return gltf.model.accessors.at(static_cast<std::size_t>(accessor)).count; };
    const std::size_t indices = primitive.indices >= 0 ? count(primitive.indices) : 0;
    const bool gets_own_vertices = attribute(primitive, "NORMAL") < 0;  // flat_shaded()
    const std::size_t vertices = count(attribute(primitive, "POSITION"));
    // Strips and fans become three vertices for each one when they are flat shaded.
    const std::size_t drawn = indices > 0 ? indices : vertices;
    const bool triangles = primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode < 0;
    so_far.vertices += gets_own_vertices ? std::max(vertices, triangles ? drawn : 3 * drawn) : vertices;
    so_far.indices += indices;
    if (so_far.vertices > kMostVertices || so_far.indices > kMostIndices) {
        fail(gltf, place,
             fmt::format("all primitives up to here have over {} vertices or {} indices", kMostVertices, kMostIndices));
    }
}

void read_streams(const GltfModel& gltf, const tinygltf::Primitive& primitive, const std::string& place,
                  const MaterialUv& needs, Mesh& mesh, std::vector<std::string>& notices) {
    mesh.positions = read_finite<glm::vec3>(gltf, place + "/attributes/POSITION", attribute(primitive, "POSITION"));
    if (const int normals = attribute(primitive, "NORMAL"); normals >= 0) {
        mesh.normals = read_elements<glm::vec3>(gltf, normals);
    }
    if (const int tangents = attribute(primitive, "TANGENT"); tangents >= 0 && !mesh.normals.empty()) {
        if (needs.of_normal_map) mesh.tangents = read_elements<glm::vec4>(gltf, tangents);
        else expect_readable(gltf, tangents);
    }
    for (std::size_t set = 0; set < needs.reads.size(); ++set) {
        const std::string uv_name = fmt::format("TEXCOORD_{}", set);
        std::vector<glm::vec2>& stream = set == 0 ? mesh.uv : mesh.uv1;
        const int uv = attribute(primitive, uv_name);
        if (uv >= 0 && (set == 0 || needs.reads[set])) {
            stream = read_finite<glm::vec2>(gltf, place + "/attributes/" + uv_name, uv);
        } else if (needs.reads[set]) {
            add_notice(notices, fmt::format("{} has no {}, which its material asks for: its textures show one texel.",
                                            place, uv_name));
            if (set > 0) stream.assign(mesh.positions.size(), glm::vec2(0.0f));
        }
    }
    if (const int colors = attribute(primitive, "COLOR_0"); colors >= 0) {
        mesh.colors = read_finite<glm::vec4>(gltf, place + "/attributes/COLOR_0", colors);
        for (glm::vec4& color : mesh.colors) {
            color = glm::clamp(color, 0.0f, 1.0f);
        }
    }
}

void read_checked_indices(const GltfModel& gltf, const tinygltf::Primitive& primitive, const std::string& place,
                          Mesh& mesh) {
    if (primitive.indices >= 0) {
        mesh.indices = read_indices(gltf, primitive.indices);
        const bool is_right = all_below(mesh.indices, mesh.positions.size());
        for (std::size_t i = 0; !is_right && i < mesh.indices.size(); ++i) {
            if (mesh.indices[i] >= mesh.positions.size()) {
                fail(gltf, place + "/indices",
                     fmt::format("index {} of accessor {} is {} but there are {} vertices", i, primitive.indices,
                                 mesh.indices[i], mesh.positions.size()));
            }
        }
    }
}

/// Leaves out what does not make a whole line or triangle. False: nothing is left.
bool keep_complete(Mesh& mesh, const std::string& place, std::vector<std::string>& notices) {
    const Complete complete = complete_of(mesh.primitive);
    const std::size_t count = drawn_vertices(mesh);
    if (count < complete.fewest) {
        add_notice(notices, fmt::format("{} has too few vertices to draw anything.", place));
        return false;
    }
    const std::size_t rest = count % complete.multiple;
    if (rest != 0) {
        add_notice(notices,
                   fmt::format("The last {} vertices of {} make no whole primitive and were left out.", rest, place));
        if (mesh.indices.empty()) {
            for (std::size_t i = 0; i < count - rest; ++i) {
                mesh.indices.push_back(static_cast<std::uint32_t>(i));
            }
        } else {
            mesh.indices.resize(count - rest);
        }
    }
    return true;
}

void complete_streams(Mesh& mesh, const std::string& place, const std::optional<UvMapping>& normal_map,
                      std::vector<std::string>& notices) {
    if (mesh.normals.empty() && has_faces(mesh.primitive)) {
        mesh = flat_shaded(mesh);
    } else if (const std::size_t bad = repair_normals(mesh); bad > 0) {
        add_notice(notices,
                   fmt::format("{} normals of {} were zero or not finite and were replaced by those of their faces.",
                               bad, place));
    }
    if (!mesh.tangents.empty()) {
        repair_tangents(mesh);
    } else if (normal_map && !mesh.normals.empty()) {
        const std::vector<glm::vec2> uv = mapped(normal_map->set == 0 ? mesh.uv : mesh.uv1, *normal_map);
        if (!uv.empty()) {
            add_tangents(mesh, uv);
        }
    }
}

}  // namespace

template <typename T>
std::vector<T> read_elements(const GltfModel& gltf, int index) {
    const tinygltf::Accessor& accessor = gltf.model.accessors.at(static_cast<std::size_t>(index));
    const auto bytes_each =
        static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)));
    const int given = tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
    if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT && given == T::length()) {
        if (auto plain = plain_elements<T, T>(gltf, accessor)) return *std::move(plain);
    }
    const bool starts_at_zero = accessor.bufferView < 0;  // glTF 2.0: without a view, all zeros before sparse values
    std::vector<T> result(accessor.count, T(1.0f));
    if (starts_at_zero) {
        T zero(1.0f);
        for (int i = 0; i < std::min(given, static_cast<int>(T::length())); ++i) zero[i] = 0.0f;
        std::fill(result.begin(), result.end(), zero);
    }
    for_each_element(gltf, index, [&](std::size_t element, const unsigned char* bytes) {
        for (int i = 0; i < std::min(given, static_cast<int>(T::length())); ++i) {
            result[element][i] = component_as_float(bytes + static_cast<std::size_t>(i) * bytes_each,
                                                    accessor.componentType, accessor.normalized);
        }
    });
    return result;
}

template std::vector<glm::vec2> read_elements<glm::vec2>(const GltfModel&, int);
template std::vector<glm::vec3> read_elements<glm::vec3>(const GltfModel&, int);
template std::vector<glm::vec4> read_elements<glm::vec4>(const GltfModel&, int);

std::vector<std::uint32_t> read_indices(const GltfModel& gltf, int index) {
    const tinygltf::Accessor& accessor = gltf.model.accessors.at(static_cast<std::size_t>(index));
    std::optional<std::vector<std::uint32_t>> plain;
    switch (accessor.componentType) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            plain = plain_elements<std::uint8_t, std::uint32_t>(gltf, accessor);
            break;
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            plain = plain_elements<std::uint16_t, std::uint32_t>(gltf, accessor);
            break;
        default: plain = plain_elements<std::uint32_t, std::uint32_t>(gltf, accessor); break;
    }
    if (plain) return *std::move(plain);
    std::vector<std::uint32_t> result(accessor.count, 0);
    for_each_element(gltf, index, [&](std::size_t element, const unsigned char* bytes) {
        result[element] = component_as_index(bytes, accessor.componentType);
    });
    return result;
}

bool all_finite(std::span<const float> values) {
    // One more than an exponent of ones, which is infinite or no number, sets the highest bit: nothing to branch on, so
    // that four go at a time.
    constexpr std::uint32_t kExponent = 0x7F800000, kOne = 0x00800000, kHighest = 0x80000000;
    std::uint32_t bits = 0;
    for (const float value : values) bits |= (std::bit_cast<std::uint32_t>(value) & kExponent) + kOne;
    return (bits & kHighest) == 0;
}

bool all_below(std::span<const std::uint32_t> indices, std::size_t count) {
    // The same bit is set in what is past half of the range, and in what goes below zero when taken from the last.
    constexpr std::uint32_t kHighest = 0x80000000;
    const std::uint32_t last = static_cast<std::uint32_t>(count) - 1;
    std::uint32_t bits = 0;
    for (const std::uint32_t index : indices) bits |= index | (last - index);
    return (bits & kHighest) == 0;
}

std::vector<float> read_floats(const GltfModel& gltf, int index) {
    const tinygltf::Accessor& accessor = gltf.model.accessors.at(static_cast<std::size_t>(index));
    const auto bytes_each =
        static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType)));
    const auto components =
        static_cast<std::size_t>(tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type)));
    std::vector<float> result(accessor.count * components, 0.0f);
    for_each_element(gltf, index, [&](std::size_t element, const unsigned char* bytes) {
        for (std::size_t i = 0; i < components; ++i)
            result[element * components + i] =
                component_as_float(bytes + i * bytes_each, accessor.componentType, accessor.normalized);
    });
    return result;
}

std::optional<Mesh> read_primitive(const GltfModel& gltf, std::size_t mesh_index, std::size_t primitive_index,
                                   const MaterialUv& needs, ReadSoFar& so_far, std::vector<std::string>& notices) {
    const tinygltf::Mesh& source = gltf.model.meshes.at(mesh_index);
    const tinygltf::Primitive& primitive = source.primitives.at(primitive_index);
    const std::string place = fmt::format("/meshes/{}/primitives/{}", mesh_index, primitive_index);
    if (attribute(primitive, "POSITION") < 0) {
        add_notice(notices, fmt::format("{} has no POSITION and was left out.", place));
        return std::nullopt;
    }
    count_against_caps(gltf, primitive, place, so_far);
    Mesh mesh;
    mesh.name = source.name.empty() ? fmt::format("mesh {}", mesh_index) : source.name;
    mesh.primitive = primitive_of(primitive.mode);
    read_streams(gltf, primitive, place, needs, mesh, notices);
    read_moving_streams(gltf, primitive, place, mesh, so_far, notices);
    read_checked_indices(gltf, primitive, place, mesh);
    if (!keep_complete(mesh, place, notices)) {
        return std::nullopt;
    }
    complete_streams(mesh, place, needs.of_normal_map, notices);
    return mesh;
}

}  // namespace halfframe::content
