// What a frame costs on every device asked for: passes, rows of effects, half against full.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "perf/cost/counted_frame.h"
#include "perf/cost/model.h"

namespace halfframe::cost {

/// An effect in a frame: its own passes without what others add to them, and what it adds to others' passes.
struct EffectCost {
    std::string effect;
    int passes = 0;  ///< of its own; 0: it only adds code to others'
    double ms = 0.0;
    double marginal_ms = 0.0;  ///< the part of `ms` in others' passes: the surface with it less the surface without
    double other_ms = 0.0;     ///< `ms` in the other arithmetic
    std::string bound;         ///< of the pass that takes most of it
};

struct DeviceCost {
    Profile profile;
    std::vector<PassCost> passes;        ///< in the arithmetic asked for, one for each pass of the plan
    std::vector<PassCost> other_passes;  ///< in the other arithmetic
    std::vector<EffectCost> effects;     ///< those in the frame, in the plan's order
    [[nodiscard]] const EffectCost* find(const std::string& effect) const;
    [[nodiscard]] double frame_ms(double PassCost::*kind = &PassCost::ms) const;
    [[nodiscard]] double other_frame_ms() const;
};

struct FrameCost {
    std::string scene;
    std::string camera;  ///< of the scene; empty: one without a name, or none of its own
    gl::Arithmetic arithmetic = gl::Arithmetic::half;
    FramePlan plan;
    std::vector<PassWork> works;
    std::vector<PassWork> other_works;
    std::vector<DeviceCost> devices;
    std::vector<std::string> notices;
    std::string compiler;
    int programs = 0;  ///< distinct ones that drew
    std::size_t texture_bytes = 0;
    [[nodiscard]] WorkSum sum() const;  ///< of all passes
    /// "street, rooftop": what people call it.
    [[nodiscard]] std::string title() const { return camera.empty() ? scene : scene + ", camera " + camera; }
};

[[nodiscard]] FrameCost frame_cost(const CountedFrame& frame, ShaderLibrary& library, gl::Arithmetic arithmetic,
                                   const std::vector<Profile>& profiles);

/// The words that stand under every report.
inline constexpr const char* kModelledWords =
    "Modelled, not measured: the formulas and constants of perf/cost/README.md over counts of the compiled shaders and "
    "of one drawn frame. The price of half against full is modelled too: no mediump hardware was measured.";

}  // namespace halfframe::cost
