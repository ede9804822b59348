// How often a loop runs, where its text says so.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "perf/shader_ir/module.h"

namespace halfframe::shader_ir {

/// Rounds of `for (i = a; i < b; i += c)` with numbers for a, b, c, also downwards; the fewest where several conditions
/// say something. `header` and `merge` are blocks of `function`. Nothing: the text does not say.
[[nodiscard]] std::optional<double> written_rounds(const Module& module, const Function& function, std::size_t header,
                                                   std::size_t merge);

/// For each OpLoopMerge of the module, in the order of the words: is the loop, with those around it, small enough to be
/// written out? One of unknown rounds is: no compiler can write it out.
[[nodiscard]] std::vector<bool> loops_to_unroll(const Module& module);

/// Where a block may go on, by its terminator.
[[nodiscard]] std::vector<Id> targets_of(const Instruction& terminator);

/// Lines of loops that main may enter and that no condition, return or discard ends, as far as the text tells: of a
/// module as glslang writes it, for what cannot be left is cleaned away.
[[nodiscard]] std::vector<std::uint32_t> endless_loops(const Module& module);

}  // namespace halfframe::shader_ir
