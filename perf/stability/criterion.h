// How wrong a function may be in a narrow format: what its condition makes unavoidable, and a little for its own steps.
#pragma once

#include <map>
#include <vector>

#include "perf/stability/subject.h"

namespace halfframe::stability {

/// The two kinds of narrow format, by what they do near 0.
enum class Format : std::uint8_t {
    gradual,  ///< subnormals kept: float, half
    flushed,  ///< nothing between 0 and 2^-14: half_flushed, es_minimum
};
[[nodiscard]] Format format_of(shader_ir::Model model);

/// Errors that cannot be helped once inputs are rounded are multiplied by this.
inline constexpr double kConditionFactor = 4.0;
/// Steps of the result that its own operations may cost, whatever the condition.
inline constexpr double kResultSteps = 2.0;

/// The distance of neighbouring numbers at x: of half, of a flushed half, or of fp32 where `full`.
[[nodiscard]] double step_at(double x, Format format, bool full);

struct Allowed {
    shader_ir::Columns truth;     ///< the function in double
    shader_ir::Columns error;     ///< allowed, per scalar and lane
    std::vector<bool> near_jump;  ///< an input's rounding may carry a lane over a declared jump
};

/// The criterion over a batch: 4 times the sum, over all components of the inputs, of what half a step of that
/// component's own precision does to the result in double, plus 2 steps of the result. A component that is flushed, or
/// cut off at the end of the format, counts with all that it loses. Where the truth is past the format's end, what the
/// clamp takes is allowed too.
[[nodiscard]] Allowed allowed_errors(const Subject& subject, const Batch& batch, shader_ir::Model model);

/// The criterion of every model over one batch, each worked out once, with what exemptions allow.
class Criteria {
public:
    Criteria(const Subject& subject, const Batch& batch);
    [[nodiscard]] const Allowed& of(shader_ir::Model model) const;

private:
    std::map<shader_ir::Model, Allowed> allowed_;
};

}  // namespace halfframe::stability
