// The functions of GLSL.std.450 that work on one component at a time.
#include <glslang/SPIRV/GLSL.std.450.h>

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "perf/shader_ir/machine.h"

namespace halfframe::shader_ir {
namespace {

using std::numbers::pi;

double sign_of(double x) { return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : x; }

/// To the nearest whole number, ties to even, in any rounding mode.
double round_even(double x) {
    const double down = std::floor(x);
    if (x - down != 0.5) return std::round(x);
    return std::copysign(std::fmod(down, 2.0) == 0.0 ? down : down + 1.0, x);
}

/// f in fp32 for narrow formats: llvmpipe widens these functions to the float ones of the C library.
template <typename InFloat, typename InDouble>
double widened(Model model, double x, InFloat in_float, InDouble in_double) {
    return is_narrow(model) ? static_cast<double>(in_float(static_cast<float>(x))) : in_double(x);
}

}  // namespace

double Rounded::exp2(double x) const {
    return (*this)(widened(
        model, x, [](float v) { return std::exp2(v); }, [](double v) { return std::exp2(v); }));
}

double Rounded::log2(double x) const {
    return (*this)(widened(
        model, x, [](float v) { return std::log2(v); }, [](double v) { return std::log2(v); }));
}

double Rounded::power(double x, double y) const {
    if (x < 0.0) return std::numeric_limits<double>::quiet_NaN();
    if (model == Model::in_double) return std::pow(x, y);
    return x == 0.0 ? 0.0 : exp2(product(log2(x), y));
}

bool Machine::run_standard(const Instruction& one) {
    return run_standard_scalar(one) || run_standard_integer(one) || run_standard_vector(one) ||
           run_standard_packing(one);
}

bool Machine::run_standard_scalar(const Instruction& one) {
    const std::span<const Id> args = std::span(one.operands).subspan(2);
    const Rounded to{format(one)};
    const auto unary = [&](auto f) {
        each_float<1>(one, args, f);
        return true;
    };
    const auto binary = [&](auto f) {
        each_float<2>(one, args, f);
        return true;
    };
    const auto ternary = [&](auto f) {
        each_float<3>(one, args, f);
        return true;
    };
    const bool in_double = to.model == Model::in_double;
    switch (one.operands[1]) {
        // GLSL leaves the direction of round(0.5) open; Mesa rounds to even.
        case GLSLstd450Round:
        case GLSLstd450RoundEven: return unary(round_even);
        case GLSLstd450Trunc: return unary([](double x) { return std::trunc(x); });
        case GLSLstd450FAbs: return unary([](double x) { return std::fabs(x); });
        case GLSLstd450FSign: return unary(sign_of);
        case GLSLstd450Floor: return unary([](double x) { return std::floor(x); });
        case GLSLstd450Ceil: return unary([](double x) { return std::ceil(x); });
        case GLSLstd450Fract: return unary([](double x) { return x - std::floor(x); });
        case GLSLstd450Radians: return unary([&](double x) { return x * to(pi / 180.0); });
        case GLSLstd450Degrees: return unary([&](double x) { return x * to(180.0 / pi); });
        case GLSLstd450Sin:
            return unary([&](double x) {
                return widened(
                    to.model, x, [](float v) { return std::sin(v); }, [](double v) { return std::sin(v); });
            });
        case GLSLstd450Cos:
            return unary([&](double x) {
                return widened(
                    to.model, x, [](float v) { return std::cos(v); }, [](double v) { return std::cos(v); });
            });
        case GLSLstd450Tan:
            return unary(
                [&](double x) { return in_double ? std::tan(x) : to.quotient(to(std::sin(x)), to(std::cos(x))); });
        case GLSLstd450Asin: return unary([](double x) { return std::asin(x); });
        case GLSLstd450Acos: return unary([](double x) { return std::acos(x); });
        case GLSLstd450Atan: return unary([](double x) { return std::atan(x); });
        case GLSLstd450Sinh: return unary([](double x) { return std::sinh(x); });
        case GLSLstd450Cosh: return unary([](double x) { return std::cosh(x); });
        case GLSLstd450Tanh: return unary([](double x) { return std::tanh(x); });
        case GLSLstd450Asinh: return unary([](double x) { return std::asinh(x); });
        case GLSLstd450Acosh: return unary([](double x) { return std::acosh(x); });
        case GLSLstd450Atanh: return unary([](double x) { return std::atanh(x); });
        case GLSLstd450Atan2: return binary([](double y, double x) { return std::atan2(y, x); });
        case GLSLstd450Pow: return binary([&](double x, double y) { return to.power(x, y); });
        case GLSLstd450Exp:
            return unary(
                [&](double x) { return in_double ? std::exp(x) : to.exp2(to.product(x, to(std::numbers::log2e))); });
        case GLSLstd450Log:
            return unary([&](double x) { return in_double ? std::log(x) : to.log2(x) * to(std::numbers::ln2); });
        case GLSLstd450Exp2: return unary([&](double x) { return to.exp2(x); });
        case GLSLstd450Log2: return unary([&](double x) { return to.log2(x); });
        case GLSLstd450Sqrt: return unary([](double x) { return std::sqrt(x); });
        case GLSLstd450InverseSqrt: return unary([&](double x) { return 1.0 / to.root(x); });
        // As llvmpipe and the C library have it: a NaN gives way to the other argument.
        case GLSLstd450FMin: return binary([](double x, double y) { return std::fmin(x, y); });
        case GLSLstd450FMax: return binary([](double x, double y) { return std::fmax(x, y); });
        case GLSLstd450FClamp:
            return ternary([](double x, double low, double high) { return std::fmin(std::fmax(x, low), high); });
        case GLSLstd450FMix:
            return ternary([&](double x, double y, double a) { return x + to.product(a, to.difference(y, x)); });
        case GLSLstd450Step: return binary([](double edge, double x) { return x >= edge ? 1.0 : 0.0; });
        case GLSLstd450SmoothStep:
            return ternary([&](double low, double high, double x) {
                const double share = to.quotient(to.difference(x, low), to.difference(high, low));
                const double t = std::fmin(std::fmax(share, 0.0), 1.0);
                return to.product(t, to.difference(3.0, to.product(2.0, t))) * t;
            });
        case GLSLstd450Fma: return ternary([&](double a, double b, double c) { return to.product(a, b) + c; });
        case GLSLstd450Ldexp: return binary([](double x, double e) { return std::ldexp(x, to_int(e)); });
        default: return false;
    }
}

bool Machine::run_standard_integer(const Instruction& one) {
    const std::span<const Id> args = std::span(one.operands).subspan(2);
    const auto unary = [&](auto f) {
        each_exact<1>(one, args, f);
        return true;
    };
    const auto binary = [&](auto f) {
        each_exact<2>(one, args, f);
        return true;
    };
    const auto ternary = [&](auto f) {
        each_exact<3>(one, args, f);
        return true;
    };
    switch (one.operands[1]) {
        case GLSLstd450SAbs: return unary([](double x) { return x == -0x1p31 ? x : std::fabs(x); });
        case GLSLstd450SSign: return unary(sign_of);
        case GLSLstd450SMin:
        case GLSLstd450UMin: return binary([](double x, double y) { return std::fmin(x, y); });
        case GLSLstd450SMax:
        case GLSLstd450UMax: return binary([](double x, double y) { return std::fmax(x, y); });
        case GLSLstd450SClamp:
        case GLSLstd450UClamp:
            return ternary([](double x, double low, double high) { return std::fmin(std::fmax(x, low), high); });
        default: return false;
    }
}

}  // namespace halfframe::shader_ir
