// The functions of GLSL.std.450 that see a whole vector or matrix, or give more than one value.
#include <glslang/SPIRV/GLSL.std.450.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "perf/shader_ir/machine.h"

namespace halfframe::shader_ir {
namespace {

using Values = std::vector<double>;

Values difference(const Rounded& to, const Values& a, const Values& b) {
    Values result(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) result[i] = to.difference(a[i], b[i]);
    return result;
}

Values cross(const Rounded& to, const Values& a, const Values& b) {
    Values result(3);
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3;
        const std::size_t k = (i + 2) % 3;
        result[i] = to.difference(to.product(a[j], b[k]), to.product(b[j], a[k]));
    }
    return result;
}

/// x * (1 / sqrt(dot(x, x))), each rounded: 0 / 0 is NaN, and half overflows to 0 for a vector of 300.
Values normalize(const Rounded& to, const Values& x) {
    const double scale = to.quotient(1.0, to.length(x));
    Values result(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) result[i] = to.product(x[i], scale);
    return result;
}

Values reflect(const Rounded& to, const Values& incident, const Values& normal) {
    const double twice = to.product(2.0, to.dot(normal, incident));
    Values result(incident.size());
    for (std::size_t i = 0; i < incident.size(); ++i) {
        result[i] = to.difference(incident[i], to.product(twice, normal[i]));
    }
    return result;
}

Values refract(const Rounded& to, const Values& incident, const Values& normal, double eta) {
    const double d = to.dot(normal, incident);
    const double k = to.difference(1.0, to.product(eta, to.product(eta, to.difference(1.0, to.product(d, d)))));
    Values result(incident.size(), 0.0);
    if (k < 0.0) return result;
    const double along = to.sum(to.product(eta, d), to.root(k));
    for (std::size_t i = 0; i < incident.size(); ++i) {
        result[i] = to.difference(to.product(eta, incident[i]), to.product(along, normal[i]));
    }
    return result;
}

/// The matrix of size n x n without one column and one row.
Values minor_of(const Values& matrix, std::size_t n, std::size_t column, std::size_t row) {
    Values rest;
    for (std::size_t c = 0; c < n; ++c) {
        for (std::size_t r = 0; r < n; ++r) {
            if (c != column && r != row) rest.push_back(matrix[c * n + r]);
        }
    }
    return rest;
}

/// By cofactors of the first column, each operation rounded.
double determinant(const Rounded& to, const Values& matrix, std::size_t n) {
    if (n == 1) return matrix[0];
    double sum = 0.0;
    for (std::size_t r = 0; r < n; ++r) {
        const double term = to.product(matrix[r], determinant(to, minor_of(matrix, n, 0, r), n - 1));
        sum = r == 0 ? term : r % 2 == 1 ? to.difference(sum, term) : to.sum(sum, term);
    }
    return sum;
}

/// Adjugate over determinant.
Values inverse(const Rounded& to, const Values& matrix, std::size_t n) {
    const double scale = to.quotient(1.0, determinant(to, matrix, n));
    Values result(n * n);
    for (std::size_t c = 0; c < n; ++c) {
        for (std::size_t r = 0; r < n; ++r) {
            const double cofactor = determinant(to, minor_of(matrix, n, r, c), n - 1);
            result[c * n + r] = to.product((c + r) % 2 == 1 ? -cofactor : cofactor, scale);
        }
    }
    return result;
}

/// A normalised number of `bits` bits, as GLSL ES 3.00, 8.4 writes it.
std::uint32_t normalised(double x, std::uint32_t bits, bool is_signed) {
    const double most =
        is_signed ? std::ldexp(1.0, static_cast<int>(bits) - 1) - 1.0 : std::ldexp(1.0, static_cast<int>(bits)) - 1.0;
    const double clamped = std::clamp(std::isnan(x) ? 0.0 : x, is_signed ? -1.0 : 0.0, 1.0);
    const auto code = static_cast<std::int32_t>(std::lround(clamped * most));
    return static_cast<std::uint32_t>(code) & ((std::uint32_t{1} << bits) - 1u);
}

double unnormalised(std::uint32_t code, std::uint32_t bits, bool is_signed) {
    if (!is_signed) return code / (std::ldexp(1.0, static_cast<int>(bits)) - 1.0);
    const double most = std::ldexp(1.0, static_cast<int>(bits) - 1) - 1.0;
    const double value = code > most ? code - 2.0 * (most + 1.0) : code;
    return std::max(value / most, -1.0);
}

struct Packing {
    std::uint32_t bits = 0;
    bool is_signed = false;
    bool is_half = false;
    bool unpacks = false;
};

Packing packing_of(std::uint32_t function) {
    switch (function) {
        case GLSLstd450PackSnorm4x8: return {8, true, false, false};
        case GLSLstd450PackUnorm4x8: return {8, false, false, false};
        case GLSLstd450PackSnorm2x16: return {16, true, false, false};
        case GLSLstd450PackUnorm2x16: return {16, false, false, false};
        case GLSLstd450PackHalf2x16: return {16, false, true, false};
        case GLSLstd450UnpackSnorm4x8: return {8, true, false, true};
        case GLSLstd450UnpackUnorm4x8: return {8, false, false, true};
        case GLSLstd450UnpackSnorm2x16: return {16, true, false, true};
        case GLSLstd450UnpackUnorm2x16: return {16, false, false, true};
        case GLSLstd450UnpackHalf2x16: return {16, false, true, true};
        default: return {};
    }
}

}  // namespace

bool Machine::run_standard_vector(const Instruction& one) {
    const std::span<const Id> args = std::span(one.operands).subspan(2);
    const std::uint32_t function = one.operands[1];
    const Rounded to{format(one)};
    if (function == GLSLstd450Modf) {
        split(one);
        return true;
    }
    for (const Lane lane : active_) {
        std::vector<Values> v;
        for (const Id id : args) v.push_back(lane_of(id, lane, to.model));
        Values result;
        switch (function) {
            case GLSLstd450Length: result = {to.length(v[0])}; break;
            case GLSLstd450Distance: result = {to.length(difference(to, v[0], v[1]))}; break;
            case GLSLstd450Cross: result = cross(to, v[0], v[1]); break;
            case GLSLstd450Normalize: result = normalize(to, v[0]); break;
            case GLSLstd450FaceForward:
                result = v[0];
                if (!(to.dot(v[2], v[1]) < 0.0))
                    std::transform(v[0].begin(), v[0].end(), result.begin(), std::negate());
                break;
            case GLSLstd450Reflect: result = reflect(to, v[0], v[1]); break;
            case GLSLstd450Refract: result = refract(to, v[0], v[1], v[2][0]); break;
            case GLSLstd450Determinant: result = {determinant(to, v[0], type_of(args[0]).count)}; break;
            case GLSLstd450MatrixInverse: result = inverse(to, v[0], type_of(args[0]).count); break;
            default: return false;
        }
        for (std::size_t s = 0; s < result.size(); ++s) out(one, s)[lane] = result[s];
    }
    return true;
}

/// modf: exact, so nothing rounds but what is read.
void Machine::split(const Instruction& one) {
    const Id argument = one.operands[2];
    const Register& pointer = registers_[one.operands[3]];
    for (std::size_t s = 0; s < scalars_of(argument); ++s) {
        for (const Lane lane : active_) {
            const double x = rounded(is_narrow(format(one)) ? format(one) : Model::in_double, in(argument, s)[lane]);
            const double whole = std::trunc(x);
            pointer.storage->data[(pointer.offset[lane] + s) * width_ + lane] = whole;
            out(one, s)[lane] = std::copysign(std::isinf(x) ? 0.0 : x - whole, x);
        }
    }
}

bool Machine::run_standard_packing(const Instruction& one) {
    const Packing packing = packing_of(one.operands[1]);
    if (packing.bits == 0) return false;
    const Id argument = one.operands[2];
    const std::uint32_t parts = 32 / packing.bits;
    const Model unpacked = format(one);
    for (const Lane lane : active_) {
        std::uint32_t packed = packing.unpacks ? to_uint(in(argument, 0)[lane]) : 0u;
        for (std::uint32_t part = 0; part < parts; ++part) {
            const std::uint32_t shift = part * packing.bits;
            if (packing.unpacks) {
                const std::uint32_t code = (packed >> shift) & ((std::uint32_t{1} << packing.bits) - 1u);
                const double value = packing.is_half ? value_of_half(static_cast<std::uint16_t>(code))
                                                     : unnormalised(code, packing.bits, packing.is_signed);
                out(one, part)[lane] = rounded(unpacked, value);
            } else {
                const double value = in(argument, part)[lane];
                packed |= (packing.is_half ? half_bits(value) : normalised(value, packing.bits, packing.is_signed))
                          << shift;
            }
        }
        if (!packing.unpacks) out(one, 0)[lane] = static_cast<double>(packed);
    }
    return true;
}

}  // namespace halfframe::shader_ir
