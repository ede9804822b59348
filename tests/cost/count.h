// Short ways to count a few lines of GLSL.
#pragma once

#include <string>

#include "perf/cost/shader_counts.h"
#include "perf/shader_ir/compile.h"

namespace halfframe::cost {

/// The module of a fragment shader whose text after the precision statements is `text`.
inline shader_ir::Module module_of(const std::string& text, bool half = false) {
    const std::string precision = half ? "mediump" : "highp";
    const gl::StageText stage{"#version 300 es\nprecision " + precision + " float;\nprecision " + precision +
                                  " sampler2D;\nprecision " + precision + " sampler3D;\n#line 1 0\n" + text,
                              {"<test>"}};
    return shader_ir::compile(stage, gl::Stage::fragment, shader_ir::Cleaning::optimised);
}

inline ShaderCounts counts_of(const std::string& text, bool half = false) {
    return count_shader(module_of(text, half));
}

/// main() that computes `expression` (a vec4) from interpolants a, b, c (vec4) and constants u, v (vec4).
inline ShaderCounts counts_of_expression(const std::string& expression, bool half = false) {
    return counts_of(
        "in vec4 a; in vec4 b; in vec4 c; uniform vec4 u; uniform vec4 v; uniform sampler2D image;\n"
        "out vec4 color;\nvoid main() { color = " +
            expression + "; }\n",
        half);
}

}  // namespace halfframe::cost
