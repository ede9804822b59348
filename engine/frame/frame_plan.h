// A frame is data first: what is drawn into what, in which order, and for every effect the sentence why.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/frame/effect_card.h"
#include "engine/frame/scene.h"
#include "engine/frame/texture_storage.h"
#include "engine/frame/tier.h"
#include "engine/frame/vertex_storage.h"
#include "engine/gl/caps.h"

namespace halfframe {

/// What the user wishes; empty optionals let the plan choose the best the device can do.
struct Wishes {
    std::optional<Tier> tier;                                   ///< empty: console where it runs, else low
    std::vector<std::pair<std::string, Tier>> effect_tiers;     ///< --tier EFFECT=T
    std::vector<std::pair<std::string, bool>> effect_switches;  ///< --set EFFECT.on=0|1: overrules the demand predicate
    std::optional<Arithmetic> arithmetic;                       ///< empty: automatic
    std::optional<gl::PixelFormat> storage;                     ///< empty: light only where something reads it
    bool reads_light = false;                                   ///< scene_color is read back as linear light (.exr)
    bool census = false;  ///< every colour target RGBA32F, to count NaN and inf, in light where the tier can store it
    VertexPrecision vertices = VertexPrecision::half;  ///< bits of positions, directions, UVs and colours
    std::optional<TextureCompression> textures;        ///< empty: what the device profile says, else none
    /// Only the view that the plan is made for is drawn: what it does not see may be left out.
    bool fixed_view = false;
};

/// A texture that passes write and read.
struct Target {
    std::string name;  ///< "scene_color", "depth", "display"
    gl::PixelFormat format = gl::PixelFormat::rgba8;
    int width = 0;
    int height = 0;
    bool fixed_size = false;  ///< its size does not follow the picture's (a shadow map): not among the bytes a pixel
    bool filtered = false;    ///< sampled with linear filtering; else nearest
    int samples = 1;          ///< a pixel; above 1 it is resolved into another target before a pass samples it
    bool compared = false;    ///< depth only: a texture that later passes compare with (ES 3.0); else never sampled
    [[nodiscard]] std::size_t bytes() const {
        return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
               static_cast<std::size_t>(gl::bytes_per_pixel(format) * samples);
    }
};

enum class StartAction : std::uint8_t { keep, clear, discard };

/// Where in the frame a pass stands. Effects choose a place; passes of one place keep the order of the list of effects.
enum class PassOrder : std::uint8_t { shadow, depth, opaque, sky, ground, transparent, resolve, post, display, finish };

struct Pass {
    std::string name;    ///< "surface"; also the ledger's and the debugger's name
    std::string effect;  ///< the card that draws it
    int phase = 0;       ///< told to the effect: which of its passes
    PassOrder order = PassOrder::opaque;
    std::vector<int> reads;       ///< targets sampled
    std::optional<int> resolves;  ///< multisampled target whose samples are averaged into `color`
    std::optional<int> color;     ///< target written
    std::optional<int> depth;     ///< depth target bound
    bool writes_color = true;     ///< false: bound and perhaps cleared, but masked
    bool blends = false;          ///< mixes what it draws with what `color` holds
    bool writes_depth = false;
    StartAction start_color = StartAction::keep;
    StartAction start_depth = StartAction::keep;
    glm::vec4 clear_color{0.0f};
    bool full_screen = false;  ///< its cost is width x height fragments, by arithmetic
};

struct EffectDecision {
    std::string effect;
    bool in = false;
    Tier tier = Tier::console;
    std::string why;                        ///< one sentence, for in as for out
    std::vector<gl::Insertion> insertions;  ///< code it adds to other effects' shaders; mostly empty
};

struct FramePlan {
    std::string scene;
    int width = 0;
    int height = 0;
    float exposure = 1.0f;  ///< of the view it was made for; what is stored is scaled for it
    Tier tier = Tier::console;
    Arithmetic arithmetic = Arithmetic::full;
    gl::PixelFormat storage = gl::PixelFormat::rgba16f;  ///< of scene_color
    std::string why_storage;                             ///< what decided it: "transparent blends light"
    bool census = false;
    bool fixed_view = false;  ///< Wishes::fixed_view
    VertexPrecision vertices = VertexPrecision::half;
    TextureCompression textures = TextureCompression::none;
    /// Limit on the bytes a pixel of all targets together: the tier's, or none when the storage was asked for by name.
    std::optional<double> bytes_per_pixel_limit;
    std::vector<Target> targets;
    std::vector<Pass> passes;
    std::vector<EffectDecision> effects;  ///< one for every card, in the order of the list
    std::vector<std::string> notices;     ///< what was wished and not realised, and why
    int display = -1;                     ///< the target that holds the picture

    [[nodiscard]] std::size_t target_bytes() const;
    [[nodiscard]] double bytes_per_pixel() const;
    [[nodiscard]] const EffectDecision* find(std::string_view effect) const;
    [[nodiscard]] int target_index(std::string_view target) const;  ///< -1: none

    /// Index of the target called `target_name`, made with `format` at the size of the frame when it is new.
    int add_target(std::string_view target_name, gl::PixelFormat format);
    /// Index of the target of that name, made as described when it is new.
    int add_target(Target target);
    /// The target that surfaces and sky are drawn into, and the depth beside it; made when new.
    int add_scene_color();
    int add_scene_depth();
    gl::PixelFormat depth_format = gl::PixelFormat::depth24;
};

/// Is `storage` the 8-bit end of the ladder, where materials store display values themselves?
[[nodiscard]] inline bool holds_display_values(gl::PixelFormat storage) { return storage == gl::PixelFormat::rgba8; }

/// Plans a frame. Storage: as wished by name; low stores display values, reference the most precise light. Console
/// stores light where a pass other than the one that maps it reads, blends or averages it, and else lets every shader
/// map its own light: the same picture within a code, without a float target and the pass over it. Pure: the same
/// arguments give the same plan, and nothing is drawn, opened or allocated on a device. A wish the device cannot meet
/// (full without fragment highp, a tier above its version, a storage that does not render when asked for by name)
/// throws Error(usage) with the sentence why and what to try.
[[nodiscard]] FramePlan plan_frame(const Scene& scene, const View& view, const Wishes& wishes, const gl::Caps& caps,
                                   std::span<const EffectCard* const> cards);

/// The rule a plan breaks, as a sentence, or nothing: a target read before it is written, sampled while bound, over the
/// bytes a pixel of its tier, larger than the device allows, without a display, or a format that does not render.
[[nodiscard]] std::optional<std::string> broken_rule(const FramePlan& plan, const gl::Caps& caps);

}  // namespace halfframe
