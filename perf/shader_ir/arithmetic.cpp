// The instructions that compute: floats in the operation's format, integers in 32 bits, booleans as 0 and 1.
#include <bit>
#include <cmath>

#include "perf/shader_ir/machine.h"

namespace halfframe::shader_ir {
namespace {

double from_bits(std::uint32_t bits, bool is_signed) {
    return is_signed ? static_cast<double>(static_cast<std::int32_t>(bits)) : static_cast<double>(bits);
}

/// The 32 bits of an integer, whichever its sign.
std::uint32_t bits_of(double x) { return x < 0.0 ? static_cast<std::uint32_t>(to_int(x)) : to_uint(x); }

double truth(bool holds) { return holds ? 1.0 : 0.0; }

std::uint32_t divided(std::uint32_t a, std::uint32_t b) { return b != 0 ? a / b : 0u; }  // GLSL leaves x / 0 open

/// Signed division and remainder in 64 bits, where the most negative number over -1 fits.
std::uint32_t signed_division(spv::Op op, std::uint32_t a, std::uint32_t b) {
    const std::int64_t x = static_cast<std::int32_t>(a);
    const std::int64_t y = static_cast<std::int32_t>(b);
    if (y == 0) return 0;
    if (op == spv::OpSDiv) return static_cast<std::uint32_t>(x / y);
    const std::int64_t remainder = x % y;
    const bool shift = op == spv::OpSMod && remainder != 0 && (remainder < 0) != (y < 0);
    return static_cast<std::uint32_t>(shift ? remainder + y : remainder);
}

std::uint32_t shifted(spv::Op op, std::uint32_t a, std::uint32_t by) {
    by &= 31u;  // GLSL leaves wider shifts open
    if (op == spv::OpShiftLeftLogical) return a << by;
    if (op == spv::OpShiftRightLogical) return a >> by;
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(a) >> by);
}

std::uint32_t integer_result(spv::Op op, std::uint32_t a, std::uint32_t b) {
    switch (op) {
        case spv::OpIAdd: return a + b;
        case spv::OpISub: return a - b;
        case spv::OpIMul: return a * b;
        case spv::OpUDiv: return divided(a, b);
        case spv::OpUMod: return b != 0 ? a % b : 0u;
        case spv::OpSDiv:
        case spv::OpSRem:
        case spv::OpSMod: return signed_division(op, a, b);
        case spv::OpBitwiseAnd: return a & b;
        case spv::OpBitwiseOr: return a | b;
        case spv::OpBitwiseXor: return a ^ b;
        default: return shifted(op, a, b);
    }
}

}  // namespace

double Rounded::dot(std::span<const double> a, std::span<const double> b) const {
    double sum = product(a.back(), b.back());
    for (std::size_t i = a.size() - 1; i-- > 0;) sum = this->sum(sum, product(a[i], b[i]));
    return sum;
}

bool Machine::run_float(const Instruction& one) {
    const auto& words = one.operands;
    const Rounded arithmetic{format(one)};
    switch (one.op) {
        case spv::OpFNegate: each_float<1>(one, words, [](double a) { return -a; }); return true;
        case spv::OpFAdd: each_float<2>(one, words, [](double a, double b) { return a + b; }); return true;
        case spv::OpFSub: each_float<2>(one, words, [](double a, double b) { return a - b; }); return true;
        case spv::OpFMul:
        case spv::OpVectorTimesScalar:
        case spv::OpMatrixTimesScalar: each_float<2>(one, words, [](double a, double b) { return a * b; }); return true;
        case spv::OpFDiv: each_float<2>(one, words, [](double a, double b) { return a / b; }); return true;
        case spv::OpFRem: each_float<2>(one, words, [](double a, double b) { return std::fmod(a, b); }); return true;
        case spv::OpFMod:
            each_float<2>(one, words, [&](double a, double b) {
                return a - arithmetic.product(b, std::floor(arithmetic.quotient(a, b)));
            });
            return true;
        case spv::OpDot:
            for (const Lane lane : active_) {
                const auto a = lane_of(words[0], lane, arithmetic.model);
                const auto b = lane_of(words[1], lane, arithmetic.model);
                out(one, 0)[lane] = arithmetic.dot(a, b);
            }
            return true;
        case spv::OpSelect: select(one); return true;
        default: return false;
    }
}

void Machine::select(const Instruction& one) {
    const Type& type = module_.type(one.type);
    const auto choose = [](double which, double a, double b) { return which != 0.0 ? a : b; };
    if (type.float_leaf.at(0)) {
        each_float<3>(one, one.operands, choose);
    } else {
        each_exact<3>(one, one.operands, choose);
    }
}

bool Machine::run_comparison(const Instruction& one) {
    const auto& words = one.operands;
    const auto ordered = [](double a, double b) { return !std::isnan(a) && !std::isnan(b); };
    switch (one.op) {
        case spv::OpFOrdEqual:
            each_compared<2>(one, words, [](double a, double b) { return truth(a == b); });
            return true;
        case spv::OpFUnordEqual:
            each_compared<2>(one, words, [&](double a, double b) { return truth(!ordered(a, b) || a == b); });
            return true;
        case spv::OpFOrdNotEqual:
            each_compared<2>(one, words, [&](double a, double b) { return truth(ordered(a, b) && a != b); });
            return true;
        case spv::OpFUnordNotEqual:
            each_compared<2>(one, words, [](double a, double b) { return truth(a != b); });
            return true;
        case spv::OpFOrdLessThan:
            each_compared<2>(one, words, [](double a, double b) { return truth(a < b); });
            return true;
        case spv::OpFOrdGreaterThan:
            each_compared<2>(one, words, [](double a, double b) { return truth(a > b); });
            return true;
        case spv::OpFOrdLessThanEqual:
            each_compared<2>(one, words, [](double a, double b) { return truth(a <= b); });
            return true;
        case spv::OpFOrdGreaterThanEqual:
            each_compared<2>(one, words, [](double a, double b) { return truth(a >= b); });
            return true;
        case spv::OpIsNan: each_compared<1>(one, words, [](double a) { return truth(std::isnan(a)); }); return true;
        case spv::OpIsInf: each_compared<1>(one, words, [](double a) { return truth(std::isinf(a)); }); return true;
        default: return false;
    }
}

bool Machine::run_integer(const Instruction& one) {
    const auto& words = one.operands;
    const Type& type = module_.type(one.type);
    const Type& element = type.kind == Type::Kind::vector ? module_.type(type.element) : type;
    const bool is_signed = element.is_signed;
    switch (one.op) {
        case spv::OpSNegate:
            each_exact<1>(one, words, [&](double a) { return from_bits(0u - bits_of(a), is_signed); });
            return true;
        case spv::OpNot:
            each_exact<1>(one, words, [&](double a) { return from_bits(~bits_of(a), is_signed); });
            return true;
        case spv::OpIAdd:
        case spv::OpISub:
        case spv::OpIMul:
        case spv::OpUDiv:
        case spv::OpUMod:
        case spv::OpSDiv:
        case spv::OpSRem:
        case spv::OpSMod:
        case spv::OpBitwiseAnd:
        case spv::OpBitwiseOr:
        case spv::OpBitwiseXor:
        case spv::OpShiftLeftLogical:
        case spv::OpShiftRightLogical:
        case spv::OpShiftRightArithmetic:
            each_exact<2>(one, words, [&](double a, double b) {
                return from_bits(integer_result(one.op, bits_of(a), bits_of(b)), is_signed);
            });
            return true;
        default: return false;
    }
}

bool Machine::run_logic(const Instruction& one) {
    const auto& words = one.operands;
    switch (one.op) {
        case spv::OpIEqual:
        case spv::OpLogicalEqual:
            each_exact<2>(one, words, [](double a, double b) { return truth(a == b); });
            return true;
        case spv::OpINotEqual:
        case spv::OpLogicalNotEqual:
            each_exact<2>(one, words, [](double a, double b) { return truth(a != b); });
            return true;
        // Registers hold the value of an integer, not its bits: signed and unsigned compare alike.
        case spv::OpSLessThan:
        case spv::OpULessThan: each_exact<2>(one, words, [](double a, double b) { return truth(a < b); }); return true;
        case spv::OpSLessThanEqual:
        case spv::OpULessThanEqual:
            each_exact<2>(one, words, [](double a, double b) { return truth(a <= b); });
            return true;
        case spv::OpSGreaterThan:
        case spv::OpUGreaterThan:
            each_exact<2>(one, words, [](double a, double b) { return truth(a > b); });
            return true;
        case spv::OpSGreaterThanEqual:
        case spv::OpUGreaterThanEqual:
            each_exact<2>(one, words, [](double a, double b) { return truth(a >= b); });
            return true;
        case spv::OpLogicalAnd:
            each_exact<2>(one, words, [](double a, double b) { return truth(a != 0.0 && b != 0.0); });
            return true;
        case spv::OpLogicalOr:
            each_exact<2>(one, words, [](double a, double b) { return truth(a != 0.0 || b != 0.0); });
            return true;
        case spv::OpLogicalNot: each_exact<1>(one, words, [](double a) { return truth(a == 0.0); }); return true;
        case spv::OpAny:
        case spv::OpAll:
            for (const Lane lane : active_) {
                double set = 0.0;
                for (std::size_t s = 0; s < scalars_of(words[0]); ++s) set += in(words[0], s)[lane];
                const double wanted = one.op == spv::OpAny ? 1.0 : static_cast<double>(scalars_of(words[0]));
                out(one, 0)[lane] = truth(set >= wanted);
            }
            return true;
        default: return false;
    }
}

bool Machine::run_conversion(const Instruction& one) {
    const auto& words = one.operands;
    switch (one.op) {
        case spv::OpConvertFToS:
            each_compared<1>(one, words, [](double a) { return static_cast<double>(to_int(std::trunc(a))); });
            return true;
        case spv::OpConvertFToU:
            each_compared<1>(one, words, [](double a) { return static_cast<double>(to_uint(std::trunc(a))); });
            return true;
        case spv::OpConvertSToF:
        case spv::OpConvertUToF: each_float<1>(one, words, [](double a) { return a; }); return true;
        case spv::OpBitcast: {
            const bool from_float = type_of(words[0]).float_leaf.at(0);
            const bool to_float = module_.type(one.type).float_leaf.at(0);
            const Type& type = module_.type(one.type);
            const bool is_signed = (type.element != 0 ? module_.type(type.element) : type).is_signed;
            each_exact<1>(one, words, [&](double a) {
                const auto bits = from_float ? std::bit_cast<std::uint32_t>(static_cast<float>(a)) : bits_of(a);
                return to_float ? static_cast<double>(std::bit_cast<float>(bits)) : from_bits(bits, is_signed);
            });
            return true;
        }
        default: return false;
    }
}

/// Products of matrices as Mesa takes them apart: a matrix times a vector is a sum of scaled columns, first to last; a
/// vector times a matrix is a dot product per column.
bool Machine::run_matrix(const Instruction& one) {
    const auto& words = one.operands;
    const Rounded arithmetic{format(one)};
    const auto columns_times = [&](std::span<const double> matrix, std::span<const double> vector, std::size_t row) {
        const std::size_t rows = matrix.size() / vector.size();
        double sum = arithmetic.product(matrix[row], vector[0]);
        for (std::size_t c = 1; c < vector.size(); ++c) {
            sum = arithmetic.sum(sum, arithmetic.product(matrix[c * rows + row], vector[c]));
        }
        return sum;
    };
    const bool known = one.op == spv::OpMatrixTimesVector || one.op == spv::OpVectorTimesMatrix ||
                       one.op == spv::OpMatrixTimesMatrix || one.op == spv::OpOuterProduct;
    if (!known) return false;
    const std::size_t scalars = module_.type(one.type).scalars;
    for (const Lane lane : active_) {
        const std::vector<double> left = lane_of(words[0], lane, arithmetic.model);
        const std::vector<double> right = lane_of(words[1], lane, arithmetic.model);
        const std::size_t inner = one.op == spv::OpMatrixTimesMatrix ? type_of(words[0]).count : right.size();
        for (std::size_t s = 0; s < scalars; ++s) {
            const std::span<const double> all(right);
            double value = 0.0;
            if (one.op == spv::OpMatrixTimesVector) {
                value = columns_times(left, right, s);
            } else if (one.op == spv::OpVectorTimesMatrix) {
                value = arithmetic.dot(left, all.subspan(s * left.size(), left.size()));
            } else if (one.op == spv::OpOuterProduct) {
                value = arithmetic.product(left[s % left.size()], right[s / left.size()]);
            } else {
                const std::size_t rows = left.size() / inner;
                value = columns_times(left, all.subspan(s / rows * inner, inner), s % rows);
            }
            out(one, s)[lane] = value;
        }
    }
    return true;
}

}  // namespace halfframe::shader_ir
