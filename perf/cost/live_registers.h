// How many vec4 temporaries are alive at once.
#pragma once

#include "perf/cost/shader_counts.h"
#include "perf/cost/values.h"

namespace halfframe::cost {

/// The place with the most temporaries alive, half ones as half. Instructions stay in the order of the SPIR-V; scalars
/// and pairs fill the free components of vectors of their precision, as an allocator does that never fails.
[[nodiscard]] Temporaries live_temporaries(const Module& module, const Values& values,
                                           const shader_ir::Function& function);

}  // namespace halfframe::cost
