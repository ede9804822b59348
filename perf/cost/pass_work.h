// What a pass asks of a device: the dynamic counts that the model turns into milliseconds.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/gl/pixel_format.h"
#include "perf/cost/shader_counts.h"

namespace halfframe::cost {

/// What one fetch brings, as texture units see it.
enum class TexelFormat : std::uint8_t {
    narrow,       ///< 32 bits a texel or fewer, whole numbers; depth
    packed,       ///< 10:10:10:2
    small_float,  ///< 11:11:10 floats
    half_float,   ///< four fp16
    full_float,   ///< four fp32
};
[[nodiscard]] TexelFormat texel_format(gl::PixelFormat format);
[[nodiscard]] const char* name(TexelFormat format);

struct FetchWork {
    double count = 0.0;  ///< a fragment
    TexelFormat format = TexelFormat::narrow;
    SamplerUse::Shape shape = SamplerUse::Shape::flat;
    bool trilinear = false;
    bool target = false;  ///< the texture was drawn earlier: a device may store it otherwise
};

/// One fragment's work along one way through the shader.
struct FragmentWork {
    Work work;
    std::vector<FetchWork> fetches;
};

enum class Way : std::uint8_t { weighted, shortest, longest };

struct DrawWork {
    double fragments_shaded = 0.0;   ///< that pass the depth test, discarded ones among them
    double fragments_written = 0.0;  ///< samples that reach the target
    double vertices = 0.0;           ///< run through the vertex stage, those in the post-transform cache aside
    double triangles = 0.0;
    std::array<FragmentWork, 3> fragment = {};  ///< by Way
    Temporaries temporaries;
    Work vertex;
    int attributes = 0;
    bool blends = false;
    bool additive = false;  ///< of blends: source + destination
    bool writes_color = true;
    bool writes_depth = false;
    bool tests_depth = false;
};

struct TargetWork {
    int width = 0;
    int height = 0;
    int samples = 1;
    gl::PixelFormat format = gl::PixelFormat::rgba8;
    bool loaded = false;    ///< the pass starts with what was there
    bool stored = true;     ///< something later needs what the pass leaves
    bool resolved = false;  ///< leaves the memory on the chip behind this pass
    [[nodiscard]] double pixels() const { return static_cast<double>(width) * height; }
};

struct PassWork {
    std::string name;
    std::vector<DrawWork> draws;
    std::optional<TargetWork> color;
    std::optional<TargetWork> depth;
    double texture_bytes = 0.0;   ///< distinct bytes that are fetched
    bool switches_target = true;  ///< the pass before drew into others
    int copies = 0;               ///< of `draws`: copies between targets, which no shader sees
    int programs = 0;             ///< distinct ones of `draws`
    [[nodiscard]] int resolves() const { return (color && color->resolved) + (depth && depth->resolved); }
};

/// Sums over the draws of a pass, or of several.
struct WorkSum {
    double draws = 0.0;  ///< without copies
    double vertices = 0.0;
    double triangles = 0.0;
    double fragments_shaded = 0.0;
    double samples_written = 0.0;
    double target_switches = 0.0;
    double resolves = 0.0;
    Temporaries most;  ///< of any draw
    void add(const PassWork& pass);
};

}  // namespace halfframe::cost
