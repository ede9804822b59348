// Follows components through a function, in the order of its blocks: what is used is made before it, save in loops.
#include "perf/cost/values.h"

#include <algorithm>
#include <cmath>

#include <glslang/SPIRV/GLSL.std.450.h>

#include "engine/error.h"

namespace halfframe::cost {
namespace {

using shader_ir::Type;

bool all_literal(const std::vector<Component>& components, double value) {
    return !components.empty() && std::ranges::all_of(components, [&](const Component& one) {
        return one.from == Component::From::literal && one.value == value;
    });
}

/// Times 2, 4, 8, 1/2, 1/4, 1/8 (RSX writes results scaled), and times 1.
bool is_free_factor(const std::vector<Component>& factor) {
    if (factor.empty() || factor.front().from != Component::From::literal) return false;
    const double size = std::fabs(factor.front().value);
    return all_literal(factor, factor.front().value) &&
           (size == 1.0 || size == 2.0 || size == 4.0 || size == 8.0 || size == 0.5 || size == 0.25 || size == 0.125);
}

}  // namespace

Values::Values(const Module& module)
    : module_(module),
      components_(module.bound),
      alias_(module.instruction_count, false),
      modifier_(module.instruction_count, false),
      half_(module.bound, false) {
    for (const auto& [id, constant] : module.constants) {
        composite_type_[id] = constant.type;
        for (const double value : constant.scalars)
            components_[id].push_back({.from = Component::From::literal, .value = value});
    }
    for (const shader_ir::Variable& variable : module.variables) {
        pointers_[variable.id] = {.variable = variable.id, .path = {}};
        variables_[variable.id] = &variable;
    }
    for (Id id = 0; id < module.bound; ++id) half_[id] = module.relaxed[id];
    for (const shader_ir::Function& function : module.functions) {
        for (const shader_ir::Block& block : function.blocks) {
            for (const Instruction& instruction : block.instructions) follow(instruction);
        }
    }
    infer_half();
}

bool Values::is_output(Id pointer) const {
    const auto found = variables_.find(variable_of(pointer));
    return found != variables_.end() && found->second->storage == spv::StorageClassOutput;
}

Id Values::variable_of(Id id) const {
    if (const auto sampler = sampler_variable_.find(id); sampler != sampler_variable_.end()) return sampler->second;
    const auto found = pointers_.find(id);
    return found != pointers_.end() ? found->second.variable : 0;
}

std::uint32_t Values::register_number(Id variable, const std::vector<std::uint32_t>& path) {
    return registers_.try_emplace({variable, path}, static_cast<std::uint32_t>(registers_.size())).first->second;
}

void Values::set_alias(const Instruction& instruction, std::vector<Component> components) {
    components_[instruction.result] = std::move(components);
    alias_[instruction.ordinal] = true;
}

void Values::make_temporary(const Instruction& instruction) {
    const std::uint32_t scalars = module_.type(instruction.type).scalars;
    std::vector<Component>& made = components_[instruction.result];
    for (std::uint32_t i = 0; i < scalars; ++i)
        made.push_back({.from = Component::From::temporary, .source = instruction.result, .index = i});
}

void Values::follow(const Instruction& instruction) {
    if (instruction.result == 0) return;
    composite_type_[instruction.result] = instruction.type;
    if (instruction.op == spv::OpVariable || instruction.op == spv::OpAccessChain) {
        follow_pointer(instruction);
    } else if (instruction.op == spv::OpLoad) {
        follow_load(instruction);
    } else if (instruction.op == spv::OpImage || instruction.op == spv::OpSampledImage) {
        sampler_variable_[instruction.result] = variable_of(instruction.operands.at(0));
        alias_[instruction.ordinal] = true;
    } else if (!follow_swizzle(instruction) && !follow_modifier(instruction)) {
        make_temporary(instruction);
    }
}

void Values::follow_pointer(const Instruction& instruction) {
    alias_[instruction.ordinal] = true;
    if (instruction.op == spv::OpVariable) {
        pointers_[instruction.result] = {.variable = instruction.result, .path = {}};
        return;
    }
    Pointer pointer = pointers_[instruction.operands.at(0)];
    for (std::size_t i = 1; i < instruction.operands.size(); ++i) {
        const auto constant = module_.constants.find(instruction.operands[i]);
        const bool known = constant != module_.constants.end();
        pointer.dynamic = pointer.dynamic || !known;
        // An index that is not known names a register of its own, told apart by the id that holds it.
        pointer.path.push_back(known ? static_cast<std::uint32_t>(constant->second.scalars.at(0))
                                     : module_.bound + instruction.operands[i]);
    }
    pointers_[instruction.result] = std::move(pointer);
}

/// A scalar or a vector lies in one register, a component of a vector in that of the vector.
void Values::read_register(const Pointer& pointer, Id type, Component::From from, std::vector<Component>& into) {
    const Type& shape = module_.type(type);
    if (shape.kind == Type::Kind::matrix || shape.kind == Type::Kind::array || shape.kind == Type::Kind::structure) {
        for (std::uint32_t i = 0; i < shape.count; ++i) {
            Pointer part = pointer;
            part.path.push_back(i);
            read_register(part, shape.kind == Type::Kind::structure ? shape.members[i] : shape.element, from, into);
        }
        return;
    }
    std::vector<std::uint32_t> path = pointer.path;
    std::uint32_t first = 0;
    Id owner = variables_.at(pointer.variable)->type;
    for (const std::uint32_t index : pointer.path) {
        const Type& outer = module_.type(owner);
        if (outer.kind == Type::Kind::vector) {
            first = index;
            path.pop_back();
            break;
        }
        owner = outer.kind == Type::Kind::structure ? outer.members.at(index) : outer.element;
    }
    const std::uint32_t number = register_number(pointer.variable, path);
    for (std::uint32_t i = 0; i < shape.scalars; ++i)
        into.push_back({.from = from, .source = number, .index = first + i});
}

void Values::follow_load(const Instruction& instruction) {
    const auto pointer = pointers_.find(instruction.operands.at(0));
    const auto variable = pointer != pointers_.end() ? variables_.find(pointer->second.variable) : variables_.end();
    if (module_.type(instruction.type).kind == Type::Kind::sampler) {
        sampler_variable_[instruction.result] = variable_of(instruction.operands.at(0));
        alias_[instruction.ordinal] = true;
        return;
    }
    const spv::StorageClass storage =
        variable != variables_.end() ? variable->second->storage : spv::StorageClassFunction;
    if (storage == spv::StorageClassUniformConstant || storage == spv::StorageClassUniform ||
        storage == spv::StorageClassInput) {
        std::vector<Component> components;
        read_register(pointer->second, instruction.type,
                      storage == spv::StorageClassInput ? Component::From::input : Component::From::uniform,
                      components);
        set_alias(instruction, std::move(components));
        return;
    }
    indexes_memory_ = indexes_memory_ || storage == spv::StorageClassFunction;
    make_temporary(instruction);
}

bool Values::follow_swizzle(const Instruction& instruction) {
    std::vector<Component> made;
    const auto& operands = instruction.operands;
    switch (instruction.op) {
        case spv::OpVectorShuffle: {
            std::vector<Component> both = of(operands.at(0));
            both.insert(both.end(), of(operands.at(1)).begin(), of(operands.at(1)).end());
            for (std::size_t i = 2; i < operands.size(); ++i)
                made.push_back(operands[i] < both.size() ? both[operands[i]] : Component{});
            break;
        }
        case spv::OpCompositeConstruct:
            for (const Id part : operands) made.insert(made.end(), of(part).begin(), of(part).end());
            break;
        case spv::OpCompositeExtract:
        case spv::OpCompositeInsert: {
            const bool insert = instruction.op == spv::OpCompositeInsert;
            made = of(operands.at(insert ? 1 : 0));
            // Where the part lies in the whole: every level of the path adds the scalars before it.
            Id type = instruction.type;
            if (!insert) {
                const auto made_by = composite_type_.find(operands[0]);
                if (made_by == composite_type_.end()) return false;
                type = made_by->second;
            }
            std::size_t first = 0;
            for (std::size_t i = insert ? 2 : 1; i < operands.size(); ++i) {
                const Type& outer = module_.type(type);
                if (outer.kind == Type::Kind::structure) {
                    for (std::uint32_t m = 0; m < operands[i]; ++m) first += module_.type(outer.members[m]).scalars;
                    type = outer.members.at(operands[i]);
                } else {
                    type = outer.element;
                    first += operands[i] * module_.type(type).scalars;
                }
            }
            const std::size_t count = module_.type(type).scalars;
            if (made.size() < first + count) return false;
            if (insert) {
                std::ranges::copy(of(operands[0]), made.begin() + static_cast<std::ptrdiff_t>(first));
            } else {
                made = {made.begin() + static_cast<std::ptrdiff_t>(first),
                        made.begin() + static_cast<std::ptrdiff_t>(first + count)};
            }
            break;
        }
        case spv::OpCopyObject:
        case spv::OpConvertSToF:  // these units know no integers: what the text calls one is a float
        case spv::OpConvertUToF:
        case spv::OpBitcast:
        case spv::OpLogicalNot: made = of(operands.at(0)); break;
        case spv::OpUndef: made.assign(module_.type(instruction.type).scalars, Component{}); break;
        default: return false;
    }
    set_alias(instruction, std::move(made));
    return true;
}

bool Values::follow_modifier(const Instruction& instruction) {
    const auto& operands = instruction.operands;
    Id modified = 0;
    if (instruction.op == spv::OpFNegate || instruction.op == spv::OpSNegate) {
        modified = operands.at(0);
    } else if (instruction.op == spv::OpFMul || instruction.op == spv::OpVectorTimesScalar) {
        if (is_free_factor(of(operands.at(1)))) modified = operands[0];
        else if (instruction.op == spv::OpFMul && is_free_factor(of(operands[0]))) modified = operands[1];
    } else if (instruction.op == spv::OpExtInst && operands.at(0) == module_.standard_functions) {
        const auto function = operands.at(1);
        if (function == GLSLstd450FAbs || function == GLSLstd450SAbs) modified = operands.at(2);
        if (function == GLSLstd450FClamp && all_literal(of(operands.at(3)), 0.0) &&
            all_literal(of(operands.at(4)), 1.0))
            modified = operands[2];
    }
    // A modifier changes what a unit reads or writes; a constant that is scaled is another constant.
    if (modified == 0 || of(modified).empty() || of(modified).front().from == Component::From::literal) return false;
    set_alias(instruction, of(modified));
    modifier_[instruction.ordinal] = true;
    return true;
}

void Values::infer_half() {
    const auto is_half = [&](const Component& one) {
        return one.from == Component::From::literal || one.from == Component::From::nothing ||
               (one.from == Component::From::temporary && half_[one.source]);
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (const shader_ir::Function& function : module_.functions) {
            for (const shader_ir::Block& block : function.blocks) {
                for (const Instruction& instruction : block.instructions) {
                    const bool phi = instruction.op == spv::OpPhi;
                    if ((!phi && instruction.op != spv::OpSelect) || half_[instruction.result]) continue;
                    bool all = true, any = false;
                    for (std::size_t i = phi ? 0 : 1; i < instruction.operands.size(); i += phi ? 2 : 1) {
                        for (const Component& one : of(instruction.operands[i])) {
                            all = all && (is_half(one) || one.source == instruction.result);
                            any = any || (one.from == Component::From::temporary && half_[one.source]);
                        }
                    }
                    if (!all || !any) continue;
                    half_[instruction.result] = true;
                    changed = true;
                }
            }
        }
    }
}

}  // namespace halfframe::cost
