// Meshes whose vertices move against each other, on the device: joint palettes, and vertices that the CPU has moved.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/frame/skinning.h"
#include "engine/frame/uploads.h"
#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "engine/gl/object.h"

namespace halfframe {

/// Where joints move a vertex.
enum class Skinning : std::uint8_t {
    uniforms,  ///< vertex stage, palette in uniforms: up to 24 joints a mesh at low, 64 above
    texture,   ///< vertex stage, palette in a float texture: ES 3.0
    cpu,       ///< before the frame, into a buffer: any number of joints on any device
};

/// The surfaces of one scene that change their shape. A scene without such makes no call and takes no memory.
class MovingMeshes {
public:
    /// `low`: shaders are those of the low tier. `wished`: empty takes the first way that the device can do; a wish
    /// that it cannot do for a mesh falls to the next. Draws only; `meshes` are the uploaded Scene::meshes.
    MovingMeshes(gl::EntryPoints& gl, const gl::Caps& caps, const Scene& scene, std::span<const DrawMesh> meshes,
                 bool low, std::optional<Skinning> wished);

    /// Brings poses that have changed to the device. No allocation, no GL object.
    void update(const Scene& scene);
    /// Binds textures of palettes while it updates: the transfer state must be known then.
    [[nodiscard]] bool writes_textures() const { return writes_textures_; }
    [[nodiscard]] bool empty() const { return surfaces_.empty(); }

    /// A surface that changes its shape.
    struct Moving {
        int surface = 0;
        Box box;                  ///< relative to the surface's world_from_local; holds every vertex of this pose [m]
        std::uint32_t shape = 0;  ///< another number for every pose
        Skinning way = Skinning::uniforms;
        bool skinned = false;
        std::vector<JointRows> palette;
        gl::Texture palette_texture;

    private:
        friend class MovingMeshes;
        /// What one part of the mesh is drawn from: two of each where the CPU writes, so that it never waits for a
        /// draw.
        struct Part {
            std::array<gl::Buffer, 2> moved;
            std::array<gl::VertexArray, 2> arrays;
        };
        int mesh_data = 0;
        bool streams = false;  ///< the CPU moves vertices: morph targets, or Skinning::cpu
        std::vector<Part> parts;
        std::vector<JointRows> next_palette;
        std::vector<float> morph_weights;
        bool ever_written = false;
        std::size_t turn = 0;  ///< of the two
    };
    /// nullptr: the surface keeps its shape.
    [[nodiscard]] const Moving* find(int surface) const;

    /// Makes the vertex arrays of part `part` ready: returns its array object, or points the attributes where the device
    /// has none and returns 0; then those of attributes() are to be switched on.
    std::uint32_t bind(const Moving& moving, const DrawMesh& mesh, std::size_t part);
    /// One bit for each vertex attribute that is read.
    [[nodiscard]] unsigned attributes(const Moving& moving, const DrawMesh& mesh) const;

    /// One sentence on how many surfaces are skinned in which way and why; empty without skins.
    [[nodiscard]] std::string notice() const;

private:
    /// Of one mesh, shared by the surfaces that show it.
    struct MeshData {
        int mesh = 0;
        SkinnedMesh skinned;
        std::vector<Box> targets;
        std::vector<gl::Buffer> skin;  ///< joints and weights of each part; empty where the CPU skins
        bool wide_joints = false;      ///< 16 bits; else 8
    };
    /// 20 bytes, as the static layout of 32-bit positions has these three.
    struct StreamVertex {
        std::array<float, 3> position;
        glm::i16vec2 normal, tangent;  ///< octahedral
    };

    int mesh_data(const Scene& scene, int mesh);
    [[nodiscard]] Skinning way_for(std::size_t joints, bool low, std::optional<Skinning> wished) const;
    void add(const Scene& scene, int surface, std::span<const DrawMesh> meshes, bool low,
             std::optional<Skinning> wished);
    void upload_joints(MeshData& data, std::span<const DrawPart> parts);
    void make_parts(Moving& moving, const DrawMesh& mesh);
    void point_attributes(const Moving& moving, const DrawMesh& mesh, std::size_t part, std::size_t turn);
    void update(const Scene& scene, Moving& moving);
    void write_texture(const Moving& moving);
    void write_streams(const Scene& scene, Moving& moving);

    gl::EntryPoints& gl_;
    const gl::Caps& caps_;
    std::span<const DrawMesh> meshes_;
    std::vector<MeshData> data_;
    std::vector<Moving> surfaces_;
    std::vector<int> of_surface_;  ///< place in surfaces_; -1: keeps its shape
    std::vector<glm::dmat4> world_from_node_;
    std::vector<StreamVertex> staging_;  ///< as long as the longest part
    bool writes_textures_ = false;
};

}  // namespace halfframe
