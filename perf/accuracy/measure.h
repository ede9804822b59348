// How far a shader function is from its reference, and what each arithmetic does to it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "perf/accuracy/function_list.h"
#include "perf/measure/precision_probe.h"
#include "perf/shader_ir/precision.h"

namespace halfframe::accuracy {

/// The models that stand beside double, in the order of FunctionAccuracy::arithmetic.
inline constexpr std::array kArithmetics{shader_ir::Model::in_float, shader_ir::Model::half,
                                         shader_ir::Model::half_flushed, shader_ir::Model::es_minimum};

/// The bound of `entry` for one of kArithmetics.
[[nodiscard]] const Bound& bound_of(const FunctionEntry& entry, shader_ir::Model model);

/// The distance of two sets of results, over all lanes and scalars, in the unit of the entry.
struct Gap {
    double largest = 0.0;
    double p99 = 0.0;  ///< 99 of 100 errors are at most this
    /// The lane of the largest error; of the first result that is not finite, if there is one.
    std::size_t worst_lane = 0;
    std::size_t not_finite = 0;  ///< results that are NaN or infinite; they are in no other figure
};

/// The function on a real context against the shader in double.
struct HereGaps {
    std::optional<Gap> mediump;  ///< nothing where the entry's arithmetic is full: no operation is mediump then
    Gap highp;
    Bound mediump_bound;
    Bound highp_bound;
};

struct FunctionAccuracy {
    FunctionEntry entry;
    std::vector<Argument> arguments;
    std::size_t lanes = 0;
    shader_ir::Columns in_double;                     ///< what the shader says, one array per scalar of the result
    Gap method;                                       ///< the shader in double against the reference
    std::array<Gap, kArithmetics.size()> arithmetic;  ///< the shader in each model against the shader in double
    std::optional<HereGaps> here;                     ///< after measure_here()
    std::vector<std::string> violations;              ///< a sentence for every bound that does not hold
};

/// Compiles the entry's files and evaluates the function in all five models. The same input gives the same figures to
/// the last bit on one C library. Error(check) for a shader that does not compile. Mistake: a reference that is not
/// finite inside the domain, or an entry that does not fit its function.
[[nodiscard]] FunctionAccuracy measure(const FunctionEntry& entry);

/// Draws the function over the same inputs, in the entry's arithmetic and in full, and adds `here` and what it
/// violates. The context takes LaneCanvas::obstacle() to be empty. `probe` says what mediump is on it.
void measure_here(FunctionAccuracy& function, gl::EntryPoints& gl, const gl::Caps& caps,
                  const perf::PrecisionProbe& probe);

}  // namespace halfframe::accuracy
