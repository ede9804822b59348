// Tries a function with every input of a source in the five models and on a context, and keeps what went worst.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "perf/measure/precision_probe.h"
#include "perf/stability/criterion.h"
#include "perf/stability/inputs.h"

namespace halfframe::stability {

/// One input and what came of it.
struct Finding {
    std::vector<double> input;  ///< as Batch::lane()
    std::size_t component = 0;  ///< of the result
    double expected = 0.0;      ///< in double
    double got = 0.0;
    double allowed = 0.0;
    double ratio = -1.0;  ///< error over allowed; infinite for a result that is not finite. -1: nothing was found
};

struct BrokenPromise {
    std::string promise;
    std::size_t lanes = 0;
    Finding first;
};

/// What one arithmetic did.
struct Tally {
    std::string arithmetic;                                ///< a model's name, "mediump here" or "highp here"
    shader_ir::Model model = shader_ir::Model::in_double;  ///< whose criterion it is held to
    std::size_t lanes = 0;
    std::size_t not_finite = 0;  ///< lanes of finite inputs with a result that is NaN or inf
    std::size_t over = 0;        ///< lanes over the criterion
    Finding worst;
    std::vector<BrokenPromise> broken;
    double at_most = 1.0;  ///< times the criterion: above 1 by exemption
    [[nodiscard]] bool holds() const { return not_finite == 0 && worst.ratio <= at_most && broken.empty(); }
};

/// Largest error along one component of the inputs, for a drawing.
struct Strip {
    static constexpr std::size_t kBins = 128;
    std::string parameter;
    std::vector<double> at;                   ///< where each bin begins, kBins + 1 numbers
    std::vector<double> allowed;              ///< the least the criterion allows in a bin; infinite where none fell
    std::vector<std::vector<double>> errors;  ///< for each of kModels but double; -1 where nothing fell
};

/// A step of the worst input: the same operation in double and in the model.
struct Step {
    std::string place;  ///< "surface/surface.glsl:41"
    std::string text;   ///< of that line
    std::vector<double> in_double;
    std::vector<double> in_model;
};

struct FunctionStability {
    Declaration function;
    std::string title;
    std::string variant;
    std::string method;  ///< how inputs were chosen
    std::size_t lanes = 0;
    std::size_t near_jump = 0;  ///< lanes whose error was not judged
    std::vector<Tally> tallies;
    Strip strip;
    std::vector<Step> steps;  ///< of the model that is worst against what it may
    std::vector<std::string> violations;
    [[nodiscard]] const Tally& worst() const;
    [[nodiscard]] bool portable() const;  ///< holds in all five models without an exemption
};

/// A context that draws functions.
struct Drawing {
    gl::EntryPoints& gl;
    const gl::Caps& caps;
    perf::PrecisionProbe probe;
};

/// `step` is called before each batch with the inputs done: for progress, and to stop by throwing.
[[nodiscard]] FunctionStability search(const Subject& subject, const Effort& effort, const Drawing* drawing,
                                       const std::function<void(std::size_t done, std::size_t planned)>& step = {});

/// Times the criterion, per lane: infinite where a result is not finite or a promise is broken.
[[nodiscard]] std::vector<double> badness(const Subject& subject, const Batch& batch, shader_ir::Model model);

/// A simpler input that is still over `limit`: components become 0, 1, or lose trailing bits, as long as it is.
[[nodiscard]] std::vector<double> shrunk(const Subject& subject, std::vector<double> input, shader_ir::Model model,
                                         double limit);

/// The operations of one input side by side, up to where the paths part.
[[nodiscard]] std::vector<Step> steps_of(const Subject& subject, const std::vector<double>& input,
                                         shader_ir::Model model);

/// "n = (0, 1, 0), power = 2048"
[[nodiscard]] std::string input_text(const Declaration& function, const std::vector<double>& input);

}  // namespace halfframe::stability
