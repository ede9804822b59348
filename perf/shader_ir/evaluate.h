// Runs any function of a Module over thousands of inputs at once.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "perf/shader_ir/module.h"
#include "perf/shader_ir/precision.h"

namespace halfframe::shader_ir {

/// One array per scalar of a value, in the order of Type: the inputs of all lanes. An array of one number is the same
/// for every lane; all others have the same length. Booleans are 0 and 1.
using Columns = std::vector<std::vector<double>>;

/// What a shader asks of a texture, for one lane.
struct SampleRequest {
    std::array<double, 4> at{};  ///< coordinates (already divided, where projective), the layer of an array behind them
    bool texel_fetch = false;    ///< `at` is in texels
    std::optional<double> lod;   ///< explicit level; absent: the level is the sampler's choice
    double bias = 0.0;
    std::optional<std::array<double, 6>> gradient;  ///< d/dx of up to three coordinates, then d/dy
    std::array<int, 3> offset{};                    ///< [texels]
    std::optional<double> reference;                ///< of shadow samplers
};

/// A texture on the CPU. What it returns is rounded to the sampler's precision.
struct Sampler {
    std::function<std::array<double, 4>(const SampleRequest&)> sample;
    std::function<std::array<int, 3>(int lod)> size;  ///< for textureSize; may be empty
};

/// Is told every float result of the first lane, in the order of the work: the instruction's line and its scalars.
using ResultWatch = std::function<void(std::uint32_t line, std::span<const double> scalars)>;

/// What stands outside the function, by the name in the text. Uniforms, inputs and outputs keep 32 bits, whatever their
/// precision: a mediump one is rounded where a mediump operation uses it.
struct Bindings {
    std::map<std::string, Columns, std::less<>> variables;  ///< uniforms and inputs
    /// Also by the name of a sampler parameter. Of an array: "images" for all elements, "images[2]" for one.
    std::map<std::string, Sampler, std::less<>> samplers;
    ResultWatch watch;  ///< may be empty
};

struct Evaluation {
    Columns returned;                                     ///< empty for void; NaN or 0 in lanes that were discarded
    std::vector<Columns> parameters;                      ///< after the call; changed for out and inout
    std::map<std::string, Columns, std::less<>> outputs;  ///< every output variable; NaN where nothing was written
    std::vector<bool> discarded;                          ///< per lane
};

/// Runs `function` (see Module::function) once per lane. `inputs` has an entry per parameter; leave that of an out or a
/// sampler parameter empty. The number of lanes is the length of the longest array.
/// Error(check) with our file and line: an instruction that cannot be evaluated on its own (dFdx), a variable that is
/// read and was not given, an index outside its array, a loop without end. Mistake: inputs that do not fit the
/// function.
[[nodiscard]] Evaluation evaluate(const Module& module, std::string_view function, std::span<const Columns> inputs,
                                  Model model, const Bindings& bindings = {});

}  // namespace halfframe::shader_ir
