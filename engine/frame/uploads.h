// Brings meshes and textures of a scene to the device.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/frame/scene.h"
#include "engine/frame/vertex_layout.h"
#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "engine/gl/object.h"

namespace halfframe {

/// A piece of a mesh that one draw call covers: all of it, unless the device lacks 32-bit indices.
struct DrawPart {
    gl::Buffer vertices;
    gl::Buffer uv1;         ///< the second set, vec2 floats; empty: the mesh has none
    gl::Buffer indices;     ///< empty: drawn in order
    gl::VertexArray array;  ///< empty where the device has none
    std::uint32_t index_type = 0;
    int count = 0;  ///< indices, or vertices without them
};

/// The mesh of a scene on the device.
struct DrawMesh {
    std::vector<DrawPart> parts;
    std::uint32_t mode = 0;  ///< GL_TRIANGLES and so on
    Box box;                 ///< local [m]
    bool has_normals = false;
    bool has_tangents = false;
    bool has_colors = false;
    bool has_uv1 = false;
};

/// A mesh, or a piece of one, as the device will have it.
struct MeshPiece {
    Primitive primitive = Primitive::triangles;
    std::vector<PackedVertex> vertices;
    std::vector<glm::vec2> uv1;  ///< as long as `vertices`, or empty
    std::vector<std::uint32_t> indices;
};

/// `mesh` packed, in pieces of at most `max_vertices` vertices (65536 where indices are 16-bit). Strips, fans and loops
/// that need cutting become lists first. Pure.
[[nodiscard]] std::vector<MeshPiece> packed_pieces(const Mesh& mesh, std::size_t max_vertices);

[[nodiscard]] DrawMesh upload_mesh(gl::EntryPoints& gl, const gl::Caps& caps, const Mesh& mesh);

/// Sets the five attributes of PackedVertex on the buffer bound to GL_ARRAY_BUFFER.
void set_vertex_layout(gl::EntryPoints& gl);
/// Sets kUv1 on the part's own buffer of it, which stays bound to GL_ARRAY_BUFFER.
void set_uv1_layout(gl::EntryPoints& gl, const DrawPart& part);

/// Pixels halved until they fit `max_size`, then, if `power_of_two`, filtered to the nearest power of two not above it.
[[nodiscard]] Image fitted(const Image& image, int max_size, bool power_of_two);

/// The textures of one renderer, each uploaded once for each way it is sampled.
class TextureStore {
public:
    TextureStore(gl::EntryPoints& gl, const gl::Caps& caps) : gl_(gl), caps_(caps) {}
    std::uint32_t get(const Scene& scene, const Texture& texture, bool decoded, std::vector<std::string>& notices);
    [[nodiscard]] std::size_t bytes() const { return bytes_; }  ///< mip levels included

private:
    struct Entry {
        Texture texture;
        bool decoded;
        gl::Texture object;
    };
    gl::EntryPoints& gl_;
    const gl::Caps& caps_;
    std::vector<Entry> entries_;
    std::size_t bytes_ = 0;
};

}  // namespace halfframe
