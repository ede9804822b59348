// Makes and fills the buffers, palettes and textures of meshes that change their shape.
#include "engine/frame/moving_meshes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "engine/error.h"
#include "engine/frame/pose.h"
#include "shaders_es/common/mesh_vertex_limits.h"

namespace halfframe {

namespace {

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

int texture_rows(std::size_t joints) { return static_cast<int>((joints + JOINTS_A_ROW - 1) / JOINTS_A_ROW); }

/// Vertex of the mesh behind vertex `i` of a part.
std::size_t source_of(const DrawPart& part, std::size_t i) { return part.sources.empty() ? i : part.sources[i]; }

}  // namespace

MovingMeshes::MovingMeshes(gl::EntryPoints& gl, const gl::Caps& caps, const Scene& scene,
                           std::span<const DrawMesh> meshes, bool low, std::optional<Skinning> wished)
    : gl_(gl), caps_(caps), meshes_(meshes), of_surface_(scene.surfaces.size(), -1) {
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        if (changes_shape(scene, scene.surfaces[i])) add(scene, static_cast<int>(i), meshes, low, wished);
    }
    if (surfaces_.empty()) return;
    world_from_node_.resize(scene.nodes.size());
    std::size_t longest = 0;
    for (const Moving& moving : surfaces_) {
        if (!moving.streams) continue;
        const int mesh = scene.surfaces[static_cast<std::size_t>(moving.surface)].mesh;
        for (const DrawPart& part : meshes[static_cast<std::size_t>(mesh)].parts)
            longest = std::max(longest, static_cast<std::size_t>(part.vertex_count));
    }
    staging_.resize(longest);
    update(scene);
}

int MovingMeshes::mesh_data(const Scene& scene, int mesh) {
    const auto known = std::ranges::find(data_, mesh, &MeshData::mesh);
    if (known != data_.end()) return static_cast<int>(known - data_.begin());
    const Mesh& source = scene.meshes[static_cast<std::size_t>(mesh)];
    MeshData data;
    data.mesh = mesh;
    data.targets = target_boxes(source);
    if (!source.joints.empty()) data.skinned = skinned_mesh(source);
    data.wide_joints = data.skinned.joints.size() > 256;
    data_.push_back(std::move(data));
    return static_cast<int>(data_.size()) - 1;
}

Skinning MovingMeshes::way_for(std::size_t joints, bool low, std::optional<Skinning> wished) const {
    const Skinning first = wished.value_or(Skinning::uniforms);
    const std::size_t in_uniforms = low ? JOINTS_SMALL : JOINTS_LARGE;
    if (first == Skinning::uniforms && joints <= in_uniforms) return Skinning::uniforms;
    const bool fetches = !low && caps_.es_version >= 30 && caps_.max_vertex_samplers > 0;
    const int side = std::max(3 * JOINTS_A_ROW, texture_rows(joints));
    if (first != Skinning::cpu && fetches && side <= caps_.max_texture_size) return Skinning::texture;
    return Skinning::cpu;
}

void MovingMeshes::add(const Scene& scene, int index, std::span<const DrawMesh> meshes, bool low,
                       std::optional<Skinning> wished) {
    const Surface& surface = scene.surfaces[static_cast<std::size_t>(index)];
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(surface.mesh)];
    expect(mesh.morph_targets.empty() || surface.node >= 0,
           "a surface with morph targets needs a node, which holds their weights");
    Moving moving;
    moving.surface = index;
    moving.skinned = surface.skin >= 0;
    moving.mesh_data = mesh_data(scene, surface.mesh);
    MeshData& data = data_[static_cast<std::size_t>(moving.mesh_data)];
    if (moving.skinned) {
        moving.way = way_for(data.skinned.joints.size(), low, wished);
        moving.palette.resize(data.skinned.joints.size());
        moving.next_palette.resize(data.skinned.joints.size());
    }
    moving.streams = !mesh.morph_targets.empty() || (moving.skinned && moving.way == Skinning::cpu);
    if (!mesh.morph_targets.empty())
        moving.morph_weights.resize(scene.nodes[static_cast<std::size_t>(surface.node)].morph_weights.size());
    const DrawMesh& drawn = meshes[static_cast<std::size_t>(surface.mesh)];
    if (moving.skinned && moving.way != Skinning::cpu && data.skin.empty()) upload_joints(data, drawn.parts);
    if (moving.skinned && moving.way == Skinning::texture) {
        writes_textures_ = true;
        // Whole rows are uploaded.
        moving.palette.resize(static_cast<std::size_t>(texture_rows(data.skinned.joints.size())) * JOINTS_A_ROW);
        moving.next_palette.resize(moving.palette.size());
        moving.palette_texture = gl::create<gl::Kind::texture>(gl_);
        gl_.ActiveTexture(GL_TEXTURE0);
        gl_.BindTexture(GL_TEXTURE_2D, moving.palette_texture.name());
        for (const auto& [parameter, value] :
             {std::pair{GL_TEXTURE_MIN_FILTER, GL_NEAREST}, std::pair{GL_TEXTURE_MAG_FILTER, GL_NEAREST},
              std::pair{GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE}, std::pair{GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE}}) {
            gl_.TexParameteri(GL_TEXTURE_2D, static_cast<GLenum>(parameter), value);
        }
        write_texture(moving);
        gl::label(gl_, moving.palette_texture, "joint_map");
    }
    make_parts(moving, drawn);
    of_surface_[static_cast<std::size_t>(index)] = static_cast<int>(surfaces_.size());
    surfaces_.push_back(std::move(moving));
}

void MovingMeshes::upload_joints(MeshData& data, std::span<const DrawPart> parts) {
    for (const DrawPart& part : parts) {
        std::vector<std::uint8_t> bytes;
        for (std::size_t i = 0; i < static_cast<std::size_t>(part.vertex_count); ++i) {
            const SkinVertex& vertex = data.skinned.vertices[source_of(part, i)];
            for (const std::uint16_t joint : vertex.joints) {
                bytes.push_back(static_cast<std::uint8_t>(joint & 255u));
                if (data.wide_joints) bytes.push_back(static_cast<std::uint8_t>(joint >> 8u));  // little-endian
            }
            bytes.insert(bytes.end(), vertex.weights.begin(), vertex.weights.end());
        }
        data.skin.push_back(gl::create<gl::Kind::buffer>(gl_));
        gl_.BindBuffer(GL_ARRAY_BUFFER, data.skin.back().name());
        gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes.size()), bytes.data(), GL_STATIC_DRAW);
    }
}

void MovingMeshes::make_parts(Moving& moving, const DrawMesh& mesh) {
    moving.parts.resize(mesh.parts.size());
    for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
        Moving::Part& part = moving.parts[i];
        const std::size_t copies = moving.streams ? 2 : 1;
        for (std::size_t copy = 0; copy < copies; ++copy) {
            if (moving.streams) {
                part.moved[copy] = gl::create<gl::Kind::buffer>(gl_);
                gl_.BindBuffer(GL_ARRAY_BUFFER, part.moved[copy].name());
                gl_.BufferData(GL_ARRAY_BUFFER,
                               static_cast<GLsizeiptr>(sizeof(StreamVertex)) * mesh.parts[i].vertex_count, nullptr,
                               GL_DYNAMIC_DRAW);
            }
            if (!mesh.parts[i].array) continue;
            part.arrays[copy] = gl::create<gl::Kind::vertex_array>(gl_);
            gl_.BindVertexArray(part.arrays[copy].name());
            point_attributes(moving, mesh, i, copy);
            for (GLuint attribute = 0; attribute < kVertexAttributes; ++attribute) {
                if ((attributes(moving, mesh) & 1u << attribute) != 0) gl_.EnableVertexAttribArray(attribute);
            }
            gl_.BindVertexArray(0);
        }
    }
}

void MovingMeshes::point_attributes(const Moving& moving, const DrawMesh& mesh, std::size_t part, std::size_t turn) {
    const DrawPart& drawn = mesh.parts[part];
    gl_.BindBuffer(GL_ARRAY_BUFFER, drawn.vertices.name());
    set_vertex_layout(gl_, mesh.layout);
    if (moving.streams) {
        constexpr GLsizei stride = sizeof(StreamVertex);
        gl_.BindBuffer(GL_ARRAY_BUFFER, moving.parts[part].moved[turn].name());
        gl_.VertexAttribPointer(kPosition, 3, GL_FLOAT, GL_FALSE, stride, offset(offsetof(StreamVertex, position)));
        if (mesh.has_normals)
            gl_.VertexAttribPointer(kNormal, 2, GL_SHORT, GL_TRUE, stride, offset(offsetof(StreamVertex, normal)));
        if (mesh.has_tangents)
            gl_.VertexAttribPointer(kTangent, 2, GL_SHORT, GL_TRUE, stride, offset(offsetof(StreamVertex, tangent)));
    }
    if (moving.skinned && moving.way != Skinning::cpu) {
        const MeshData& data = data_[static_cast<std::size_t>(moving.mesh_data)];
        const std::size_t joint_bytes = data.wide_joints ? 8 : 4;
        const auto stride = static_cast<GLsizei>(joint_bytes + 4);
        gl_.BindBuffer(GL_ARRAY_BUFFER, data.skin[part].name());
        gl_.VertexAttribPointer(kJoints, 4, data.wide_joints ? GL_UNSIGNED_SHORT : GL_UNSIGNED_BYTE, GL_FALSE, stride,
                                offset(0));
        gl_.VertexAttribPointer(kWeights, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, offset(joint_bytes));
    }
    if (drawn.indices) gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, drawn.indices.name());
}

std::uint32_t MovingMeshes::bind(const Moving& moving, const DrawMesh& mesh, std::size_t part) {
    const gl::VertexArray& array = moving.parts[part].arrays[moving.turn];
    if (!array) point_attributes(moving, mesh, part, moving.turn);
    return array.name();
}

unsigned MovingMeshes::attributes(const Moving& moving, const DrawMesh& mesh) const {
    unsigned wanted = 0;
    for (int i = 0; i < mesh.layout.count; ++i)
        wanted |= 1u << mesh.layout.streams[static_cast<std::size_t>(i)].attribute;
    if (moving.skinned && moving.way != Skinning::cpu) wanted |= 1u << kJoints | 1u << kWeights;
    return wanted;
}

const MovingMeshes::Moving* MovingMeshes::find(int surface) const {
    const int place = of_surface_[static_cast<std::size_t>(surface)];
    return place < 0 ? nullptr : &surfaces_[static_cast<std::size_t>(place)];
}

void MovingMeshes::update(const Scene& scene) {
    world_from_nodes(scene, world_from_node_);
    for (Moving& moving : surfaces_) update(scene, moving);
}

void MovingMeshes::update(const Scene& scene, Moving& moving) {
    const Surface& surface = scene.surfaces[static_cast<std::size_t>(moving.surface)];
    const MeshData& data = data_[static_cast<std::size_t>(moving.mesh_data)];
    bool morphs = !moving.ever_written && moving.streams;
    bool turns = !moving.ever_written;
    if (!moving.morph_weights.empty()) {
        const std::vector<float>& now = scene.nodes[static_cast<std::size_t>(surface.node)].morph_weights;
        morphs = morphs || now != moving.morph_weights;
        std::ranges::copy(now, moving.morph_weights.begin());
    }
    if (moving.skinned) {
        write_palette(scene, surface, data.skinned.joints, world_from_node_, moving.next_palette);
        turns = turns || moving.next_palette != moving.palette;
        std::swap(moving.next_palette, moving.palette);
    }
    if (!morphs && !turns) return;
    moving.ever_written = true;
    ++moving.shape;
    const Box reach = morph_reach(data.targets, moving.morph_weights);
    if (moving.skinned) {
        moving.box = skinned_box(data.skinned, moving.palette, reach);
    } else {
        const Box& still = meshes_[static_cast<std::size_t>(surface.mesh)].box;
        moving.box = still.empty() ? still : Box{still.low + reach.low, still.high + reach.high};
    }
    if (moving.skinned && moving.way == Skinning::texture) write_texture(moving);
    if (morphs || (turns && moving.skinned && moving.way == Skinning::cpu)) write_streams(scene, moving);
}

void MovingMeshes::write_texture(const Moving& moving) {
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, moving.palette_texture.name());
    const auto format = gl::transfer_format(gl::PixelFormat::rgba32f, false);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format.internal_format), 3 * JOINTS_A_ROW,
                   static_cast<GLsizei>(moving.palette.size() / JOINTS_A_ROW), 0, format.format, format.type,
                   moving.palette.data());
}

void MovingMeshes::write_streams(const Scene& scene, Moving& moving) {
    const Surface& surface = scene.surfaces[static_cast<std::size_t>(moving.surface)];
    const Mesh& mesh = scene.meshes[static_cast<std::size_t>(surface.mesh)];
    const DrawMesh& drawn = meshes_[static_cast<std::size_t>(surface.mesh)];
    const MeshData& data = data_[static_cast<std::size_t>(moving.mesh_data)];
    const bool skins = moving.skinned && moving.way == Skinning::cpu;
    moving.turn = 1 - moving.turn;
    for (std::size_t part = 0; part < drawn.parts.size(); ++part) {
        const auto count = static_cast<std::size_t>(drawn.parts[part].vertex_count);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t source = source_of(drawn.parts[part], i);
            MovedVertex vertex = morphed(mesh, source, moving.morph_weights);
            if (skins) vertex = skinned(vertex, data.skinned.vertices[source], moving.palette);
            StreamVertex& out = staging_[i];
            for (int axis = 0; axis < 3; ++axis) out.position[static_cast<std::size_t>(axis)] = vertex.position[axis];
            if (drawn.has_normals) out.normal = octahedral16(glm::dvec3(vertex.normal));
            if (drawn.has_tangents) out.tangent = octahedral16_tangent(glm::dvec4(vertex.tangent));
        }
        gl_.BindBuffer(GL_ARRAY_BUFFER, moving.parts[part].moved[moving.turn].name());
        gl_.BufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(count * sizeof(StreamVertex)), staging_.data());
    }
}

std::string MovingMeshes::notice() const {
    constexpr std::array<const char*, 3> kWays{"in uniforms", "in a texture", "on the CPU"};
    std::array<int, 3> surfaces{};
    std::size_t most_joints = 0;
    for (const Moving& moving : surfaces_) {
        if (!moving.skinned) continue;
        ++surfaces[static_cast<std::size_t>(moving.way)];
        most_joints = std::max(most_joints, data_[static_cast<std::size_t>(moving.mesh_data)].skinned.joints.size());
    }
    std::string sentence;
    for (std::size_t way = 0; way < surfaces.size(); ++way) {
        if (surfaces[way] == 0) continue;
        sentence += fmt::format("{}{} surface{} skinned {}", sentence.empty() ? "" : ", ", surfaces[way],
                                surfaces[way] == 1 ? "" : "s", kWays[way]);
    }
    if (sentence.empty()) return sentence;
    return fmt::format("{} (at most {} joints carry one; {} fits {} at low and {} above in uniforms)", sentence,
                       most_joints, caps_.device, JOINTS_SMALL, JOINTS_LARGE);
}

}  // namespace halfframe
