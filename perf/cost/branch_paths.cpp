// Blocks stand in an order in which each comes after those that lead to it, save the ends of loops: one walk forwards
// gives the weights, one walk backwards the shortest and the longest way.
#include "perf/cost/branch_paths.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "engine/error.h"
#include "perf/cost/shader_counts.h"
#include "perf/shader_ir/loop_rounds.h"

namespace halfframe::cost {
namespace {

using shader_ir::Block;
using shader_ir::Function;
using shader_ir::Id;
using shader_ir::Instruction;
using shader_ir::Module;
using shader_ir::targets_of;

struct Loop {
    std::size_t header = 0;
    std::size_t merge = 0;
    double most_rounds = kUnknownRounds;
    double mean_rounds = kUnknownRounds;
};

class Ways {
public:
    Ways(const Module& module, const Function& function, const std::vector<double>& cost)
        : module_(module), function_(function), cost_(cost), count_(function.blocks.size()) {
        find_loops();
        find_ways();
    }

    BlockRuns run() {
        BlockRuns runs{.shortest = follow(false), .longest = follow(true), .weighted = weights()};
        for (std::size_t at = 0; at < count_; ++at)
            if (ways_[at].size() > 1 && !is_loop_exit(at)) ++runs.branches;
        runs.notices = notices_;
        return runs;
    }

private:
    void find_loops() {
        for (std::size_t at = 0; at < count_; ++at) {
            for (const Instruction& one : function_.blocks[at].instructions) {
                if (one.op != spv::OpLoopMerge) continue;
                Loop loop{.header = at, .merge = function_.block_at.at(one.operands.at(0))};
                count_rounds(loop, one.line);
                loops_.push_back(loop);
            }
        }
    }

    void count_rounds(Loop& loop, std::uint32_t line) {
        const std::optional<double> rounds = shader_ir::written_rounds(module_, function_, loop.header, loop.merge);
        int exits = 0;
        for (std::size_t at = loop.header; at < std::max(loop.merge, loop.header + 1) && at < count_; ++at)
            for (const Id target : targets_of(function_.blocks[at].instructions.back()))
                if (function_.block_at.at(target) == loop.merge) ++exits;
        loop.most_rounds = rounds.value_or(kUnknownRounds);
        loop.mean_rounds = exits > 1 ? 0.5 * (loop.most_rounds + 1.0) : loop.most_rounds;
        notices_.push_back(rounds ? fmt::format("{}: a loop of at most {} rounds stays a loop; {} on average",
                                                module_.place(line), *rounds, loop.mean_rounds)
                                  : fmt::format("{}: the rounds of a loop are not known; taken as {}, {} on average",
                                                module_.place(line), kUnknownRounds, loop.mean_rounds));
    }

    /// The way back to a header is the way out of the loop: rounds are counted apart.
    void find_ways() {
        ways_.resize(count_);
        for (std::size_t at = 0; at < count_; ++at) {
            for (const Id target : targets_of(function_.blocks[at].instructions.back())) {
                std::size_t to = function_.block_at.at(target);
                if (to <= at) {
                    const auto loop = std::ranges::find(loops_, to, &Loop::header);
                    expect(loop != loops_.end(), "a branch leads back to a block that begins no loop");
                    to = loop->merge;
                }
                if (std::ranges::find(ways_[at], to) == ways_[at].end()) ways_[at].push_back(to);
            }
        }
    }

    [[nodiscard]] bool is_inside(std::size_t at, const Loop& loop) const {
        return at >= loop.header && at < loop.merge;
    }
    [[nodiscard]] double rounds(std::size_t at, bool most) const {
        double product = 1.0;
        for (const Loop& loop : loops_)
            if (is_inside(at, loop)) product *= most ? loop.most_rounds : loop.mean_rounds;
        return product;
    }
    /// From `at`, inside a loop, to a block behind it, or to one that only leads there: a break.
    [[nodiscard]] bool leaves(std::size_t at, std::size_t to) const {
        return std::ranges::any_of(loops_, [&](const Loop& loop) {
            if (!is_inside(at, loop)) return false;
            for (; to < count_ && is_inside(to, loop); to = ways_[to].front())
                if (ways_[to].size() != 1 || goes_back(to)) return false;
            return to == loop.merge;
        });
    }
    [[nodiscard]] bool goes_back(std::size_t at) const {
        return std::ranges::any_of(targets_of(function_.blocks[at].instructions.back()),
                                   [&](Id target) { return function_.block_at.at(target) <= at; });
    }
    /// One of the ways leaves a loop: the rounds speak of that, not a weight.
    [[nodiscard]] bool is_loop_exit(std::size_t at) const {
        return std::ranges::any_of(ways_[at], [&](std::size_t to) { return leaves(at, to); });
    }

    std::vector<double> follow(bool longest) const {
        std::vector<double> rest(count_, 0.0);
        std::vector<std::size_t> next(count_, count_);
        for (std::size_t at = count_; at-- > 0;) {
            for (const std::size_t to : ways_[at]) {
                if (next[at] == count_ || (longest ? rest[to] > rest[next[at]] : rest[to] < rest[next[at]]))
                    next[at] = to;
            }
            rest[at] = cost_[at] * (longest ? rounds(at, true) : 1.0) + (next[at] < count_ ? rest[next[at]] : 0.0);
        }
        std::vector<double> runs(count_, 0.0);
        for (std::size_t at = 0; at < count_; at = next[at]) runs[at] = longest ? rounds(at, true) : 1.0;
        return runs;
    }

    std::vector<double> weights() const {
        std::vector<double> share(count_, 0.0);
        share[0] = 1.0;
        for (std::size_t at = 0; at < count_; ++at) {
            for (const Loop& loop : loops_)
                if (loop.merge == at) share[at] = share[loop.header];
            std::vector<std::size_t> staying, leaving;
            for (const std::size_t to : ways_[at]) (leaves(at, to) ? leaving : staying).push_back(to);
            static_assert(kBranchWeight == 0.5, "ways share equally");
            for (const std::size_t to : staying) share[to] += share[at] / static_cast<double>(staying.size());
            // What is done on leaving a loop is done once.
            for (const std::size_t to : leaving)
                if (rounds(to, false) > 0.0) share[to] += share[at] / rounds(to, false);
        }
        for (std::size_t at = 0; at < count_; ++at) share[at] *= rounds(at, false);
        return share;
    }

    const Module& module_;
    const Function& function_;
    const std::vector<double>& cost_;
    std::size_t count_;
    std::vector<Loop> loops_;
    std::vector<std::vector<std::size_t>> ways_;
    std::vector<std::string> notices_;
};

}  // namespace

BlockRuns runs_of(const Module& module, const Function& function, const std::vector<double>& cost) {
    return Ways(module, function, cost).run();
}

}  // namespace halfframe::cost
