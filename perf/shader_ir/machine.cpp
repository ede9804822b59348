// Control flow and memory of the machine.
#include "perf/shader_ir/machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/error.h"

namespace halfframe::shader_ir {
namespace {

using Kind = Type::Kind;

/// Blocks of instructions that one call may run before it counts as endless.
constexpr int kBlockLimit = 1'000'000;

constexpr double kUnwritten = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::int32_t to_int(double x) {
    if (std::isnan(x)) return 0;
    return static_cast<std::int32_t>(std::clamp(x, -0x1p31, 0x1p31 - 1.0));
}

std::uint32_t to_uint(double x) {
    if (std::isnan(x)) return 0;
    return static_cast<std::uint32_t>(std::clamp(x, 0.0, 0x1p32 - 1.0));
}

Machine::Machine(const Module& module, Model model, const Bindings& bindings, std::size_t width)
    : module_(module),
      model_(model),
      width_(width),
      registers_(module.bound),
      types_(module.bound, 0),
      discarded_(width, 0),
      came_from_(width, 0) {
    for (const auto& [name, sampler] : bindings.samplers) {
        sampler_names_.push_back(name);
        samplers_.push_back(&sampler);
    }
    for (const auto& [id, constant] : module.constants) {
        types_[id] = constant.type;
        std::vector<double>& data = registers_[id].data;
        for (const double scalar : constant.scalars) data.insert(data.end(), width, scalar);
    }
    for (const Variable& variable : module.variables) {
        variables_[variable.id] = make_storage(variable.type, variable.name);
        types_[variable.id] = variable.pointer_type;
        point(variable.id, variables_[variable.id]);
        registers_[variable.id].relaxed = module.relaxed[variable.id];
        variables_[variable.id].keeps_32_bits = variable.storage != spv::StorageClassPrivate;
    }
    for (const Function& function : module.functions) {
        if (module.type(function.return_type).scalars > 0) {
            types_[function.id] = function.return_type;
            registers_[function.id].data.assign(module.type(function.return_type).scalars * width, 0.0);
        }
        for (const Parameter& parameter : function.parameters) {
            types_[parameter.id] = parameter.type;
            registers_[parameter.id].data.assign(module.type(parameter.type).scalars * width, 0.0);
        }
        for (const Block& block : function.blocks) {
            for (const Instruction& one : block.instructions) {
                if (one.result == 0 || one.type == 0) continue;
                types_[one.result] = one.type;
                registers_[one.result].data.assign(module.type(one.type).scalars * width, 0.0);
            }
        }
    }
}

Storage Machine::make_storage(Id type, const std::string& name) const {
    Storage storage{.data = {}, .type = type, .name = name};
    storage.data.resize(module_.type(type).scalars * width_);
    initialise(storage, 0);
    return storage;
}

void Machine::initialise(Storage& storage, Id initializer) const {
    if (initializer != 0) {
        storage.data = registers_[initializer].data;
        return;
    }
    const Type& type = module_.type(storage.type);
    for (std::size_t s = 0; s < type.scalars; ++s) {
        std::fill_n(storage.data.begin() + static_cast<std::ptrdiff_t>(s * width_), width_,
                    type.float_leaf[s] ? kUnwritten : 0.0);
    }
}

void Machine::point(Id pointer, Storage& storage) {
    registers_[pointer].storage = &storage;
    registers_[pointer].offset.assign(width_, 0);
}

double Machine::sampler_at(std::string_view name) const {
    const auto found = std::find(sampler_names_.begin(), sampler_names_.end(), name);
    return found != sampler_names_.end() ? static_cast<double>(found - sampler_names_.begin()) : -1.0;
}

/// All elements of an array of samplers have the array's function, or each its own: "image[2]".
void Machine::attach_sampler(Storage& storage) const {
    const std::size_t elements = module_.type(storage.type).scalars;
    for (std::size_t s = 0; s < elements; ++s) {
        const double own = sampler_at(fmt::format("{}[{}]", storage.name, s));
        std::fill_n(storage.data.begin() + static_cast<std::ptrdiff_t>(s * width_), width_,
                    own >= 0.0 ? own : sampler_at(storage.name));
    }
}

void Machine::fill(Storage& target, const Columns& columns, std::size_t first, bool relaxed) const {
    const Type& type = module_.type(target.type);
    expect(columns.size() == type.scalars, [&] {
        return fmt::format("{} columns given for {}, which has {} scalars", columns.size(), target.name, type.scalars);
    });
    for (std::size_t s = 0; s < type.scalars; ++s) {
        const bool narrow = !target.keeps_32_bits && (relaxed || type.relaxed_leaf[s]);
        const Model to = type.float_leaf[s] ? format(narrow) : Model::in_double;
        const std::vector<double>& column = columns[s];
        const std::size_t lanes = column.size() == 1 ? width_ : std::min(width_, column.size() - first);
        for (std::size_t lane = 0; lane < lanes; ++lane) {
            target.data[s * width_ + lane] = rounded(to, column[column.size() == 1 ? 0 : first + lane]);
        }
    }
}

void Machine::begin(const Bindings& bindings, std::size_t first, std::size_t lanes) {
    watch_ = first == 0 && bindings.watch ? &bindings.watch : nullptr;
    active_.resize(lanes);
    for (Lane lane = 0; lane < lanes; ++lane) active_[lane] = lane;
    std::fill(discarded_.begin(), discarded_.end(), std::uint8_t{0});
    for (const Variable& variable : module_.variables) {
        Storage& storage = variables_[variable.id];
        initialise(storage, variable.initializer);
        const Type& type = module_.type(variable.type);
        const Kind kind = type.kind == Kind::array ? module_.type(type.element).kind : type.kind;
        const auto given = bindings.variables.find(variable.name);
        if (kind == Kind::sampler) {
            attach_sampler(storage);
        } else if (given != bindings.variables.end()) {
            fill(storage, given->second, first, false);
        } else {
            const bool outside = variable.storage == spv::StorageClassInput ||
                                 variable.storage == spv::StorageClassUniformConstant ||
                                 variable.storage == spv::StorageClassUniform;
            storage.given = !outside;
        }
    }
}

void Machine::fail(const Instruction& one, const std::string& why) const {
    throw Error(Fault::check, fmt::format("{}: {} ({})", module_.place(one.line), why, module_.text_of(one)));
}

void Machine::call(const Function& function) {
    const std::vector<Lane> before = active_;
    Waiting waiting(function.blocks.size());
    waiting[0] = active_;
    for (int blocks = 0;; ++blocks) {
        const auto next =
            std::find_if(waiting.begin(), waiting.end(), [](const auto& lanes) { return !lanes.empty(); });
        if (next == waiting.end()) break;
        const Block& block = function.blocks[static_cast<std::size_t>(next - waiting.begin())];
        if (blocks == kBlockLimit) fail(block.instructions.front(), "a loop that does not end for some input");
        active_ = std::move(*next);
        next->clear();
        run_block(function, block, waiting);
    }
    active_ = before;
    drop_discarded();
}

void Machine::drop_discarded() {
    std::erase_if(active_, [&](Lane lane) { return discarded_[lane] != 0; });
}

void Machine::run_block(const Function& function, const Block& block, Waiting& waiting) {
    std::size_t first = 0;
    while (block.instructions[first].op == spv::OpPhi) ++first;
    choose({block.instructions.data(), first});
    for (std::size_t i = first; i + 1 < block.instructions.size(); ++i) run(block.instructions[i]);
    leave(function, block, block.instructions.back(), waiting);
}

/// All phis of a block read before any is written.
void Machine::choose(std::span<const Instruction> phis) {
    std::vector<std::vector<double>> chosen;
    for (const Instruction& phi : phis) {
        const std::size_t scalars = module_.type(phi.type).scalars;
        std::vector<double>& values = chosen.emplace_back();
        for (const Lane lane : active_) {
            std::size_t i = 0;
            while (phi.operands.at(i + 1) != came_from_[lane]) i += 2;
            for (std::size_t s = 0; s < scalars; ++s) values.push_back(in(phi.operands[i], s)[lane]);
        }
    }
    for (std::size_t p = 0; p < phis.size(); ++p) {
        const std::size_t scalars = module_.type(phis[p].type).scalars;
        auto value = chosen[p].begin();
        for (const Lane lane : active_) {
            for (std::size_t s = 0; s < scalars; ++s) out(phis[p], s)[lane] = *value++;
        }
    }
}

void Machine::leave(const Function& function, const Block& block, const Instruction& end, Waiting& waiting) {
    switch (end.op) {
        case spv::OpBranch:
        case spv::OpBranchConditional:
        case spv::OpSwitch: part(function, block, end, waiting); break;
        case spv::OpReturnValue: {
            const Type& type = module_.type(function.return_type);
            for (std::size_t s = 0; s < type.scalars; ++s) {
                const Model to =
                    type.float_leaf[s] ? format(function.relaxed || type.relaxed_leaf[s]) : Model::in_double;
                double* target = &registers_[function.id].data[s * width_];
                for (const Lane lane : active_) target[lane] = rounded(to, in(end.operands[0], s)[lane]);
            }
            break;
        }
        case spv::OpKill:
            for (const Lane lane : active_) discarded_[lane] = 1;
            break;
        case spv::OpReturn: break;
        case spv::OpUnreachable:
            if (!active_.empty()) fail(end, "a function ends without returning its value");
            break;
        default: fail(end, "this end of a block cannot be evaluated");
    }
}

/// Each lane goes on to the block it branches to.
void Machine::part(const Function& function, const Block& block, const Instruction& end, Waiting& waiting) {
    const auto& words = end.operands;
    for (const Lane lane : active_) {
        Id target = words[0];
        if (end.op == spv::OpBranchConditional) target = in(words[0], 0)[lane] != 0.0 ? words[1] : words[2];
        if (end.op == spv::OpSwitch) {
            target = words[1];
            const double selector = in(words[0], 0)[lane];
            const bool is_signed = type_of(words[0]).is_signed;
            for (std::size_t i = 2; i + 1 < words.size(); i += 2) {
                const double label = is_signed ? static_cast<double>(static_cast<std::int32_t>(words[i]))
                                               : static_cast<double>(words[i]);
                if (selector == label) target = words[i + 1];
            }
        }
        came_from_[lane] = block.label;
        waiting[function.block_at.at(target)].push_back(lane);
    }
}

void Machine::run(const Instruction& one) {
    if (active_.empty()) return;
    const bool known = run_memory(one) || run_float(one) || run_composite(one) || run_comparison(one) ||
                       run_integer(one) || run_logic(one) || run_conversion(one) || run_matrix(one) ||
                       run_sampling(one);
    if (!known) fail(one, "this instruction cannot be evaluated one pixel at a time");
    if (watch_ != nullptr) tell(one);
}

/// What only moves values about is passed over.
void Machine::tell(const Instruction& one) const {
    if (one.result == 0 || one.op == spv::OpLoad || one.op == spv::OpVariable || one.op == spv::OpAccessChain ||
        one.op == spv::OpCompositeExtract || one.op == spv::OpCompositeConstruct || one.op == spv::OpVectorShuffle)
        return;
    const Type& type = module_.type(one.type);
    if (type.scalars == 0 || type.kind == Type::Kind::pointer || !type.float_leaf[0] || active_.front() != 0) return;
    std::vector<double> scalars;
    for (std::size_t s = 0; s < type.scalars; ++s) scalars.push_back(in(one.result, s)[0]);
    (*watch_)(one.line, scalars);
}

bool Machine::run_memory(const Instruction& one) {
    switch (one.op) {
        case spv::OpVariable: make_variable(one); return true;
        case spv::OpLoad: load(one); return true;
        case spv::OpStore: store(one); return true;
        case spv::OpAccessChain:
        case spv::OpInBoundsAccessChain: follow(one); return true;
        case spv::OpFunctionCall: call_function(one); return true;
        case spv::OpSelectionMerge:
        case spv::OpLoopMerge:
        case spv::OpNop: return true;
        case spv::OpExtInst:
            if (one.operands[0] != module_.standard_functions) return true;  // debug information
            return run_standard(one);
        default: return false;
    }
}

void Machine::make_variable(const Instruction& one) {
    Storage& storage = variables_[one.result];
    const Id type = module_.type(one.type).element;
    if (storage.type == 0) {
        const auto name = module_.names.find(one.result);
        storage = make_storage(type, name != module_.names.end() ? name->second : "");
        point(one.result, storage);
        registers_[one.result].relaxed = one.relaxed;
    }
    const Id initializer = one.operands.size() > 1 ? one.operands[1] : 0;
    const Type& shape = module_.type(type);
    for (std::size_t s = 0; s < shape.scalars; ++s) {
        for (const Lane lane : active_) {
            const double none = shape.float_leaf[s] ? kUnwritten : 0.0;
            storage.data[s * width_ + lane] = initializer != 0 ? in(initializer, s)[lane] : none;
        }
    }
}

void Machine::load(const Instruction& one) {
    const Register& pointer = registers_[one.operands[0]];
    if (!pointer.storage->given) {
        fail(one, "\"" + pointer.storage->name + "\" is read, but the bindings give it no value");
    }
    const std::size_t scalars = module_.type(one.type).scalars;
    for (std::size_t s = 0; s < scalars; ++s) {
        double* to = out(one, s);
        for (const Lane lane : active_) to[lane] = pointer.storage->data[(pointer.offset[lane] + s) * width_ + lane];
    }
}

void Machine::store(const Instruction& one) {
    const Register& pointer = registers_[one.operands[0]];
    const Type& type = type_of(one.operands[1]);
    for (std::size_t s = 0; s < type.scalars; ++s) {
        const bool relaxed = !pointer.storage->keeps_32_bits && (pointer.relaxed || type.relaxed_leaf[s]);
        const Model to = type.float_leaf[s] && relaxed ? model_ : Model::in_double;
        const double* from = in(one.operands[1], s);
        for (const Lane lane : active_) {
            pointer.storage->data[(pointer.offset[lane] + s) * width_ + lane] = rounded(to, from[lane]);
        }
    }
}

/// An access chain: one index after the other, constant for members of structures.
void Machine::follow(const Instruction& one) {
    const Register& base = registers_[one.operands[0]];
    Register& result = registers_[one.result];
    result.storage = base.storage;
    result.relaxed = base.relaxed;
    result.offset.resize(width_);
    for (const Lane lane : active_) result.offset[lane] = base.offset[lane];
    const Type* type = &module_.type(type_of(one.operands[0]).element);
    for (std::size_t i = 1; i < one.operands.size(); ++i) {
        const double* index = in(one.operands[i], 0);
        const bool is_structure = type->kind == Kind::structure;
        const auto member = is_structure ? static_cast<std::size_t>(index[active_.front()]) : 0;
        const Type& inner = module_.type(is_structure ? type->members.at(member) : type->element);
        std::uint32_t skipped = 0;
        for (std::size_t m = 0; m < member; ++m) skipped += module_.type(type->members[m]).scalars;
        if (is_structure && type->relaxed_leaf[skipped]) result.relaxed = true;
        for (const Lane lane : active_) {
            if (!is_structure && (index[lane] < 0.0 || index[lane] >= type->count)) {
                fail(one, fmt::format("index {} of {} elements", index[lane], type->count));
            }
            result.offset[lane] += is_structure ? skipped : static_cast<std::uint32_t>(index[lane]) * inner.scalars;
        }
        type = &inner;
    }
}

void Machine::call_function(const Instruction& one) {
    const Function& function = module_.function(one.operands[0]);
    for (std::size_t i = 0; i < function.parameters.size(); ++i) {
        const Parameter& parameter = function.parameters[i];
        const Register& argument = registers_[one.operands[i + 1]];
        Register& formal = registers_[parameter.id];
        const Type& type = module_.type(parameter.type);
        if (type.kind == Kind::pointer) {
            formal.storage = argument.storage;
            formal.relaxed = module_.relaxed[parameter.id];
            formal.offset.resize(width_);
            for (const Lane lane : active_) formal.offset[lane] = argument.offset[lane];
            continue;
        }
        const Model to = format(module_.relaxed[parameter.id]);
        for (std::size_t s = 0; s < type.scalars; ++s) {
            for (const Lane lane : active_) {
                formal.data[s * width_ + lane] =
                    rounded(type.float_leaf[s] ? to : Model::in_double, argument.data[s * width_ + lane]);
            }
        }
    }
    call(function);
    for (std::size_t s = 0; s < module_.type(function.return_type).scalars; ++s) {
        for (const Lane lane : active_) out(one, s)[lane] = in(function.id, s)[lane];
    }
}

Model Machine::format_of_inputs(std::span<const Id> arguments) const {
    bool some = false;
    for (const Id id : arguments) {
        const Type& type = type_of(id);
        if (type.float_leaf.empty() || !type.float_leaf[0] || module_.constants.contains(id)) continue;
        if (!module_.relaxed[id]) return Model::in_double;
        some = true;
    }
    return some ? model_ : Model::in_double;
}

std::vector<double> Machine::lane_of(Id id, Lane lane, Model before) const {
    std::vector<double> values(scalars_of(id));
    for (std::size_t s = 0; s < values.size(); ++s) values[s] = rounded(before, in(id, s)[lane]);
    return values;
}

}  // namespace halfframe::shader_ir
