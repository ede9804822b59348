// What one call of a shader function costs, alone: for comparing two forms of the same thing.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/gl/program.h"
#include "perf/cost/profile.h"

namespace halfframe::cost {

struct FunctionCall {
    struct Parameter {
        int components = 1;  ///< 1..4
        bool full = false;   ///< highp; else mediump
    };
    std::string function;
    std::vector<Parameter> parameters;
    int returned = 1;                ///< components, 1..4
    std::vector<std::string> paths;  ///< relative to shaders_es; each is included in order
    std::vector<gl::Define> defines;
};

/// Modelled milliseconds of the shading units for one call at each of `pixels` pixels, its parameters interpolated:
/// without targets, memory and draws, which both forms share. Mediump counts as half. Error(check) for text that does
/// not compile.
[[nodiscard]] double modelled_ms(const FunctionCall& call, const Profile& profile, double pixels,
                                 std::span<const gl::ShaderFile> files = gl::shader_files());

}  // namespace halfframe::cost
