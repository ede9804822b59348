// Packs meshes, fits images to the device, and uploads both.
#include "engine/frame/uploads.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <unordered_map>

#include <fmt/format.h>

#include "engine/error.h"

namespace halfframe {

namespace {

template <typename Value>
void write(std::byte* to, const Value& value) {
    std::memcpy(to, &value, sizeof(value));
}

void write_direction(std::byte* to, StreamFormat format, const glm::vec3& normal) {
    if (format == StreamFormat::bits16) write(to, octahedral16(normal));
    else write(to, glm::vec2(octahedral(normal)));
}

void write_tangent(std::byte* to, StreamFormat format, const glm::vec4& tangent) {
    if (format == StreamFormat::bits16) write(to, octahedral16_tangent(tangent));
    else write(to, glm::vec2(octahedral_tangent(tangent)));
}

void write_uv(std::byte* to, StreamFormat format, const glm::vec2& uv, const glm::vec4& range) {
    if (format == StreamFormat::bits16) write(to, uv16(uv, range));
    else write(to, uv);
}

void write_color(std::byte* to, StreamFormat format, const glm::vec4& color) {
    const glm::vec4 bounded = glm::clamp(color, 0.0f, 1.0f);
    if (format == StreamFormat::bits8) write(to, glm::u8vec4(glm::round(bounded * 255.0f)));
    else if (format == StreamFormat::bits16) write(to, glm::u16vec4(glm::round(bounded * 65535.0f)));
    else write(to, color);
}

/// Appends vertices of one mesh to pieces.
class VertexWriter {
public:
    VertexWriter(const Mesh& mesh, const MeshStorage& storage)
        : mesh_(mesh), storage_(storage), layout_(vertex_layout(storage)) {}

    void append(MeshPiece& piece, std::size_t vertex) const {
        const std::size_t begin = piece.vertices.size();
        piece.vertices.resize(begin + static_cast<std::size_t>(layout_.stride));
        ++piece.vertex_count;
        for (int i = 0; i < layout_.count; ++i) {
            const VertexStream& stream = layout_.streams[static_cast<std::size_t>(i)];
            write_stream(piece.vertices.data() + begin + stream.offset, stream.attribute, vertex);
        }
    }

private:
    void write_stream(std::byte* to, VertexAttribute attribute, std::size_t i) const {
        switch (attribute) {
            case kPosition:
                if (storage_.positions == StreamFormat::bits16)
                    write(to, position16(mesh_.positions[i], storage_.position_box));
                else write(to, mesh_.positions[i]);
                return;
            case kNormal: return write_direction(to, storage_.normals, mesh_.normals[i]);
            case kTangent: return write_tangent(to, storage_.tangents, mesh_.tangents[i]);
            case kUv: return write_uv(to, storage_.uv, mesh_.uv[i], storage_.uv_range);
            case kUv1: return write_uv(to, storage_.uv1, mesh_.uv1[i], storage_.uv1_range);
            case kColor: return write_color(to, storage_.colors, mesh_.colors[i]);
            case kJoints:
            case kWeights: break;
        }
        throw Mistake("a stream that no interleaved vertex has");
    }

    const Mesh& mesh_;
    const MeshStorage& storage_;
    VertexLayout layout_;
};

/// Indices of the same picture as a list of points, lines or triangles.
struct PrimitiveList {
    Primitive primitive;
    int corners;  ///< indices of one primitive
    std::vector<std::uint32_t> indices;
};

PrimitiveList as_list(Primitive primitive, const std::vector<std::uint32_t>& in) {
    PrimitiveList list{Primitive::triangles, 3, {}};
    const std::size_t count = in.size();
    switch (primitive) {
        case Primitive::points: return {Primitive::points, 1, in};
        case Primitive::lines: return {Primitive::lines, 2, in};
        case Primitive::triangles: return {Primitive::triangles, 3, in};
        case Primitive::line_strip:
        case Primitive::line_loop:
            list = {Primitive::lines, 2, {}};
            for (std::size_t i = 0; i + 1 < count; ++i) list.indices.insert(list.indices.end(), {in[i], in[i + 1]});
            if (primitive == Primitive::line_loop && count > 2)
                list.indices.insert(list.indices.end(), {in.back(), in.front()});
            return list;
        case Primitive::triangle_strip:
            for (std::size_t i = 0; i + 2 < count; ++i) {
                const bool odd = i % 2 == 1;
                list.indices.insert(list.indices.end(), {in[i + (odd ? 1 : 0)], in[i + (odd ? 0 : 1)], in[i + 2]});
            }
            return list;
        case Primitive::triangle_fan:
            for (std::size_t i = 1; i + 1 < count; ++i)
                list.indices.insert(list.indices.end(), {in[0], in[i], in[i + 1]});
            return list;
    }
    throw Mistake("a primitive that no list can stand for");
}

std::uint32_t gl_mode(Primitive primitive) {
    constexpr std::array<std::uint32_t, 7> kModes = {GL_POINTS,    GL_LINES,          GL_LINE_LOOP,   GL_LINE_STRIP,
                                                     GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_TRIANGLE_FAN};
    return kModes[static_cast<std::size_t>(primitive)];
}

DrawPart upload_piece(gl::EntryPoints& gl, const gl::Caps& caps, const MeshPiece& piece, const VertexLayout& layout) {
    DrawPart part;
    if (caps.vertex_array_objects || caps.core_profile) {
        part.array = gl::create<gl::Kind::vertex_array>(gl);
        gl.BindVertexArray(part.array.name());
    }
    part.vertices = gl::create<gl::Kind::buffer>(gl);
    gl.BindBuffer(GL_ARRAY_BUFFER, part.vertices.name());
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(piece.vertices.size()), piece.vertices.data(),
                  GL_STATIC_DRAW);
    part.count = static_cast<int>(piece.vertex_count);
    part.vertex_count = part.count;
    part.sources = piece.sources;
    if (!piece.indices.empty()) {
        part.indices = gl::create<gl::Kind::buffer>(gl);
        part.count = static_cast<int>(piece.indices.size());
        gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, part.indices.name());
        if (piece.vertex_count <= 65536) {
            const std::vector<std::uint16_t> narrow(piece.indices.begin(), piece.indices.end());
            part.index_type = GL_UNSIGNED_SHORT;
            gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(narrow.size() * 2), narrow.data(),
                          GL_STATIC_DRAW);
        } else {
            part.index_type = GL_UNSIGNED_INT;
            gl.BufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(piece.indices.size() * 4),
                          piece.indices.data(), GL_STATIC_DRAW);
        }
    }
    part.triangles = triangles_in(piece.primitive, part.count);
    if (part.array) {
        set_vertex_layout(gl, layout);
        for (int i = 0; i < layout.count; ++i)
            gl.EnableVertexAttribArray(static_cast<GLuint>(layout.streams[static_cast<std::size_t>(i)].attribute));
        gl.BindVertexArray(0);
    }
    return part;
}

/// Positions of its vertices as they are stored: they stand first.
std::vector<glm::vec3> positions_of(const MeshPiece& piece, const VertexLayout& layout) {
    const bool is_whole = layout.streams[0].type == GL_UNSIGNED_SHORT;
    std::vector<glm::vec3> positions(piece.vertex_count);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const std::byte* from = piece.vertices.data() + i * static_cast<std::size_t>(layout.stride);
        glm::u16vec3 steps;
        std::memcpy(&steps, from, sizeof(steps));
        std::memcpy(&positions[i], from, sizeof(positions[i]));
        if (is_whole) positions[i] = glm::vec3(steps);
    }
    return positions;
}

}  // namespace

VertexLayout vertex_layout(const MeshStorage& storage) {
    VertexLayout layout;
    const auto add = [&](VertexAttribute attribute, int components, StreamFormat format, std::uint32_t type16,
                         bool normalized) {
        if (format == StreamFormat::absent) return;
        VertexStream stream{
            .attribute = attribute, .type = GL_FLOAT, .components = components, .offset = layout.stride};
        int component_bytes = 4;
        if (format != StreamFormat::float32) {
            stream.type = format == StreamFormat::bits8 ? GL_UNSIGNED_BYTE : type16;
            stream.normalized = normalized;
            component_bytes = format == StreamFormat::bits8 ? 1 : 2;
        }
        layout.streams[static_cast<std::size_t>(layout.count++)] = stream;
        layout.stride += (components * component_bytes + 3) / 4 * 4;  // ES wants no more, and drivers like 4
    };
    // Positions and UVs come as whole numbers: their scale is folded in on the CPU, in double.
    add(kPosition, 3, storage.positions, GL_UNSIGNED_SHORT, false);
    // Normalised: c / 32767 in ES 3.0. ES 2.0 takes (2c + 1) / 65535, half a step off: 0.001 degrees.
    add(kNormal, 2, storage.normals, GL_SHORT, true);
    add(kTangent, 2, storage.tangents, GL_SHORT, true);
    add(kUv, 2, storage.uv, GL_UNSIGNED_SHORT, false);
    add(kUv1, 2, storage.uv1, GL_UNSIGNED_SHORT, false);
    add(kColor, 4, storage.colors, GL_UNSIGNED_SHORT, true);
    return layout;
}

std::vector<MeshPiece> packed_pieces(const Mesh& mesh, const MeshStorage& storage, std::size_t max_vertices) {
    const VertexWriter writer(mesh, storage);
    std::vector<MeshPiece> pieces;
    if (mesh.positions.size() <= max_vertices) {
        MeshPiece whole{.primitive = mesh.primitive, .indices = mesh.indices};
        whole.vertices.reserve(mesh.positions.size() * static_cast<std::size_t>(vertex_layout(storage).stride));
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) writer.append(whole, i);
        pieces.push_back(std::move(whole));
        return pieces;
    }
    std::vector<std::uint32_t> order = mesh.indices;
    if (order.empty()) {
        order.resize(mesh.positions.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
    }
    const PrimitiveList list = as_list(mesh.primitive, order);
    std::unordered_map<std::uint32_t, std::uint32_t> local;
    for (std::size_t i = 0; i + list.corners <= list.indices.size(); i += list.corners) {
        if (pieces.empty() || pieces.back().vertex_count + list.corners > max_vertices) {
            pieces.push_back({.primitive = list.primitive});
            local.clear();
        }
        MeshPiece& piece = pieces.back();
        for (int corner = 0; corner < list.corners; ++corner) {
            const std::uint32_t index = list.indices[i + corner];
            const auto [found, added] = local.try_emplace(index, static_cast<std::uint32_t>(piece.vertex_count));
            if (added) writer.append(piece, index);
            if (added) piece.sources.push_back(index);
            piece.indices.push_back(found->second);
        }
    }
    return pieces;
}

void set_vertex_layout(gl::EntryPoints& gl, const VertexLayout& layout) {
    for (int i = 0; i < layout.count; ++i) {
        const VertexStream& stream = layout.streams[static_cast<std::size_t>(i)];
        const auto attribute = static_cast<GLuint>(stream.attribute);
        gl.VertexAttribPointer(attribute, stream.components, stream.type, stream.normalized ? GL_TRUE : GL_FALSE,
                               layout.stride, reinterpret_cast<const void*>(static_cast<std::size_t>(stream.offset)));
    }
}

int triangles_in(Primitive primitive, int count) {
    switch (primitive) {
        case Primitive::points:
        case Primitive::lines:
        case Primitive::line_loop:
        case Primitive::line_strip: return 0;
        case Primitive::triangles: return count / 3;
        case Primitive::triangle_strip:
        case Primitive::triangle_fan: return std::max(count - 2, 0);
    }
    throw Mistake("a primitive whose triangles nobody has counted");
}

std::int64_t DrawMesh::triangles() const {
    std::int64_t sum = 0;
    for (const DrawPart& part : parts) sum += part.triangles;
    return sum;
}

DrawMesh upload_mesh(gl::EntryPoints& gl, const gl::Caps& caps, const Mesh& mesh, const MeshStorage& storage,
                     bool orders) {
    DrawMesh draw;
    draw.box = local_box(mesh);
    draw.storage = storage;
    draw.stored = stored_positions(storage);
    draw.direction_scale = direction_scale(storage);
    if (!draw.box.empty()) {
        draw.stored_box = {glm::vec3((glm::dvec3(draw.box.low) - draw.stored.origin) / draw.stored.step),
                           glm::vec3((glm::dvec3(draw.box.high) - draw.stored.origin) / draw.stored.step)};
    }
    draw.layout = vertex_layout(storage);
    draw.has_normals = !mesh.normals.empty();
    draw.has_tangents = !mesh.tangents.empty();
    draw.has_colors = !mesh.colors.empty();
    draw.has_uv1 = !mesh.uv1.empty();
    draw.mode = gl_mode(mesh.primitive);
    for (MeshPiece& piece : packed_pieces(mesh, storage, caps.index_uint ? ~std::size_t{0} : 65536)) {
        FacingGroups facing;
        if (orders) facing = order_by_facing(positions_of(piece, draw.layout), piece.indices);
        draw.parts.push_back(upload_piece(gl, caps, piece, draw.layout));
        draw.parts.back().facing = std::move(facing);
        draw.mode = gl_mode(piece.primitive);
    }
    return draw;
}

}  // namespace halfframe
