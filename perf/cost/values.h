// Where each component of each value comes from, once swizzles, copies and free modifiers are looked through.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "perf/shader_ir/module.h"

namespace halfframe::cost {

using shader_ir::Id;
using shader_ir::Instruction;
using shader_ir::Module;

struct Component {
    enum class From : std::uint8_t { nothing, temporary, uniform, literal, input };
    From from = From::nothing;
    std::uint32_t source = 0;  ///< temporary: the id that made it; uniform, input: the register, numbered from 0
    std::uint32_t index = 0;   ///< component of the source
    double value = 0.0;        ///< of literals
    bool operator==(const Component&) const = default;
};

class Values {
public:
    explicit Values(const Module& module);

    [[nodiscard]] const std::vector<Component>& of(Id id) const { return components_[id]; }
    /// The instruction does nothing but rename: a swizzle, a construction, a modifier that units apply for free.
    [[nodiscard]] bool is_alias(const Instruction& instruction) const { return alias_.at(instruction.ordinal); }
    /// The alias is a modifier that had to be looked for: negation, absolute, saturation, times 2, 4, 8, 1/2, 1/4, 1/8.
    [[nodiscard]] bool is_modifier(const Instruction& instruction) const { return modifier_.at(instruction.ordinal); }
    /// The value is mediump, also where the optimizer forgot to say so on a phi or a selection.
    [[nodiscard]] bool half(Id id) const { return half_[id]; }
    [[nodiscard]] bool is_output(Id pointer) const;
    [[nodiscard]] Id type_of(Id id) const { return composite_type_.at(id); }
    /// The global variable behind a pointer or a loaded sampler; 0: none.
    [[nodiscard]] Id variable_of(Id id) const;
    [[nodiscard]] bool indexes_memory() const { return indexes_memory_; }

private:
    struct Pointer {
        Id variable = 0;
        std::vector<std::uint32_t> path;
        bool dynamic = false;
    };
    void follow(const Instruction& instruction);
    void follow_pointer(const Instruction& instruction);
    void follow_load(const Instruction& instruction);
    void read_register(const Pointer& pointer, Id type, Component::From from, std::vector<Component>& into);
    void make_temporary(const Instruction& instruction);
    bool follow_modifier(const Instruction& instruction);
    bool follow_swizzle(const Instruction& instruction);
    void set_alias(const Instruction& instruction, std::vector<Component> components);
    void infer_half();
    std::uint32_t register_number(Id variable, const std::vector<std::uint32_t>& path);

    const Module& module_;
    std::vector<std::vector<Component>> components_;
    std::vector<bool> alias_, modifier_, half_;
    std::map<Id, Pointer> pointers_;
    std::map<Id, Id> sampler_variable_;
    std::map<Id, Id> composite_type_;  ///< type of every value, to find parts of it
    std::map<Id, const shader_ir::Variable*> variables_;
    std::map<std::pair<Id, std::vector<std::uint32_t>>, std::uint32_t> registers_;
    bool indexes_memory_ = false;
};

}  // namespace halfframe::cost
