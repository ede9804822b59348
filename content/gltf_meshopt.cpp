// EXT_meshopt_compression: buffer views that hold a compressed stream. The decoder is meshoptimizer's (A. Kapoulkine).
#include <algorithm>
#include <cstring>
#include <vector>

#include <fmt/format.h>
#include <meshoptimizer.h>

#include "content/gltf_extensions.h"

namespace halfframe::content {
namespace {

constexpr std::uint64_t kLargestOffset = 1ull << 53;

struct Stream {
    std::size_t buffer = 0;
    std::size_t offset = 0;
    std::size_t bytes = 0;
    std::size_t stride = 0;
    std::size_t count = 0;
    std::string mode;
    std::string filter;
};

Stream stream_of(const JsonPlace& place) {
    return {.buffer = static_cast<std::size_t>(place.at("buffer").whole()),
            .offset =
                place.has("byteOffset") ? static_cast<std::size_t>(place.at("byteOffset").whole(0, kLargestOffset)) : 0,
            .bytes = static_cast<std::size_t>(place.at("byteLength").whole(1, kLargestOffset)),
            .stride = static_cast<std::size_t>(place.at("byteStride").whole(1, 256)),
            .count = static_cast<std::size_t>(place.at("count").whole(1, kMostIndices)),
            .mode = place.at("mode").text(),
            .filter = place.has("filter") ? place.at("filter").text() : "NONE"};
}

/// What the extension demands of mode, filter, stride and count; the decoder relies on it.
void check_shape(const JsonPlace& place, const Stream& stream) {
    const bool attributes = stream.mode == "ATTRIBUTES";
    if (!attributes && stream.mode != "TRIANGLES" && stream.mode != "INDICES") {
        place.at("mode").fail(fmt::format("'{}' is not ATTRIBUTES, TRIANGLES or INDICES", stream.mode));
    }
    if (attributes ? stream.stride % 4 != 0 : stream.stride != 2 && stream.stride != 4) {
        place.at("byteStride").fail(fmt::format("is {}, which {} does not allow", stream.stride, stream.mode));
    }
    if (stream.mode == "TRIANGLES" && stream.count % 3 != 0) {
        place.at("count").fail(fmt::format("is {}, not a multiple of 3", stream.count));
    }
    const bool octahedral = stream.filter == "OCTAHEDRAL";
    const bool quaternion = stream.filter == "QUATERNION";
    if (!octahedral && !quaternion && stream.filter != "EXPONENTIAL" && stream.filter != "NONE") {
        place.at("filter").fail(fmt::format("'{}' is not NONE, OCTAHEDRAL, QUATERNION or EXPONENTIAL", stream.filter));
    }
    if ((octahedral && stream.stride != 4 && stream.stride != 8) || (quaternion && stream.stride != 8) ||
        (!attributes && stream.filter != "NONE")) {
        place.at("filter").fail(
            fmt::format("{} does not go with a byteStride of {} in {}", stream.filter, stream.stride, stream.mode));
    }
}

int decode(const Stream& stream, const unsigned char* bytes, Bytes& out) {
    if (stream.mode == "TRIANGLES")
        return meshopt_decodeIndexBuffer(out.data(), stream.count, stream.stride, bytes, stream.bytes);
    if (stream.mode == "INDICES")
        return meshopt_decodeIndexSequence(out.data(), stream.count, stream.stride, bytes, stream.bytes);
    return meshopt_decodeVertexBuffer(out.data(), stream.count, stream.stride, bytes, stream.bytes);
}

void unfilter(const Stream& stream, Bytes& out) {
    if (stream.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), stream.count, stream.stride);
    if (stream.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), stream.count, stream.stride);
    if (stream.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), stream.count, stream.stride);
}

}  // namespace

std::optional<JsonPlace> meshopt_of(const JsonPlace& buffer_view) {
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        if (auto found = extension(buffer_view, name)) return found;
    }
    return std::nullopt;
}

void check_meshopt(const JsonPlace& root) {
    std::uint64_t total = 0;
    for_each_object(root, "bufferViews", [&](const JsonPlace& view, std::size_t) {
        const auto place = meshopt_of(view);
        if (!place) return;
        (void)place->at("buffer");
        const std::size_t buffer = *index_in(*place, "buffer", count_of(root, "buffers"), "buffers");
        const Stream stream = stream_of(*place);
        const std::uint64_t available = root.at("buffers").at(buffer).at("byteLength").whole();
        if (stream.offset + stream.bytes > available) {
            place->fail(fmt::format("ends at byte {} of buffer {}, which has {}", stream.offset + stream.bytes, buffer,
                                    available));
        }
        check_shape(*place, stream);
        if (stream.stride * stream.count != view.at("byteLength").whole()) {
            place->fail(fmt::format("makes {} bytes but the view has {}", stream.stride * stream.count,
                                    view.at("byteLength").whole()));
        }
        total += stream.stride * stream.count;
        if (total > kMostBufferBytes) {
            place->fail(fmt::format("all compressed views up to here make over {} bytes", kMostBufferBytes),
                        "split the asset");
        }
    });
}

void decode_meshopt(const GltfDocument& document, GltfResources& resources) {
    const std::size_t views = count_of(document.root(), "bufferViews");
    for (std::size_t i = 0; i < views; ++i) {
        const JsonPlace view = document.root().at("bufferViews").at(i);
        const auto place = meshopt_of(view);
        if (!place) continue;
        const Stream stream = stream_of(*place);
        const GltfBuffer& source = resources.buffers.at(stream.buffer);
        if (source.size() < stream.offset + stream.bytes) {
            place->at("buffer").fail(fmt::format("buffer {} has no data", stream.buffer));
        }
        Bytes decoded(stream.stride * stream.count);
        const auto* bytes = reinterpret_cast<const unsigned char*>(source.part(stream.offset, stream.bytes).data());
        if (decode(stream, bytes, decoded) != 0) {
            place->fail("holds a stream that is damaged or of a newer kind", "compress the file again");
        }
        unfilter(stream, decoded);
        resources.unpacked_views.push_back({i, resources.buffers.size()});
        resources.buffers.emplace_back(std::move(decoded));
    }
}

}  // namespace halfframe::content
