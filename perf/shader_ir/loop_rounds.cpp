// Looks for a comparison of the loop's counter with a number, and for the counter's start and step.
#include "perf/shader_ir/loop_rounds.h"

#include <algorithm>
#include <cmath>
#include <set>

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

std::vector<Id> targets_of(const Instruction& terminator) {
    switch (terminator.op) {
        case spv::OpBranch: return {terminator.operands.at(0)};
        case spv::OpBranchConditional: return {terminator.operands.at(1), terminator.operands.at(2)};
        case spv::OpSwitch: {
            std::vector<Id> targets{terminator.operands.at(1)};
            for (std::size_t i = 3; i < terminator.operands.size(); i += 2) targets.push_back(terminator.operands[i]);
            return targets;
        }
        default: return {};
    }
}

namespace {

/// Of a branch whose condition is a number of the text only the side that it takes.
std::vector<Id> possible_targets(const Module& module, const Instruction& terminator) {
    if (terminator.op != spv::OpBranchConditional) return targets_of(terminator);
    const auto known = literal(module, terminator.operands.at(0));
    return known ? std::vector<Id>{terminator.operands.at(*known != 0.0 ? 1 : 2)} : targets_of(terminator);
}

/// Does a way lead from `header` to the block `merge`, or out of the function?
bool can_end(const Module& module, const Function& function, std::size_t header, std::size_t merge) {
    std::set<std::size_t> seen{header};
    std::vector<std::size_t> open{header};
    while (!open.empty()) {
        const Instruction& terminator = function.blocks[open.back()].instructions.back();
        open.pop_back();
        if (terminator.op == spv::OpReturn || terminator.op == spv::OpReturnValue || terminator.op == spv::OpKill)
            return true;
        for (const Id target : possible_targets(module, terminator)) {
            const std::size_t to = function.block_at.at(target);
            if (to == merge) return true;
            if (seen.insert(to).second) open.push_back(to);
        }
    }
    return false;
}

std::vector<const Function*> called_by_main(const Module& module) {
    std::vector<const Function*> called;
    const auto call = [&](const Function& function) {
        if (std::ranges::find(called, &function) == called.end()) called.push_back(&function);
    };
    for (const Function& function : module.functions)
        if (function.name == "main" || function.name == "main(") call(function);
    for (std::size_t i = 0; i < called.size(); ++i)
        for (const Block& block : called[i]->blocks)
            for (const Instruction& one : block.instructions)
                if (one.op == spv::OpFunctionCall) call(module.function(one.operands.at(0)));
    return called;
}

}  // namespace

std::vector<std::uint32_t> endless_loops(const Module& module) {
    std::vector<std::uint32_t> lines;
    for (const Function* function : called_by_main(module)) {
        for (std::size_t at = 0; at < function->blocks.size(); ++at) {
            for (const Instruction& one : function->blocks[at].instructions) {
                if (one.op != spv::OpLoopMerge) continue;
                if (!can_end(module, *function, at, function->block_at.at(one.operands.at(0))))
                    lines.push_back(one.line);
            }
        }
    }
    return lines;
}

}  // namespace halfframe::shader_ir
