// The ways through a stage: the shortest, the longest, and how often each block runs on average.
#pragma once

#include <string>
#include <vector>

#include "perf/shader_ir/module.h"

namespace halfframe::cost {

/// How often each block runs, by its place in the function.
struct BlockRuns {
    std::vector<double> shortest;  ///< 0 or 1
    std::vector<double> longest;   ///< 0, 1 or the rounds of its loops
    std::vector<double> weighted;
    int branches = 0;
    std::vector<std::string> notices;
};

/// `cost` of each block decides which way is short. Loops that the optimizer left run once on the shortest way and
/// their full count on the longest, kUnknownRounds where the text does not give a count; a loop that can be left early
/// runs half its rounds on average.
[[nodiscard]] BlockRuns runs_of(const shader_ir::Module& module, const shader_ir::Function& function,
                                const std::vector<double>& cost);

}  // namespace halfframe::cost
