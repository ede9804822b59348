// Which shader functions are measured: over which inputs, against which reference, and how far each may be off.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/frame/tier.h"
#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "perf/shader_ir/evaluate.h"

namespace halfframe::accuracy {

struct Argument {
    std::string name;
    shader_ir::Columns values;  ///< one array per scalar, all of one length
};

/// The arguments of one lane.
class Lane {
public:
    Lane(const std::vector<Argument>& arguments, std::size_t lane) : arguments_(arguments), lane_(lane) {}
    [[nodiscard]] double operator()(std::size_t argument, std::size_t scalar = 0) const {
        return arguments_[argument].values[scalar][lane_];
    }
    [[nodiscard]] std::size_t number() const { return lane_; }

private:
    const std::vector<Argument>& arguments_;
    std::size_t lane_;
};

/// A figure of one scalar of the result in one lane.
using PerScalar = std::function<double(const Lane& lane, std::size_t scalar)>;

/// All results, one array per scalar, of what is no plain function: a whole stage, or what the device does by itself.
using InModel = std::function<shader_ir::Columns(const std::vector<Argument>& arguments, shader_ir::Model model)>;
using OnContext = std::function<shader_ir::Columns(const std::vector<Argument>& arguments, gl::EntryPoints& gl,
                                                   const gl::Caps& caps, Arithmetic arithmetic)>;

enum class Unit : std::uint8_t {
    absolute,       ///< difference; for values within 0..1
    of_peak,        ///< difference over FunctionEntry::peak
    display_codes,  ///< 255 times the difference of display values
    light_codes,    ///< display codes behind the tone curve (its reference), for linear light
};
[[nodiscard]] const char* name(Unit unit);

/// Largest error allowed, in the entry's unit, and what causes an error of that size.
struct Bound {
    double at_most = 0.0;
    const char* reason = "";
};

struct FunctionEntry {
    std::string effect;
    std::string function;            ///< its name in the text
    std::vector<std::string> files;  ///< relative to shaders_es, in the order of inclusion
    Tier tier = Tier::console;
    Arithmetic arithmetic = Arithmetic::half;
    const char* domain = "";  ///< the inputs, for a reader
    std::function<std::vector<Argument>()> arguments;
    InModel in_model = {};      ///< instead of a call of `function`
    OnContext on_context = {};  ///< goes with in_model
    PerScalar reference;
    Unit unit = Unit::absolute;
    PerScalar peak = {};  ///< > 0; only of Unit::of_peak
    Bound method;         ///< reference against shader, both in double
    Bound in_float;       ///< shader in fp32 against the shader in double, like the next two
    Bound half;
    Bound flushed;  ///< half without subnormals, and the ES minimum
    /// A real context, where the models' bounds are not its own: nothing is as `half` (or `flushed`) and `in_float`.
    std::optional<Bound> here_mediump = std::nullopt;
    std::optional<Bound> here_highp = std::nullopt;
};

/// Every function that is measured, of the effects that are in this build, in the order of all_effects().
[[nodiscard]] std::vector<FunctionEntry> function_list();

// The parts of that list, in or out of the build.
[[nodiscard]] std::vector<FunctionEntry> depth_prepass_functions();
[[nodiscard]] std::vector<FunctionEntry> environment_functions();
[[nodiscard]] std::vector<FunctionEntry> shadow_functions();
[[nodiscard]] std::vector<FunctionEntry> anti_alias_functions();
[[nodiscard]] std::vector<FunctionEntry> bloom_functions();
[[nodiscard]] std::vector<FunctionEntry> sky_functions();
[[nodiscard]] std::vector<FunctionEntry> surface_functions();
[[nodiscard]] std::vector<FunctionEntry> surface_material_functions();  ///< part of surface_functions()
[[nodiscard]] std::vector<FunctionEntry> tone_map_functions();
[[nodiscard]] std::vector<FunctionEntry> transparent_functions();
[[nodiscard]] std::vector<FunctionEntry> wet_surface_functions();
[[nodiscard]] std::vector<FunctionEntry> puddles_functions();

}  // namespace halfframe::accuracy
