// Packs meshes, fits images to the device, and uploads both.
#include "engine/frame/uploads.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <unordered_map>

#include <fmt/format.h>

#include "engine/error.h"

namespace halfframe {

namespace {

std::int16_t snorm16(float x) { return static_cast<std::int16_t>(std::lround(std::clamp(x, -1.0f, 1.0f) * 32767.0f)); }
std::uint8_t unorm8(float x) { return static_cast<std::uint8_t>(std::lround(std::clamp(x, 0.0f, 1.0f) * 255.0f)); }

PackedVertex packed_vertex(const Mesh& mesh, std::size_t i) {
    PackedVertex vertex{};
    const glm::vec3 position = mesh.positions[i];
    const glm::vec3 normal = mesh.normals.empty() ? glm::vec3(0.0f, 0.0f, 1.0f) : mesh.normals[i];
    const glm::vec4 tangent = mesh.tangents.empty() ? glm::vec4(1.0f, 0.0f, 0.0f, 1.0f) : mesh.tangents[i];
    const glm::vec2 uv = mesh.uv.empty() ? glm::vec2(0.0f) : mesh.uv[i];
    const glm::vec4 color = mesh.colors.empty() ? glm::vec4(1.0f) : mesh.colors[i];
    for (int k = 0; k < 3; ++k) {
        vertex.position[k] = position[k];
        vertex.normal[k] = snorm16(normal[k]);
        vertex.tangent[k] = snorm16(tangent[k]);
    }
    vertex.tangent[3] = snorm16(tangent.w);
    vertex.uv[0] = uv.x;
    vertex.uv[1] = uv.y;
    for (int k = 0; k < 4; ++k) vertex.color[k] = unorm8(color[k]);
    return vertex;
}

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

DrawPart upload_piece(gl::EntryPoints& gl, const gl::Caps& caps, const MeshPiece& piece) {
    DrawPart part;
    if (caps.vertex_array_objects || caps.core_profile) {
        part.array = gl::create<gl::Kind::vertex_array>(gl);
        gl.BindVertexArray(part.array.name());
    }
    part.vertices = gl::create<gl::Kind::buffer>(gl);
    gl.BindBuffer(GL_ARRAY_BUFFER, part.vertices.name());
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(piece.vertices.size() * sizeof(PackedVertex)),
                  piece.vertices.data(), GL_STATIC_DRAW);
    part.count = static_cast<int>(piece.vertices.size());
    if (!piece.indices.empty()) {
        part.indices = gl::create<gl::Kind::buffer>(gl);
        part.count = static_cast<int>(piece.indices.size());
        gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, part.indices.name());
        if (piece.vertices.size() <= 65536) {
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
    if (!piece.uv1.empty()) part.uv1 = gl::create<gl::Kind::buffer>(gl);
    if (part.array) set_vertex_layout(gl);
    if (part.uv1) {
        gl.BindBuffer(GL_ARRAY_BUFFER, part.uv1.name());
        gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(piece.uv1.size() * sizeof(glm::vec2)), piece.uv1.data(),
                      GL_STATIC_DRAW);
        if (part.array) set_uv1_layout(gl, part);
    }
    if (part.array) {
        gl.BindVertexArray(0);
    }
    return part;
}

/// Half the size in each direction, each pixel the mean of up to four.
Image halved(const Image& image) {
    Image half{.name = image.name,
               .width = std::max(image.width / 2, 1),
               .height = std::max(image.height / 2, 1),
               .srgb = image.srgb,
               .rgba = {}};
    half.rgba.resize(static_cast<std::size_t>(half.width) * half.height * 4);
    for (int y = 0; y < half.height; ++y) {
        for (int x = 0; x < half.width; ++x) {
            const int x0 = std::min(2 * x, image.width - 1), x1 = std::min(2 * x + 1, image.width - 1);
            const int y0 = std::min(2 * y, image.height - 1), y1 = std::min(2 * y + 1, image.height - 1);
            for (int c = 0; c < 4; ++c) {
                const auto at = [&](int px, int py) {
                    return int{image.rgba[(static_cast<std::size_t>(py) * image.width + px) * 4 + c]};
                };
                half.rgba[(static_cast<std::size_t>(y) * half.width + x) * 4 + c] =
                    static_cast<std::uint8_t>((at(x0, y0) + at(x1, y0) + at(x0, y1) + at(x1, y1) + 2) / 4);
            }
        }
    }
    return half;
}

/// Bilinear resampling; between half and the whole size, so that no texel is skipped.
Image resampled(const Image& image, int width, int height) {
    Image out{.name = image.name, .width = width, .height = height, .srgb = image.srgb, .rgba = {}};
    out.rgba.resize(static_cast<std::size_t>(width) * height * 4);
    const float scale_x = static_cast<float>(image.width) / static_cast<float>(width);
    const float scale_y = static_cast<float>(image.height) / static_cast<float>(height);
    for (int y = 0; y < height; ++y) {
        const float sy = std::max((static_cast<float>(y) + 0.5f) * scale_y - 0.5f, 0.0f);
        const int y0 = std::min(static_cast<int>(sy), image.height - 1), y1 = std::min(y0 + 1, image.height - 1);
        for (int x = 0; x < width; ++x) {
            const float sx = std::max((static_cast<float>(x) + 0.5f) * scale_x - 0.5f, 0.0f);
            const int x0 = std::min(static_cast<int>(sx), image.width - 1), x1 = std::min(x0 + 1, image.width - 1);
            for (int c = 0; c < 4; ++c) {
                const auto at = [&](int px, int py) {
                    return static_cast<float>(image.rgba[(static_cast<std::size_t>(py) * image.width + px) * 4 + c]);
                };
                const float fx = sx - static_cast<float>(x0), fy = sy - static_cast<float>(y0);
                const float top = at(x0, y0) * (1.0f - fx) + at(x1, y0) * fx;
                const float bottom = at(x0, y1) * (1.0f - fx) + at(x1, y1) * fx;
                out.rgba[(static_cast<std::size_t>(y) * width + x) * 4 + c] =
                    static_cast<std::uint8_t>(std::lround(top * (1.0f - fy) + bottom * fy));
            }
        }
    }
    return out;
}

GLint minify_filter(const Texture& texture) {
    const Minify minify = texture.minify.value_or(Minify{.linear = texture.linear, .between = texture.linear});
    if (!texture.mipmaps) return minify.linear ? GL_LINEAR : GL_NEAREST;
    if (minify.between) return minify.linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_LINEAR;
    return minify.linear ? GL_LINEAR_MIPMAP_NEAREST : GL_NEAREST_MIPMAP_NEAREST;
}

bool is_power_of_two(int x) { return std::has_single_bit(static_cast<unsigned>(x)); }

}  // namespace

std::vector<MeshPiece> packed_pieces(const Mesh& mesh, std::size_t max_vertices) {
    std::vector<MeshPiece> pieces;
    if (mesh.positions.size() <= max_vertices) {
        MeshPiece whole{.primitive = mesh.primitive, .vertices = {}, .uv1 = mesh.uv1, .indices = mesh.indices};
        whole.vertices.reserve(mesh.positions.size());
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) whole.vertices.push_back(packed_vertex(mesh, i));
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
        if (pieces.empty() || pieces.back().vertices.size() + list.corners > max_vertices) {
            pieces.push_back({.primitive = list.primitive, .vertices = {}, .uv1 = {}, .indices = {}});
            local.clear();
        }
        MeshPiece& piece = pieces.back();
        for (int corner = 0; corner < list.corners; ++corner) {
            const std::uint32_t index = list.indices[i + corner];
            const auto [found, added] = local.try_emplace(index, static_cast<std::uint32_t>(piece.vertices.size()));
            if (added) piece.vertices.push_back(packed_vertex(mesh, index));
            if (added && !mesh.uv1.empty()) piece.uv1.push_back(mesh.uv1[index]);
            piece.indices.push_back(found->second);
        }
    }
    return pieces;
}

void set_vertex_layout(gl::EntryPoints& gl) {
    const auto offset = [](std::size_t bytes) { return reinterpret_cast<const void*>(bytes); };
    constexpr GLsizei stride = sizeof(PackedVertex);
    gl.VertexAttribPointer(kPosition, 3, GL_FLOAT, GL_FALSE, stride, offset(offsetof(PackedVertex, position)));
    gl.VertexAttribPointer(kNormal, 4, GL_SHORT, GL_TRUE, stride, offset(offsetof(PackedVertex, normal)));
    gl.VertexAttribPointer(kTangent, 4, GL_SHORT, GL_TRUE, stride, offset(offsetof(PackedVertex, tangent)));
    gl.VertexAttribPointer(kUv, 2, GL_FLOAT, GL_FALSE, stride, offset(offsetof(PackedVertex, uv)));
    gl.VertexAttribPointer(kColor, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, offset(offsetof(PackedVertex, color)));
    for (const int attribute : {kPosition, kNormal, kTangent, kUv, kColor}) {
        gl.EnableVertexAttribArray(static_cast<GLuint>(attribute));
    }
}

void set_uv1_layout(gl::EntryPoints& gl, const DrawPart& part) {
    gl.BindBuffer(GL_ARRAY_BUFFER, part.uv1.name());
    gl.VertexAttribPointer(kUv1, 2, GL_FLOAT, GL_FALSE, sizeof(glm::vec2), nullptr);
    gl.EnableVertexAttribArray(kUv1);
}

DrawMesh upload_mesh(gl::EntryPoints& gl, const gl::Caps& caps, const Mesh& mesh) {
    DrawMesh draw;
    draw.box = local_box(mesh);
    draw.has_normals = !mesh.normals.empty();
    draw.has_tangents = !mesh.tangents.empty();
    draw.has_colors = !mesh.colors.empty();
    draw.has_uv1 = !mesh.uv1.empty();
    draw.mode = gl_mode(mesh.primitive);
    for (const MeshPiece& piece : packed_pieces(mesh, caps.index_uint ? ~std::size_t{0} : 65536)) {
        draw.parts.push_back(upload_piece(gl, caps, piece));
        draw.mode = gl_mode(piece.primitive);
    }
    return draw;
}

Image fitted(const Image& image, int max_size, bool power_of_two) {
    Image out = image;
    while (out.width > max_size || out.height > max_size) out = halved(out);
    if (power_of_two && (!is_power_of_two(out.width) || !is_power_of_two(out.height))) {
        out = resampled(out, static_cast<int>(std::bit_floor(static_cast<unsigned>(out.width))),
                        static_cast<int>(std::bit_floor(static_cast<unsigned>(out.height))));
    }
    return out;
}

std::uint32_t TextureStore::get(const Scene& scene, const Texture& texture, bool decoded,
                                std::vector<std::string>& notices) {
    const auto found = std::ranges::find_if(
        entries_, [&](const Entry& entry) { return entry.texture == texture && entry.decoded == decoded; });
    if (found != entries_.end()) return found->object.name();

    const Image& source = scene.images[static_cast<std::size_t>(texture.image)];
    const bool needs_power_of_two =
        !caps_.npot_textures && (texture.mipmaps || texture.wrap_u != Wrap::clamp || texture.wrap_v != Wrap::clamp);
    const Image image = fitted(source, caps_.max_texture_size, needs_power_of_two);
    if (image.width != source.width || image.height != source.height) {
        notices.push_back(fmt::format("texture {} is {}x{} texels and was made {}x{} for {}", source.name, source.width,
                                      source.height, image.width, image.height, caps_.device));
    }
    Entry entry{texture, decoded, gl::create<gl::Kind::texture>(gl_)};
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, entry.object.name());
    const auto format =
        gl::transfer_format(decoded ? gl::PixelFormat::srgb8_alpha8 : gl::PixelFormat::rgba8, !caps_.sized_formats);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format.internal_format), image.width, image.height, 0,
                   format.format, format.type, image.rgba.data());
    const auto wrap = [](Wrap mode) {
        return mode == Wrap::repeat ? GL_REPEAT : mode == Wrap::clamp ? GL_CLAMP_TO_EDGE : GL_MIRRORED_REPEAT;
    };
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap(texture.wrap_u));
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap(texture.wrap_v));
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, texture.linear ? GL_LINEAR : GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minify_filter(texture));
    std::size_t bytes = static_cast<std::size_t>(image.width) * image.height * 4;
    if (texture.mipmaps) {
        gl_.GenerateMipmap(GL_TEXTURE_2D);
        bytes += bytes / 3;
    }
    gl::label(gl_, entry.object, source.name.c_str());
    bytes_ += bytes;
    entries_.push_back(std::move(entry));
    return entries_.back().object.name();
}

}  // namespace halfframe
