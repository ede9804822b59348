// What a shader stage is made of, counted from its optimised SPIR-V: slots, fetches, normalizes, temporaries, branches.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "perf/shader_ir/module.h"

namespace halfframe::cost {

/// What one instruction asks of the arithmetic units, in the currency of each device.
struct Work {
    double slots = 0.0;       ///< RSX: vec4 slots; 1 and 2 components 0.5, 3 components 0.75, 4 components 1
    double vector_ops = 0.0;  ///< Xenos: instructions of the vec4 unit
    double scalar_ops = 0.0;  ///< Xenos: instructions that the scalar unit can take
    double mads = 0.0;        ///< ES 2 phone: multiply-adds of one component
    double normalizes = 0.0;  ///< RSX: mediump normalizes, which have a unit of their own
    Work& operator+=(const Work& other);
    friend Work operator*(double factor, Work work);
};

/// A sampler that the stage reads.
struct SamplerUse {
    std::string name;
    enum class Shape : std::uint8_t { flat, cube, volume, layers } shape = Shape::flat;
    bool compares = false;  ///< the answer is that of a depth comparison
    bool half = false;      ///< the result is mediump
};

/// One line of the listing.
struct CountedInstruction {
    std::string what;        ///< "mad", "dot", "rcp", "fetch", ...
    std::uint32_t line = 0;  ///< as in shader_ir::Instruction; Module::place() words it
    int components = 0;
    bool half = false;
    Work work;              ///< moves included
    double moves = 0.0;     ///< slots of `work` that only bring a second constant or interpolant
    int sampler = -1;       ///< of a fetch: index into ShaderCounts::samplers
    bool any_level = true;  ///< a fetch that chooses its level by itself
    int block = 0;
    double weight = 1.0;  ///< how often it runs in the weighted path
};

/// Sums over one way through the stage.
struct PathCounts {
    Work work;
    double moves = 0.0;                 ///< slots of `work`
    double instructions = 0.0;          ///< those that cost something, fetches included
    std::vector<double> fetches;        ///< by sampler
    std::vector<double> level_fetches;  ///< those of `fetches` that choose their level by themselves
    [[nodiscard]] double fetch_count() const;
};

/// vec4 temporaries that live at the place where most do.
struct Temporaries {
    int full = 0;
    int half = 0;
    [[nodiscard]] double weighted(double half_weight = 0.5) const { return full + half_weight * half; }
};

struct ShaderCounts {
    std::vector<CountedInstruction> instructions;
    std::vector<SamplerUse> samplers;
    PathCounts shortest, longest, weighted;
    Temporaries temporaries;
    int attributes = 0;  ///< inputs that are read, built-in ones aside
    int branches = 0;    ///< places where the way parts
    int free_modifiers = 0;
    int fused_mads = 0;
    bool discards = false;
    std::string weighting;             ///< the sentence how `weighted` is weighted
    std::vector<std::string> notices;  ///< what was assumed
};

/// Share of the pixels that take each side of a branch.
inline constexpr double kBranchWeight = 0.5;
/// Rounds of a loop whose count is not written in the shader.
inline constexpr double kUnknownRounds = 4.0;

/// Counts `main` of a module that was compiled with Cleaning::optimised. Pure.
[[nodiscard]] ShaderCounts count_shader(const shader_ir::Module& module);

/// Instructions of a device that issues one vec4 and one scalar at a time: max(V, ceil((V + S) / 2)).
[[nodiscard]] double co_issued(const Work& work);

}  // namespace halfframe::cost
