// Runs a plain shader function over thousands of inputs on a real context.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "perf/accuracy/lane_canvas.h"

namespace halfframe::accuracy {

struct DrawnParameter {
    int components = 1;  ///< 1..4
    bool full = false;   ///< highp; else mediump, or what full arithmetic makes of it
};

struct DrawnFunction {
    std::string function;                 ///< its name in the text; what follows a '(' is left out
    std::vector<std::string> files = {};  ///< relative to shaders_es, in the order of inclusion
    std::string more_text = {};           ///< functions behind the files
    std::span<const gl::ShaderFile> available = gl::shader_files();  ///< what there is to include
    gl::Arithmetic arithmetic = gl::Arithmetic::half;
    std::vector<gl::Define> defines = {};
    std::vector<DrawnParameter> parameters = {};
    int returned = 1;  ///< components
};

/// RGBA of every lane: what the function returns, 0 behind it and 1 in alpha where that is free. Parameters are fetched
/// from float textures in highp and handed over in their own precision. Error(check) for text that does not compile.
[[nodiscard]] std::vector<float> draw_function(gl::EntryPoints& gl, const gl::Caps& caps, const DrawnFunction& function,
                                               const std::vector<shader_ir::Columns>& inputs);

}  // namespace halfframe::accuracy
