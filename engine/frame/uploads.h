// Brings meshes and textures of a scene to the device.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/frame/facing.h"
#include "engine/frame/scene.h"
#include "engine/frame/texture_storage.h"
#include "engine/frame/vertex_layout.h"
#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "engine/gl/object.h"

namespace halfframe {

/// A piece of a mesh that one draw call covers: all of it, unless the device lacks 32-bit indices.
struct DrawPart {
    gl::Buffer vertices;
    gl::Buffer indices;     ///< empty: drawn in order
    gl::VertexArray array;  ///< empty where the device has none
    std::uint32_t index_type = 0;
    int count = 0;  ///< indices, or vertices without them
    int vertex_count = 0;
    int triangles = 0;                   ///< that a draw of it makes; points and lines: 0
    std::vector<std::uint32_t> sources;  ///< vertex of the mesh behind each of the part's; empty: the same
    FacingGroups facing;                 ///< of its triangles, in stored positions; empty: the mesh's own order
};

/// The mesh of a scene on the device.
struct DrawMesh {
    std::vector<DrawPart> parts;
    std::uint32_t mode = 0;  ///< GL_TRIANGLES and so on
    Box box;                 ///< local [m]
    MeshStorage storage;     ///< what the shaders get
    StoredPositions stored;  ///< of its positions
    Box stored_box;          ///< `box` as stored
    glm::vec4 direction_scale{1.0f};
    VertexLayout layout;
    bool has_normals = false;
    bool has_tangents = false;
    bool has_colors = false;
    bool has_uv1 = false;
    [[nodiscard]] std::int64_t triangles() const;  ///< of all parts
};

/// A mesh, or a piece of one, as the device will have it.
struct MeshPiece {
    Primitive primitive = Primitive::triangles;
    std::size_t vertex_count = 0;
    std::vector<std::byte> vertices;  ///< interleaved, as vertex_layout() says
    std::vector<std::uint32_t> indices;
    std::vector<std::uint32_t> sources;  ///< vertex of the mesh behind each; empty: the same
};

/// `mesh` stored as `storage` says, in pieces of at most `max_vertices` vertices (65536 where indices are 16-bit).
/// Strips, fans and loops that need cutting become lists first. Pure.
[[nodiscard]] std::vector<MeshPiece> packed_pieces(const Mesh& mesh, const MeshStorage& storage,
                                                   std::size_t max_vertices);

/// Triangles that a draw of so many indices, or of vertices without them, makes, those without area too; of points and
/// lines 0.
[[nodiscard]] int triangles_in(Primitive primitive, int count);

/// `orders`: triangles may change their order, so that those that face away can be left out (facing.h).
[[nodiscard]] DrawMesh upload_mesh(gl::EntryPoints& gl, const gl::Caps& caps, const Mesh& mesh,
                                   const MeshStorage& storage, bool orders = false);

/// Points the attributes of `layout` at the buffer bound to GL_ARRAY_BUFFER; switches none on or off.
void set_vertex_layout(gl::EntryPoints& gl, const VertexLayout& layout);

/// Pixels halved until they fit `max_size`, then, if `power_of_two`, filtered to the nearest power of two not above it.
[[nodiscard]] Image fitted(const Image& image, int max_size, bool power_of_two, TexelKind kind);

/// The textures of one renderer, each uploaded once for each way it is sampled.
class TextureStore {
public:
    TextureStore(gl::EntryPoints& gl, const gl::Caps& caps, TextureCompression compression)
        : gl_(gl), caps_(caps), compression_(compression) {}
    /// Decides which levels of the scene's images to leave out where the device limits the bytes of all textures.
    void fit(const Scene& scene, std::vector<std::string>& notices);
    /// Images beside the scene's, numbered after them: see MaterialChanges. They live until the last
    /// get().
    void add_images(std::span<const Image> images, std::span<const int> instead_of) {
        more_images_ = images;
        instead_of_ = instead_of;
    }
    std::uint32_t get(const Scene& scene, const Texture& texture, const TextureUse& use,
                      std::vector<std::string>& notices);
    /// Two textures in one, sampled as the first: packed_surface_map() of normals and metallic-roughness where `use` is
    /// of kind packed_surface, color_with_occlusion() where it is color, color_with_emission() where its alpha emits.
    std::uint32_t get_packed(const Scene& scene, const Texture& first, const Texture& second, const TextureUse& use,
                             std::vector<std::string>& notices);
    /// emission_mask() of an image, looked for once.
    [[nodiscard]] std::optional<glm::vec3> mask_of(const Scene& scene, const Texture& emission);
    [[nodiscard]] std::size_t bytes() const { return bytes_; }  ///< mip levels included
    /// What compressing has cost and lost, as a sentence; empty where nothing is compressed.
    [[nodiscard]] std::string compression() const;

private:
    struct Entry {
        Texture texture;
        int packed_with;  ///< image of the second texture of get_packed(); -1: none
        TextureUse use;
        gl::Texture object;
    };
    struct Compressed {
        int textures = 0;
        std::size_t bytes_plain = 0, bytes = 0;
        double worst_rms_codes = 0.0, worst_codes = 0.0;
    };
    [[nodiscard]] const Image& image_of(const Scene& scene, const Texture& texture) const;
    [[nodiscard]] const Image& fitted_image(const Scene& scene, const Texture& texture, TexelKind kind,
                                            std::vector<std::string>& notices, Image& made) const;
    std::uint32_t upload(const Image& image, const Texture& texture, const TextureUse& use, int packed_with);
    void upload_level(const Image& image, int level, const TextureUse& use, bool one_channel);
    void upload_compressed(const Image& image, int level, bool with_alpha, bool decoded);
    gl::EntryPoints& gl_;
    const gl::Caps& caps_;
    TextureCompression compression_;
    Compressed compressed_;
    std::vector<int> dropped_levels_;  ///< by image; empty: none
    std::span<const Image> more_images_;
    std::span<const int> instead_of_;
    std::vector<Entry> entries_;
    std::map<int, std::optional<glm::vec3>> masks_;  ///< by image, of those asked for
    std::size_t bytes_ = 0;
};

}  // namespace halfframe
