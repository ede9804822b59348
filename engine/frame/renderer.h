// Owns programs and targets; draws a plan. The only user of GL besides the effects' own .cpp files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "engine/error.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/image.h"
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
};

/// Counts of non-finite values in one target.
struct CensusRow {
    std::string target;
    std::uint64_t values = 0;  ///< channels looked at
    std::uint64_t nan = 0;
    std::uint64_t inf = 0;
    std::uint64_t negative = 0;  ///< values below 0 (reported, not a failure)
};

/// What drawing does with the colour that is there already.
enum class Blend : std::uint8_t {
    none,      ///< replaces it
    alpha,     ///< source alpha over destination
    add,       ///< source + destination
    multiply,  ///< source * destination
    screen,    ///< source + destination * (1 - source), for display values
};

/// Texture units, told apart so that neighbours in a list of draws share bindings. 8 is the minimum of ES 2.0.
enum TextureUnit : int {
    kBaseColorUnit = 0,  ///< surface's; also the first source of a full-screen pass
    kMetallicRoughnessUnit = 1,
    kNormalUnit = 2,
    kEmissiveUnit = 3,
    kReflectionUnit = 4,  ///< environment
    kRoughReflectionUnit = 5,
    kShadowUnit = 6,
    kBloomUnit = 7,
};

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
    /// Device texture of a scene texture, uploaded once for each use.
    [[nodiscard]] std::uint32_t texture(const Texture& texture, const TextureUse& use);
    /// The same for packed_surface_map() of two textures that are sampled alike.
    [[nodiscard]] std::uint32_t packed_texture(const Texture& normals, const Texture& metallic_roughness);
    /// Bytes of every texture on the device, mip levels included.
    [[nodiscard]] std::size_t texture_bytes() const { return texture_bytes_ + own_texture_bytes_; }
    /// Adds a texture that an effect has uploaded itself to that sum.
    void count_texture_bytes(std::size_t bytes) { own_texture_bytes_ += bytes; }
    /// The tier the plan gave to an effect.
    [[nodiscard]] Tier tier_of(std::string_view effect) const;
    /// The program of a card's variant at the plan's tier and arithmetic, with the insertions other effects make in it.
    gl::Program& program(const EffectCard& card, int variant, std::span<const std::string_view> defines);
    gl::ProgramCache& programs() { return programs_; }
    void add_notice(std::string sentence) { notices_.push_back(std::move(sentence)); }
    /// What preparing found worth saying: program cache folder not writable, lights left out, textures made smaller.
    [[nodiscard]] std::vector<std::string> notices() const;

    // For effects, while drawing: no allocation, no repeated call for a state that is set already.
    void use(const gl::Program& program);
    void bind_texture(int unit, std::uint32_t texture);
    void bind_cube(int unit, std::uint32_t texture);
    [[nodiscard]] std::uint32_t target_texture(int target_index) const;
    /// Averages the samples of a multisampled target into `to_target`, which the pass being drawn writes.
    void resolve(int from_target, int to_target);
    void draw_full_screen();  ///< one triangle over the target; attribute kPosition is the clip position (vec2)
    void draw_mesh(const DrawMesh& mesh);
    void set_depth(bool test, bool write, std::uint32_t function);
    void set_cull(bool on);
    void set_blend(Blend blend);
    void set_color_mask(bool on);

private:
    struct Targets;
    struct State;
    void allocate_targets();
    void attach(const gl::Framebuffer& framebuffer, const Pass& pass);
    void make_works();
    void bind(std::uint32_t target, int unit, std::uint32_t texture);
    EffectWork* work_of(const std::string& effect);
    void adopt_insertions(const std::string& prefix, gl::Program& program);
    void begin(const Pass& pass, std::uint32_t framebuffer);
    void finish_frame();
    void enable_attributes(unsigned wanted);
    void draw_passes(const View& view, PassTimer* timer);

    gl::EntryPoints& gl_;
    const gl::Caps& caps_;
    RendererDescription description_;
    gl::ProgramCache programs_;
    FramePlan plan_;
    const Scene* scene_ = nullptr;
    std::vector<DrawMesh> meshes_;
    std::unique_ptr<Targets> targets_;
    std::unique_ptr<State> state_;
    std::unique_ptr<TextureStore> textures_;
    struct Work {
        std::string effect;
        std::unique_ptr<EffectWork> work;
    };
    struct Adoption {
        std::uint32_t program;
        EffectWork* work;
        int adopted;
    };
    std::vector<Work> works_;  ///< one for each effect that draws or inserts
    std::vector<Adoption> adoptions_;
    const View* view_ = nullptr;  ///< of the frame being drawn
    std::vector<EffectWork*> work_of_pass_;
    std::size_t texture_bytes_ = 0;
    std::size_t own_texture_bytes_ = 0;
    std::vector<std::string> notices_;
    std::uint32_t first_error_ = 0;
};

}  // namespace halfframe
