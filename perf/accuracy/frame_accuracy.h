// How far apart the frames of a pair are on a real context.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/frame/frame_plan.h"
#include "engine/frame/renderer.h"
#include "perf/accuracy/frame_cases.h"

namespace halfframe::accuracy {

struct FrameAccuracy {
    std::string kind;
    std::string change;
    Tier tier = Tier::console;
    Arithmetic arithmetic = Arithmetic::full;
    gl::PixelFormat storage = gl::PixelFormat::rgba16f;
    Relation relation = Relation::same;
    int max_channel_error = 0;  ///< [1/255]; of Relation::never_darker: the most that is missing
    double bad_fraction = 0.0;  ///< pixels with an error, 0..1
    double covered = 0.0;       ///< share of pixels of the changed picture that surfaces decide, 0..1
    std::uint64_t census_values = 0;
    std::uint64_t not_finite =
        0;  ///< NaN and inf in all colour targets of the changed frame, drawn once more as RGBA32F
    FrameBound bound;
    Picture plain;  ///< the parts that were compared
    Picture changed;
    std::vector<std::string> violations;  ///< a sentence for every demand that does not hold
};

/// Draws pairs on one context; programs are shared by all of them.
class FrameBench {
public:
    /// `gl` and `caps` outlive the bench.
    FrameBench(gl::EntryPoints& gl, const gl::Caps& caps, std::span<const EffectCard* const> cards = all_effects());

    /// Draws both frames of the pair, the changed one also without its surfaces and as a census, and judges.
    /// Error(usage) where the device cannot have the tier or the arithmetic.
    [[nodiscard]] FrameAccuracy measure(const FrameCase& pair, Tier tier, Arithmetic arithmetic);

private:
    Picture draw(const Shot& shot, const Wishes& wishes);

    const gl::Caps& caps_;
    std::span<const EffectCard* const> cards_;
    Renderer renderer_;
};

}  // namespace halfframe::accuracy
