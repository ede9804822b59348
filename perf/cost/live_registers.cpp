// Liveness by component: backwards over the blocks until nothing changes, then once more to find the fullest place.
#include "perf/cost/live_registers.h"

#include <algorithm>
#include <array>
#include <map>

#include "perf/cost/instruction_work.h"

namespace halfframe::cost {
namespace {

using shader_ir::Block;
using shader_ir::Function;
using Set = std::vector<bool>;

/// Components alive in each vector, counted by how many a vector has left: what an allocator has to place.
class Pressure {
public:
    explicit Pressure(std::vector<bool> vector_is_half)
        : vector_is_half_(std::move(vector_is_half)), alive_(vector_is_half_.size(), 0) {}

    void change(std::size_t vector, int by) {
        std::array<int, 5>& counts = counts_[vector_is_half_[vector] ? 1 : 0];
        --counts[static_cast<std::size_t>(alive_[vector])];
        alive_[vector] += by;
        ++counts[static_cast<std::size_t>(alive_[vector])];
    }

    [[nodiscard]] Temporaries now() const { return {packed(counts_[0]), packed(counts_[1])}; }

private:
    static int packed(const std::array<int, 5>& counts) {
        const int singles = std::max(0, counts[1] - counts[3]);  // the rest sits in the fourth component of triples
        const int in_pairs = counts[2] * 2 + singles;
        return counts[4] + counts[3] + (in_pairs + 3) / 4;
    }

    std::vector<bool> vector_is_half_;
    std::vector<int> alive_;
    std::array<std::array<int, 5>, 2> counts_{};
};

class Liveness {
public:
    Liveness(const Module& module, const Values& values, const Function& function)
        : module_(module), values_(values), function_(function) {
        number_components();
        spread();
    }

    Temporaries fullest() const {
        Temporaries most;
        for (std::size_t at = 0; at < function_.blocks.size(); ++at) {
            Set alive = live_out_[at];
            Pressure pressure(vector_is_half_);
            for (std::size_t i = 0; i < alive.size(); ++i)
                if (alive[i]) pressure.change(vector_of_[i], 1);
            const auto note = [&] {
                const Temporaries now = pressure.now();
                if (now.weighted() > most.weighted()) most = now;
            };
            note();
            const auto& instructions = function_.blocks[at].instructions;
            for (auto one = instructions.rbegin(); one != instructions.rend(); ++one) {
                walk(*one, alive, [&](std::size_t i, bool on) { pressure.change(vector_of_[i], on ? 1 : -1); });
                note();
            }
        }
        return most;
    }

private:
    bool is_truth(const shader_ir::Type& type) const {
        return type.kind == shader_ir::Type::Kind::boolean ||
               (type.kind == shader_ir::Type::Kind::vector &&
                module_.type(type.element).kind == shader_ir::Type::Kind::boolean);
    }

    /// Each value that is made gets numbers for its components; columns of matrices are vectors of their own.
    void number_components() {
        for (const Block& block : function_.blocks) {
            for (const Instruction& one : block.instructions) {
                if (one.result == 0 || values_.is_alias(one) || values_.of(one.result).empty()) continue;
                if (values_.of(one.result).front().source != one.result) continue;
                const shader_ir::Type& type = module_.type(one.type);
                if (is_truth(type)) continue;  // condition codes, not temporaries
                const std::uint32_t column =
                    type.kind == shader_ir::Type::Kind::matrix ? module_.type(type.element).scalars : 4;
                first_[one.result] = vector_of_.size();
                for (std::uint32_t i = 0; i < type.scalars; ++i) {
                    if (i % column == 0) vector_is_half_.push_back(values_.half(one.result));
                    vector_of_.push_back(vector_is_half_.size() - 1);
                }
            }
        }
    }

    template <typename Use>
    void each_component(Id id, Use use) const {
        if (id >= module_.bound) return;
        for (const Component& one : values_.of(id)) {
            if (one.from != Component::From::temporary) continue;
            if (const auto found = first_.find(one.source); found != first_.end()) use(found->second + one.index);
        }
    }

    /// One instruction backwards: what it makes dies, what it reads lives. Phis read at the ends of other blocks.
    template <typename Changed>
    void walk(const Instruction& one, Set& alive, Changed changed) const {
        if (values_.is_alias(one)) return;
        if (const auto made = first_.find(one.result); one.result != 0 && made != first_.end()) {
            for (std::size_t i = 0; i < values_.of(one.result).size(); ++i) {
                if (!alive[made->second + i]) continue;
                alive[made->second + i] = false;
                changed(made->second + i, false);
            }
        }
        if (one.op == spv::OpPhi || one.op == spv::OpSelectionMerge || one.op == spv::OpLoopMerge ||
            one.op == spv::OpBranch)
            return;
        for (const Id operand : read_by(one)) {
            each_component(operand, [&](std::size_t i) {
                if (alive[i]) return;
                alive[i] = true;
                changed(i, true);
            });
        }
    }

    static std::vector<Id> read_by(const Instruction& one) {
        if (one.op == spv::OpExtInst) return {one.operands.begin() + 2, one.operands.end()};
        if (one.op == spv::OpBranchConditional || one.op == spv::OpSwitch) return {one.operands.at(0)};
        if (!is_fetch(one.op)) return one.operands;
        // Sampler, coordinates, the reference of a comparison; then a mask of what follows, which is no id.
        std::vector<Id> read(one.operands.begin(), one.operands.begin() + 2);
        const bool compares =
            one.op == spv::OpImageSampleDrefImplicitLod || one.op == spv::OpImageSampleDrefExplicitLod ||
            one.op == spv::OpImageSampleProjDrefImplicitLod || one.op == spv::OpImageSampleProjDrefExplicitLod;
        if (compares) read.push_back(one.operands.at(2));
        for (std::size_t i = compares ? 4 : 3; i < one.operands.size(); ++i) read.push_back(one.operands[i]);
        return read;
    }

    void spread() {
        const std::size_t count = function_.blocks.size();
        live_in_.assign(count, Set(vector_of_.size(), false));
        live_out_ = live_in_;
        for (bool changed = true; changed;) {
            changed = false;
            for (std::size_t at = count; at-- > 0;) {
                Set alive = out_of(at);
                live_out_[at] = alive;
                const auto& instructions = function_.blocks[at].instructions;
                for (auto one = instructions.rbegin(); one != instructions.rend(); ++one)
                    walk(*one, alive, [](std::size_t, bool) {});
                if (alive != live_in_[at]) {
                    live_in_[at] = std::move(alive);
                    changed = true;
                }
            }
        }
    }

    Set out_of(std::size_t at) const {
        Set alive(vector_of_.size(), false);
        const Block& block = function_.blocks[at];
        for (const Id target : block.instructions.back().operands) {
            const auto next = function_.block_at.find(target);
            if (next == function_.block_at.end()) continue;
            for (std::size_t i = 0; i < alive.size(); ++i) alive[i] = alive[i] || live_in_[next->second][i];
            for (const Instruction& phi : function_.blocks[next->second].instructions) {
                if (phi.op != spv::OpPhi) continue;
                for (std::size_t i = 0; i + 1 < phi.operands.size(); i += 2) {
                    if (phi.operands[i + 1] == block.label)
                        each_component(phi.operands[i], [&](std::size_t component) { alive[component] = true; });
                }
            }
        }
        return alive;
    }

    const Module& module_;
    const Values& values_;
    const Function& function_;
    std::map<Id, std::size_t> first_;
    std::vector<std::size_t> vector_of_;
    std::vector<bool> vector_is_half_;
    std::vector<Set> live_in_, live_out_;
};

}  // namespace

Temporaries live_temporaries(const Module& module, const Values& values, const Function& function) {
    return Liveness(module, values, function).fullest();
}

}  // namespace halfframe::cost
