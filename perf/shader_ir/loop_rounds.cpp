// Looks for a comparison of the loop's counter with a number, and for the counter's start and step.
#include "perf/shader_ir/loop_rounds.h"

#include <algorithm>
#include <cmath>

namespace halfframe::shader_ir {
namespace {

/// Instructions that loops may become when written out. A device's compiler stops long before.
constexpr double kMostUnrolled = 16384.0;

std::optional<double> literal(const Module& module, Id id) {
    const auto found = module.constants.find(id);
    return found != module.constants.end() && found->second.scalars.size() == 1
               ? std::optional<double>(found->second.scalars[0])
               : std::nullopt;
}

/// What is added to `phi` to make `next`.
std::optional<double> step_of(const Module& module, const Function& function, Id next, Id phi) {
    for (const Block& block : function.blocks) {
        for (const Instruction& one : block.instructions) {
            if (one.result != next) continue;
            const bool adds = one.op == spv::OpIAdd || one.op == spv::OpFAdd;
            const bool subtracts = one.op == spv::OpISub || one.op == spv::OpFSub;
            if (!adds && !subtracts) return std::nullopt;
            if (one.operands[0] == phi) {
                const auto by = literal(module, one.operands[1]);
                return by && subtracts ? std::optional<double>(-*by) : by;
            }
            if (adds && one.operands[1] == phi) return literal(module, one.operands[0]);
        }
    }
    return std::nullopt;
}

enum class Comparison { none, below, up_to, above, down_to, unequal };

Comparison comparison_of(spv::Op op) {
    switch (op) {
        case spv::OpSLessThan:
        case spv::OpULessThan:
        case spv::OpFOrdLessThan: return Comparison::below;
        case spv::OpSLessThanEqual:
        case spv::OpULessThanEqual:
        case spv::OpFOrdLessThanEqual: return Comparison::up_to;
        case spv::OpSGreaterThan:
        case spv::OpUGreaterThan:
        case spv::OpFOrdGreaterThan: return Comparison::above;
        case spv::OpSGreaterThanEqual:
        case spv::OpUGreaterThanEqual:
        case spv::OpFOrdGreaterThanEqual: return Comparison::down_to;
        case spv::OpINotEqual: return Comparison::unequal;
        default: return Comparison::none;
    }
}

std::optional<double> rounds_of(Comparison comparison, double start, double end, double step) {
    const bool upwards = comparison == Comparison::below || comparison == Comparison::up_to;
    const bool closed = comparison == Comparison::up_to || comparison == Comparison::down_to;
    if (comparison != Comparison::unequal && (upwards ? step <= 0.0 : step >= 0.0)) return std::nullopt;
    if (comparison == Comparison::unequal && (step == 0.0 || (end - start) / step < 0.0)) return std::nullopt;
    const double steps = (end - start) / step;
    const double slack = 1e-9 * std::max(1.0, std::abs(steps));  // a step like 0.1 is no binary number
    return std::max(0.0, closed ? std::floor(steps + slack) + 1.0 : std::ceil(steps - slack));
}

std::optional<double> rounds_by(const Module& module, const Function& function, std::size_t header,
                                const Instruction& compare) {
    const Comparison comparison = comparison_of(compare.op);
    if (comparison == Comparison::none) return std::nullopt;
    const auto end = literal(module, compare.operands.at(1));
    if (!end) return std::nullopt;
    for (const Instruction& phi : function.blocks[header].instructions) {
        if (phi.op != spv::OpPhi || phi.result != compare.operands[0]) continue;
        std::optional<double> start, step;
        for (std::size_t i = 0; i < phi.operands.size(); i += 2) {
            if (const auto value = literal(module, phi.operands[i])) start = value;
            else step = step_of(module, function, phi.operands[i], phi.result);
        }
        if (start && step) return rounds_of(comparison, *start, *end, *step);
    }
    return std::nullopt;
}

struct SeenLoop {
    std::size_t header;
    std::size_t merge;
    double rounds;  ///< 1 where they are not known
};

}  // namespace

std::optional<double> written_rounds(const Module& module, const Function& function, std::size_t header,
                                     std::size_t merge) {
    std::optional<double> rounds;
    for (std::size_t at = header; at < std::max(merge, header + 1) && at < function.blocks.size(); ++at)
        for (const Instruction& one : function.blocks[at].instructions)
            if (const auto found = rounds_by(module, function, header, one))
                rounds = rounds ? std::min(*rounds, *found) : found;
    return rounds;
}

std::vector<bool> loops_to_unroll(const Module& module) {
    std::vector<bool> answers;
    for (const Function& function : module.functions) {
        std::vector<SeenLoop> loops;
        for (std::size_t at = 0; at < function.blocks.size(); ++at) {
            for (const Instruction& one : function.blocks[at].instructions) {
                if (one.op != spv::OpLoopMerge) continue;
                const std::size_t merge = function.block_at.at(one.operands.at(0));
                loops.push_back({at, merge, written_rounds(module, function, at, merge).value_or(1.0)});
            }
        }
        for (const SeenLoop& loop : loops) {
            double instructions = 0.0;
            for (std::size_t at = loop.header; at < std::max(loop.merge, loop.header + 1); ++at)
                instructions += static_cast<double>(function.blocks[at].instructions.size());
            for (const SeenLoop& around : loops)
                if (around.header <= loop.header && loop.header < around.merge) instructions *= around.rounds;
            answers.push_back(instructions <= kMostUnrolled);
        }
    }
    return answers;
}

}  // namespace halfframe::shader_ir
