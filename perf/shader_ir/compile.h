// GLSL ES text to a Module, through glslang and SPIRV-Tools.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/gl/program.h"
#include "perf/shader_ir/module.h"

namespace halfframe::shader_ir {

enum class Cleaning {
    none,     ///< as glslang writes it: every variable, every function, every temporary
    inlined,  ///< one function, variables turned into values, dead code gone. Names of functions are lost, save main.
    /// As a shader compiler of a device would leave it: also loops with known counts unrolled, constants folded, small
    /// branches turned into selections, what is computed twice computed once. This is the form that is counted.
    optimised,
};

/// Names and versions of what makes the SPIR-V: counts change with them, so they stand beside every count.
[[nodiscard]] std::string compiler_versions();

/// Compiles one stage. The text must be ES 3.00 (`#version 300 es`): glslang reads it as 3.10, the first version that
/// it turns into SPIR-V, which is a superset. Names, lines and precisions are kept. Error(check) naming our file and
/// line for text that does not compile.
[[nodiscard]] Module compile(const gl::StageText& text, gl::Stage stage, Cleaning cleaning = Cleaning::none);

/// Compiles a fragment stage as ES 1.00, to nothing: Error(check) naming file and line for text that is not.
void check_es100(const gl::StageText& text);

/// Assembles and compiles a stage of a program. Always in the ES 3.00 dialect: a description in ES 1.00 gives its
/// ES 3.00 twin and a Module that says `up_converted`.
[[nodiscard]] Module compile(const gl::ProgramDescription& description, gl::Stage stage,
                             Cleaning cleaning = Cleaning::none,
                             std::span<const gl::ShaderFile> files = gl::shader_files());

/// Compiles .glsl files of plain functions into a fragment stage with an empty main, to evaluate the functions alone.
/// `paths` are relative to shaders_es; each is included in order.
struct FunctionFiles {
    std::vector<std::string> paths = {};
    gl::Arithmetic arithmetic = gl::Arithmetic::half;
    std::vector<gl::Define> defines = {};
    std::string more_text = {};  ///< further functions, behind the files; errors name it "<more text>"
};
[[nodiscard]] Module compile(const FunctionFiles& wanted, std::span<const gl::ShaderFile> files = gl::shader_files());

}  // namespace halfframe::shader_ir
