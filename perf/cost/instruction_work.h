// What each instruction costs, in the currencies of Work.
#pragma once

#include <map>
#include <set>
#include <vector>

#include "perf/cost/shader_counts.h"
#include "perf/cost/values.h"

namespace halfframe::cost {

/// Vec4 slots of RSX for one operation on that many components: one or two 0.5, three 0.75, four 1.
[[nodiscard]] double slots_of(int components);

/// Multiplications whose only use is one addition: they and it are one multiply-add.
class FusedMads {
public:
    FusedMads(const Module& module, const Values& values);
    /// The multiplication that the addition swallows; nullptr: none.
    [[nodiscard]] const Instruction* multiplication_of(const Instruction& addition) const;
    [[nodiscard]] bool is_swallowed(Id multiplication) const { return swallowed_.contains(multiplication); }
    [[nodiscard]] int count() const { return static_cast<int>(swallowed_.size()); }

private:
    std::map<Id, const Instruction*> multiplication_of_;  ///< by the addition's result
    std::set<Id> swallowed_;
};

/// The line of the listing for an instruction that does something; `what` is empty for one that does nothing.
[[nodiscard]] CountedInstruction work_of(const Module& module, const Values& values, const FusedMads& mads,
                                         const Instruction& instruction);

/// Is it a texture fetch?
[[nodiscard]] bool is_fetch(spv::Op op);

}  // namespace halfframe::cost
