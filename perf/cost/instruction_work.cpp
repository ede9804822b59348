// What each instruction costs. Decompositions are those of the units' instruction sets: a division is a reciprocal and
// a multiplication, a power a logarithm, a multiplication and an exponential.
#include "perf/cost/instruction_work.h"

#include <algorithm>
#include <set>

#include <glslang/SPIRV/GLSL.std.450.h>

#include "engine/error.h"

namespace halfframe::cost {
namespace {

using shader_ir::Type;

/// `count` operations on vectors of `width`.
Work arithmetic(int width, double count = 1.0) {
    Work work{.slots = count * slots_of(width), .mads = count * width};
    (width > 1 ? work.vector_ops : work.scalar_ops) = count;
    return work;
}

/// Reciprocal, reciprocal root, exponential, logarithm: the scalar unit, once a component.
Work special(int width, double count = 1.0) {
    return {.slots = 0.5 * width * count, .scalar_ops = width * count, .mads = width * count};
}

/// Sine and cosine: with the reduction of the angle.
Work trigonometry(int width) { return {.slots = 1.0 * width, .scalar_ops = 1.0 * width, .mads = 1.0 * width}; }

Work dot(int width) {
    return {.slots = slots_of(width),
            .vector_ops = width > 1 ? 1.0 : 0.0,
            .scalar_ops = width > 1 ? 0.0 : 1.0,
            .mads = 1.0 * width};
}

Work sum(std::initializer_list<Work> parts) {
    Work total;
    for (const Work& part : parts) total += part;
    return total;
}

bool is_literal(const std::vector<Component>& components) {
    return !components.empty() && components.front().from == Component::From::literal;
}

bool is_one(const std::vector<Component>& components) {
    return std::ranges::all_of(
        components, [](const Component& one) { return one.from == Component::From::literal && one.value == 1.0; });
}

struct Priced {
    const char* what = "";
    Work work = {};
};

class Pricing {
public:
    Pricing(const Module& module, const Values& values, const Instruction& instruction)
        : module_(module), values_(values), one_(instruction) {}

    Priced run() const {
        if (one_.op == spv::OpExtInst) return standard();
        const int width = width_of_result();
        switch (one_.op) {
            case spv::OpFAdd:
            case spv::OpIAdd: return {"add", arithmetic(width)};
            case spv::OpFSub:
            case spv::OpISub: return {"subtract", arithmetic(width)};
            case spv::OpFMul:
            case spv::OpIMul:
            case spv::OpVectorTimesScalar:
            case spv::OpMatrixTimesScalar: return {"multiply", per_column(arithmetic)};
            case spv::OpFDiv: return division(width);
            case spv::OpSDiv:
            case spv::OpUDiv: return {"divide whole", sum({special(width), arithmetic(width, 2.0)})};
            case spv::OpFMod:
            case spv::OpFRem:
            case spv::OpSMod:
            case spv::OpSRem:
            case spv::OpUMod: return {"mod", sum({special(width), arithmetic(width, 3.0)})};
            case spv::OpDot: return {"dot", dot(width_of(0))};
            case spv::OpMatrixTimesVector: {
                const Type& matrix = type_of(0);
                return {"matrix times vector", arithmetic(width, matrix.count)};
            }
            case spv::OpVectorTimesMatrix: {
                const Type& matrix = type_of(1);
                return {"vector times matrix", static_cast<double>(matrix.count) * dot(width_of(0))};
            }
            case spv::OpMatrixTimesMatrix: {
                const Type& left = type_of(0);
                const int rows = static_cast<int>(module_.type(left.element).count);
                return {"matrix times matrix", arithmetic(rows, 1.0 * left.count * type_of(1).count)};
            }
            case spv::OpOuterProduct: return {"outer product", arithmetic(width_of(0), module_.type(one_.type).count)};
            case spv::OpSelect: return {"select", arithmetic(width)};
            case spv::OpConvertFToS:
            case spv::OpConvertFToU: return {"truncate", arithmetic(width)};
            case spv::OpAny:
            case spv::OpAll: return {"any, all", dot(width_of(0))};
            case spv::OpDPdx:
            case spv::OpDPdy: return {"derivative", arithmetic(width)};
            case spv::OpFwidth: return {"derivatives", arithmetic(width, 3.0)};
            default: return rest(width);
        }
    }

private:
    Priced rest(int width) const {
        const bool compares = (one_.op >= spv::OpLogicalEqual && one_.op <= spv::OpLogicalAnd) ||
                              (one_.op >= spv::OpIEqual && one_.op <= spv::OpFUnordGreaterThanEqual) ||
                              one_.op == spv::OpIsNan || one_.op == spv::OpIsInf;
        if (compares) return {"compare", arithmetic(width)};
        const bool bits = one_.op >= spv::OpShiftRightLogical && one_.op <= spv::OpBitCount;
        if (bits) return {"bits", arithmetic(width)};
        return {};
    }

    Priced division(int width) const {
        if (is_literal(operand(1))) return {"multiply", arithmetic(width)};
        const std::vector<Component>& divisor = operand(1);
        const bool same = std::ranges::all_of(divisor, [&](const Component& one) { return one == divisor.front(); });
        const Work reciprocal = special(same ? 1 : width);
        if (is_one(operand(0))) return {"reciprocal", reciprocal};
        return {"divide", sum({reciprocal, arithmetic(width)})};
    }

    Priced standard() const {
        const int width = width_of_result();
        const int read = width_of(2);
        switch (one_.operands.at(1)) {
            case GLSLstd450FMin:
            case GLSLstd450SMin:
            case GLSLstd450UMin:
            case GLSLstd450NMin: return {"min", arithmetic(width)};
            case GLSLstd450FMax:
            case GLSLstd450SMax:
            case GLSLstd450UMax:
            case GLSLstd450NMax: return {"max", arithmetic(width)};
            case GLSLstd450FClamp:
            case GLSLstd450NClamp:
            case GLSLstd450SClamp:
            case GLSLstd450UClamp: return {"clamp", arithmetic(width, 2.0)};
            case GLSLstd450Floor: return {"floor", arithmetic(width)};
            case GLSLstd450Fract: return {"fract", arithmetic(width)};
            case GLSLstd450Ceil:
            case GLSLstd450Trunc:
            case GLSLstd450Round:
            case GLSLstd450RoundEven: return {"round", arithmetic(width, 2.0)};
            case GLSLstd450FSign:
            case GLSLstd450SSign: return {"sign", arithmetic(width, 2.0)};
            case GLSLstd450Step: return {"step", arithmetic(width)};
            case GLSLstd450FMix: return {"mix", arithmetic(width, 2.0)};
            case GLSLstd450SmoothStep: return smooth_step(width);
            case GLSLstd450Fma: return {"mad", arithmetic(width)};
            case GLSLstd450Pow: return {"pow", sum({special(width, 2.0), arithmetic(width)})};
            case GLSLstd450Exp2: return {"exp2", special(width)};
            case GLSLstd450Log2: return {"log2", special(width)};
            case GLSLstd450Exp: return {"exp", sum({special(width), arithmetic(width)})};
            case GLSLstd450Log: return {"log", sum({special(width), arithmetic(width)})};
            case GLSLstd450InverseSqrt: return {"reciprocal root", special(width)};
            case GLSLstd450Sqrt: return {"root", special(width, 2.0)};
            case GLSLstd450Sin: return {"sin", trigonometry(width)};
            case GLSLstd450Cos: return {"cos", trigonometry(width)};
            case GLSLstd450Tan:
                return {"tan", sum({trigonometry(width), trigonometry(width), special(width), arithmetic(width)})};
            case GLSLstd450Length: return {"length", sum({dot(read), special(1, 2.0)})};
            case GLSLstd450Distance: return {"distance", sum({arithmetic(read), dot(read), special(1, 2.0)})};
            case GLSLstd450Cross: return {"cross", arithmetic(3, 2.0)};
            case GLSLstd450Reflect: return {"reflect", sum({dot(width), arithmetic(width)})};
            case GLSLstd450Normalize: return normalize(width);
            case GLSLstd450FaceForward: return {"face forward", sum({dot(width), arithmetic(width)})};
            case GLSLstd450Refract:
                return {"refract", sum({dot(width), arithmetic(1, 4.0), special(1, 2.0), arithmetic(width, 2.0)})};
            default: return other_standard(width);
        }
    }

    /// Polynomials of the driver's choice: a range reduction and five multiply-adds a component.
    Priced other_standard(int width) const {
        switch (one_.operands.at(1)) {
            case GLSLstd450Asin:
            case GLSLstd450Acos:
            case GLSLstd450Atan:
            case GLSLstd450Atan2: return {"arc function", sum({special(width), arithmetic(width, 6.0)})};
            case GLSLstd450Radians:
            case GLSLstd450Degrees: return {"multiply", arithmetic(width)};
            default: return {"library function", arithmetic(std::max(width, 1), 4.0)};
        }
    }

    Priced smooth_step(int width) const {
        const bool known = is_literal(operand(2)) && is_literal(operand(3));
        const Work curve = arithmetic(width, 4.0);  // scale and saturate, 3 - 2x, two products
        return {"smoothstep", known ? curve : sum({curve, arithmetic(width), special(width)})};
    }

    Priced normalize(int width) const {
        Work work = sum({dot(width), special(1), arithmetic(width)});
        if (one_.relaxed || values_.half(one_.result)) {
            work.slots = 0.0;  // RSX has a unit for it; the other devices do not
            work.normalizes = 1.0;
        }
        return {"normalize", work};
    }

    template <typename Cost>
    Work per_column(Cost cost) const {
        const Type& type = module_.type(one_.type);
        if (type.kind != Type::Kind::matrix) return cost(static_cast<int>(type.scalars), 1.0);
        return cost(static_cast<int>(module_.type(type.element).scalars), type.count);
    }

    [[nodiscard]] const std::vector<Component>& operand(std::size_t index) const {
        return values_.of(one_.operands.at(index));
    }
    [[nodiscard]] int width_of(std::size_t index) const { return static_cast<int>(operand(index).size()); }
    [[nodiscard]] int width_of_result() const { return static_cast<int>(module_.type(one_.type).scalars); }
    [[nodiscard]] const Type& type_of(std::size_t index) const {
        return module_.type(values_.type_of(one_.operands.at(index)));
    }

    const Module& module_;
    const Values& values_;
    const Instruction& one_;
};

/// Slots of the moves that bring what one instruction cannot read: a second distinct constant, a second interpolant.
/// All literals of an instruction share one constant.
double moves_of(const Values& values, const std::vector<Id>& read) {
    std::set<std::uint32_t> constants, interpolants;
    bool literal = false;
    int width = 1;
    for (const Id id : read) {
        for (const Component& one : values.of(id)) {
            if (one.from == Component::From::uniform) constants.insert(one.source);
            if (one.from == Component::From::input) interpolants.insert(one.source);
            literal = literal || one.from == Component::From::literal;
        }
        width = std::max(width, static_cast<int>(values.of(id).size()));
    }
    const std::size_t distinct = constants.size() + (literal ? 1 : 0);
    const double extra = (distinct > 1 ? static_cast<double>(distinct - 1) : 0.0) +
                         (interpolants.size() > 1 ? static_cast<double>(interpolants.size() - 1) : 0.0);
    return extra * slots_of(std::min(width, 4));
}

/// Values among the operands: not the set of functions and a function's number, not the places of a swizzle.
std::vector<Id> values_read(const Instruction& instruction) {
    const auto& operands = instruction.operands;
    switch (instruction.op) {
        case spv::OpExtInst: return {operands.begin() + 2, operands.end()};
        case spv::OpVectorShuffle:
        case spv::OpCompositeInsert: return {operands.begin(), operands.begin() + 2};
        case spv::OpCompositeExtract: return {operands.front()};
        default: return operands;
    }
}

/// What goes out must be in a temporary: one move for each constant or interpolant that is written as it is.
CountedInstruction store(const Values& values, const Instruction& instruction) {
    std::map<std::pair<Component::From, std::uint32_t>, int> copied;
    for (const Component& one : values.of(instruction.operands.at(1))) {
        const bool literal = one.from == Component::From::literal;
        if (literal || one.from == Component::From::uniform || one.from == Component::From::input)
            ++copied[{one.from, literal ? 0 : one.source}];
    }
    CountedInstruction counted{.what = copied.empty() ? "" : "move out", .line = instruction.line};
    for (const auto& [source, components] : copied) {
        counted.components += components;
        counted.work += arithmetic(std::min(components, 4));
    }
    return counted;
}

CountedInstruction fetch(const Module& module, const Values& values, const Instruction& instruction) {
    const bool chosen = instruction.op == spv::OpImageSampleExplicitLod ||
                        instruction.op == spv::OpImageSampleDrefExplicitLod ||
                        instruction.op == spv::OpImageSampleProjExplicitLod || instruction.op == spv::OpImageFetch;
    return {.what = "fetch",
            .line = instruction.line,
            .components = static_cast<int>(module.type(instruction.type).scalars),
            .half = values.half(instruction.result),
            .any_level = !chosen};
}

}  // namespace

double slots_of(int components) { return components <= 2 ? 0.5 : components == 3 ? 0.75 : 1.0; }

bool is_fetch(spv::Op op) {
    return (op >= spv::OpImageSampleImplicitLod && op <= spv::OpImageSampleProjDrefExplicitLod) ||
           op == spv::OpImageFetch || op == spv::OpImageGather || op == spv::OpImageDrefGather;
}

FusedMads::FusedMads(const Module& module, const Values& values) {
    std::map<Id, int> uses;
    std::map<Id, const Instruction*> made_by;
    for (const shader_ir::Function& function : module.functions) {
        for (const shader_ir::Block& block : function.blocks) {
            for (const Instruction& one : block.instructions) {
                for (const Id operand : values_read(one)) ++uses[operand];
                if (one.result != 0) made_by[one.result] = &one;
            }
        }
    }
    for (const shader_ir::Function& function : module.functions) {
        for (const shader_ir::Block& block : function.blocks) {
            for (const Instruction& addition : block.instructions) {
                if (addition.op != spv::OpFAdd && addition.op != spv::OpFSub) continue;
                for (Id operand : addition.operands) {
                    if (uses[operand] != 1 || !made_by.contains(operand)) continue;
                    const Instruction* maker = made_by[operand];
                    if (maker->op == spv::OpFNegate && uses[maker->operands.at(0)] == 1 &&
                        made_by.contains(maker->operands[0]))
                        maker = made_by[maker->operands[0]];
                    const bool multiplies = maker->op == spv::OpFMul || maker->op == spv::OpVectorTimesScalar;
                    if (!multiplies || values.is_alias(*maker) || swallowed_.contains(maker->result)) continue;
                    multiplication_of_[addition.result] = maker;
                    swallowed_.insert(maker->result);
                    break;
                }
            }
        }
    }
}

const Instruction* FusedMads::multiplication_of(const Instruction& addition) const {
    const auto found = multiplication_of_.find(addition.result);
    return found != multiplication_of_.end() ? found->second : nullptr;
}

CountedInstruction work_of(const Module& module, const Values& values, const FusedMads& mads,
                           const Instruction& instruction) {
    if (is_fetch(instruction.op)) return fetch(module, values, instruction);
    if (instruction.op == spv::OpStore && values.is_output(instruction.operands.at(0)))
        return store(values, instruction);
    const bool silent = instruction.result == 0 || instruction.op == spv::OpPhi || instruction.op == spv::OpLoad ||
                        values.is_alias(instruction) || mads.is_swallowed(instruction.result);
    if (silent) return {};
    const Priced priced = Pricing(module, values, instruction).run();
    CountedInstruction counted{.what = priced.what,
                               .line = instruction.line,
                               .components = static_cast<int>(module.type(instruction.type).scalars),
                               .half = values.half(instruction.result),
                               .work = priced.work};
    if (counted.what.empty()) return counted;
    std::vector<Id> read = values_read(instruction);
    if (const Instruction* multiplication = mads.multiplication_of(instruction)) {
        counted.what = "mad";
        const std::vector<Id> factors = values_read(*multiplication);
        read.insert(read.end(), factors.begin(), factors.end());
        std::erase(read, multiplication->result);
    }
    counted.moves = moves_of(values, read);
    counted.work.slots += counted.moves;
    return counted;
}

}  // namespace halfframe::cost
