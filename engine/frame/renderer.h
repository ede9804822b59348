// Owns programs and targets; draws a plan. The only user of GL besides the effects' own .cpp files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_set>
#include <vector>

#include "engine/error.h"
#include "engine/frame/draw_state.h"
#include "engine/frame/early_flush.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/image.h"
#include "engine/frame/moving_meshes.h"
#include "engine/frame/pass_timer.h"
#include "engine/frame/scene.h"
#include "engine/frame/uploads.h"
#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "engine/gl/object.h"
#include "engine/gl/program.h"

namespace halfframe {

struct RendererDescription {
    std::filesystem::path program_cache_folder;  ///< empty: program binaries are not kept on disk
    std::span<const EffectCard* const> effects = all_effects();
    std::optional<Skinning> skinning;  ///< empty: of each mesh the first way that the device can do
};

/// Counts of non-finite values in one target.
struct CensusRow {
    std::string target;
    std::uint64_t values = 0;  ///< channels looked at
    std::uint64_t nan = 0;
    std::uint64_t inf = 0;
    std::uint64_t negative = 0;  ///< values below 0 (reported, not a failure)
};

/// A linked program, and what it was linked for.
struct ProgramUse {
    std::string effect;              ///< whose card it belongs to
    std::string defines;             ///< space separated; empty: none
    std::string insertions;          ///< effects that add code to it, space separated
    int draws = 0;                   ///< surfaces that are drawn with it; 0: it draws no surface
    std::vector<std::string> users;  ///< names of their materials, each once
};

class RenderTargets;

class Renderer {
public:
    /// `gl` and `caps` outlive the renderer; the context is current on every call. Many renderers may share a process,
    /// each with its own context or taking turns on one.
    Renderer(gl::EntryPoints& gl, const gl::Caps& caps, RendererDescription description = {});
    ~Renderer();
    Renderer(const Renderer&) = delete;
    Renderer& operator=(const Renderer&) = delete;

    /// Uploads the scene, allocates the plan's targets and links the programs its effects need: all that is not a
    /// frame. Throws Error(context) when a target cannot be allocated, naming it and its size; Error(check) for a
    /// shader. `scene` must outlive the renderer or the next prepare().
    void prepare(const Scene& scene, const FramePlan& plan);

    /// Draws one frame of the prepared plan. No heap allocation, no GL object, no program link. Whatever state a host
    /// left behind does not show; our own bindings (framebuffer, program, textures, viewport) are left behind in turn.
    /// Throws Error(context) when the context was lost.
    void draw(const View& view);

    /// Draws one frame with a timer round every pass; samples() of `timer` then hold one more value for each. Passes
    /// that still hold are drawn all the same.
    void draw_timed(const View& view, PassTimer& timer);

    [[nodiscard]] Picture read_display();                      ///< the plan's display target
    [[nodiscard]] FloatPicture read_target(int target_index);  ///< any colour target, as floats
    /// NaN, inf and negatives of every colour target of a plan made with Wishes::census, after a draw().
    [[nodiscard]] std::vector<CensusRow> census();

    /// The first GL error since the last call, as "GL_INVALID_OPERATION", or empty.
    [[nodiscard]] std::string first_gl_error();

    // For effects, while preparing.
    gl::EntryPoints& gl() { return gl_; }
    [[nodiscard]] const gl::Caps& caps() const { return caps_; }
    [[nodiscard]] const FramePlan& plan() const { return plan_; }
    [[nodiscard]] const Scene& scene() const { return *scene_; }
    [[nodiscard]] const DrawMesh& mesh(int index) const { return meshes_[static_cast<std::size_t>(index)]; }
    /// A material as it is drawn: the scene's, or with what an effect has written into it.
    [[nodiscard]] const Material& material(int index) const;
    /// Box of a surface in this frame's pose, relative to its world_from_local [m].
    [[nodiscard]] const Box& box(int surface) const;
    /// A number that changes with the shape of a surface: with its joints and morph weights, not with its place.
    [[nodiscard]] std::uint32_t shape(int surface) const;
    /// The define that a program needs to draw `surface`: SKIN_SMALL, SKIN_LARGE, SKIN_TEXTURE, or empty.
    [[nodiscard]] std::string_view skin_define(int surface) const;
    /// Claims what a program made with that define reads; returns the location for draw_surface(). `program` is current
    /// afterwards.
    int claim_skin(gl::Program& program);
    /// Device texture of a scene texture, uploaded once for each use.
    [[nodiscard]] std::uint32_t texture(const Texture& texture, const TextureUse& use);
    /// The same for two textures in one that are sampled alike: TextureStore::get_packed().
    [[nodiscard]] std::uint32_t packed_texture(const Texture& first, const Texture& second, const TextureUse& use);
    /// emission_mask() of a scene texture.
    [[nodiscard]] std::optional<glm::vec3> mask_of(const Texture& emission);
    /// Bytes of every texture on the device, mip levels included.
    [[nodiscard]] std::size_t texture_bytes() const { return texture_bytes_ + own_texture_bytes_; }
    /// Adds a texture that an effect has uploaded itself to that sum.
    void count_texture_bytes(std::size_t bytes) { own_texture_bytes_ += bytes; }
    /// The tier the plan gave to an effect.
    [[nodiscard]] Tier tier_of(std::string_view effect) const;
    /// The program of a card's variant at the plan's tier and arithmetic, with the insertions other effects make in it.
    gl::Program& program(const EffectCard& card, int variant, std::span<const std::string_view> defines);
    gl::ProgramCache& programs() { return programs_; }
    /// A surface of this material is drawn with the program: for program_uses().
    void note_use(const gl::Program& program, const std::string& material_name);
    /// Every program that preparing has asked for, in that order, with the reason for each.
    [[nodiscard]] std::vector<ProgramUse> program_uses() const;
    /// What effects add to the defines of a surface's program: EffectCard::add_defines of all that are in.
    void add_defines(int surface, std::vector<std::string_view>& defines) const;
    /// The draws that follow with `program` show `material`: tells it to those who inserted code.
    void feed_material(const gl::Program& program, int material);
    void add_notice(std::string sentence) { notices_.push_back(std::move(sentence)); }
    /// What preparing found worth saying: program cache folder not writable, lights left out, textures made smaller.
    [[nodiscard]] std::vector<std::string> notices() const;

    // For effects, while drawing: no allocation, no repeated call for a state that is set already.
    void use(const gl::Program& program);
    void bind_texture(int unit, std::uint32_t texture);  ///< two-dimensional
    void bind_cube(int unit, std::uint32_t texture);
    [[nodiscard]] std::uint32_t target_texture(int target_index) const;
    /// Averages the samples of a multisampled target into `to_target`, which the pass being drawn writes.
    void resolve(int from_target, int to_target);
    void draw_full_screen();  ///< one triangle over the target; attribute kPosition is the clip position (vec2)
    /// With `clip_from_stored`, triangles that face away there may be left out, where backs are culled.
    void draw_mesh(const DrawMesh& mesh, const glm::mat4* clip_from_stored = nullptr);
    /// The same for a surface as its pose has it, with a program made with its skin_define().
    void draw_surface(int surface, int skin_location, const glm::mat4* clip_from_stored = nullptr);
    /// Has this pass drawn so much since its last flush that it should be flushed if as much is to come? See
    /// engine/frame/early_flush.h; false on drivers that begin by themselves.
    [[nodiscard]] bool flush_is_due() const {
        return caps_.rasters_at_flush && unflushed_triangles_ >= kFlushTriangles;
    }
    void flush();  ///< between two draws of a pass
    void set_depth(bool test, bool write, std::uint32_t function) { state_.set_depth(test, write, function); }
    void set_cull(bool on) { state_.set_cull(on); }
    void set_blend(Blend blend) { state_.set_blend(blend); }
    void set_color_mask(bool on) { state_.set_color_mask(on); }

private:
    void make_full_screen_triangle();
    void change_materials();
    void make_works();
    EffectWork* work_of(const std::string& effect);
    gl::Program& make_program(const EffectCard& card, int variant, std::span<const std::string_view> defines);
    void note_program(std::string_view effect, const std::string& prefix, const gl::Program& program);
    void adopt_insertions(const std::string& prefix, gl::Program& program);
    void begin(const Pass& pass, std::uint32_t framebuffer);
    void finish_frame();
    void draw_part(const DrawMesh& mesh, const DrawPart& part);
    void draw_fronts(const DrawMesh& mesh, const DrawPart& part, const glm::mat4& clip_from_stored);
    void update_moving_meshes();
    void draw_passes(const View& view, PassTimer* timer);

    gl::EntryPoints& gl_;
    const gl::Caps& caps_;
    RendererDescription description_;
    gl::ProgramCache programs_;
    FramePlan plan_;
    const Scene* scene_ = nullptr;
    std::vector<DrawMesh> meshes_;
    std::unique_ptr<RenderTargets> targets_;
    gl::Buffer triangle_;  ///< over the whole target
    gl::VertexArray triangle_array_;
    gl::VertexArray loose_array_;  ///< core desktop profile: something must be bound while buffers are set up
    DrawState state_;
    std::unique_ptr<TextureStore> textures_;
    std::unique_ptr<MovingMeshes> moving_;  ///< nothing while the scene has nothing that changes its shape
    struct Work {
        std::string effect;
        std::unique_ptr<EffectWork> work;
    };
    struct Adoption {
        std::uint32_t program;
        EffectWork* work;
        int adopted;
    };
    struct NotedUse {
        std::uint32_t program;
        ProgramUse use;
        std::unordered_set<std::string> users;  ///< those of `use`, to be found among many
    };
    /// A program that program() was asked for, by what it was asked with.
    struct AskedProgram {
        const EffectCard* card;
        int variant;
        std::vector<std::string> defines;
        gl::Program* program;
    };
    std::vector<AskedProgram> asked_programs_;  ///< since prepare() began
    std::vector<NotedUse> uses_;
    MaterialChanges changes_;  ///< empty: every material is drawn as it is
    std::vector<Work> works_;  ///< one for each effect that draws or inserts
    std::vector<Adoption> adoptions_;
    const View* view_ = nullptr;  ///< of the frame being drawn
    std::vector<EffectWork*> work_of_pass_;
    std::size_t texture_bytes_ = 0;
    std::size_t own_texture_bytes_ = 0;
    std::vector<std::string> notices_;
    std::int64_t unflushed_triangles_ = 0;  ///< of the pass being drawn
    std::uint32_t first_error_ = 0;
};

}  // namespace halfframe
