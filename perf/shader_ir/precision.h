// The five arithmetics that a shader's float operation may run in, as rounding of values held in double.
#pragma once

#include <array>
#include <cstdint>

namespace halfframe::shader_ir {

/// How a module is evaluated. `in_double` runs everything in double. The others run every operation in fp32, save those
/// that the shader marks RelaxedPrecision (mediump, lowp), which they run in the arithmetic they are named after.
enum class Model : std::uint8_t {
    in_double,
    in_float,      ///< fp32, round to nearest even, subnormals flushed to 0; mediump is fp32 too
    half,          ///< IEEE binary16: round to nearest even, subnormals kept, overflow to inf. What llvmpipe does.
    half_flushed,  ///< the same with subnormal results flushed to 0
    es_minimum,    ///< the least GLSL ES 3.00 (4.5.1) allows: 10 fraction bits, |x| < 2^14 or clamped, 0 below 2^-14
};

inline constexpr std::array kModels{Model::in_double, Model::in_float, Model::half, Model::half_flushed,
                                    Model::es_minimum};

[[nodiscard]] const char* name(Model model);

/// The nearest value that `model`'s narrow format has. A sum, difference, product, quotient or square root of two such
/// values computed in double and then rounded is rounded once: double has more than twice their bits plus two.
/// NaN stays NaN, -0 stays -0.
[[nodiscard]] double rounded(Model model, double x);

/// True for the formats of 11 significant bits.
[[nodiscard]] constexpr bool is_narrow(Model model) {
    return model == Model::half || model == Model::half_flushed || model == Model::es_minimum;
}

/// Bits of the half nearest to x, as the `half` model rounds; every NaN becomes 0x7e00.
[[nodiscard]] std::uint16_t half_bits(double x);
[[nodiscard]] double value_of_half(std::uint16_t bits);

}  // namespace halfframe::shader_ir
