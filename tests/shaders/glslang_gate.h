// Holds one program to the letter of ES 1.00 or 3.00 and to the smallest limits a device may have, by glslang.
#pragma once

#include <string>
#include <vector>

#include "engine/gl/program.h"

namespace halfframe::shaders {

/// The limits that a program is counted against. glslang itself knows these numbers only as constants.
struct ProgramLimits {
    int attributes = 0;
    int varying_vectors = 0;
    int vertex_uniform_vectors = 0;
    int fragment_uniform_vectors = 0;
    int vertex_samplers = 0;
    int fragment_samplers = 0;
    int combined_samplers = 0;
};

/// OpenGL ES 2.0.25, tables 6.18 to 6.20: the minimum maximums.
inline constexpr ProgramLimits kEs20Minimums{8, 8, 128, 16, 0, 8, 8};
/// OpenGL ES 3.0.6, tables 6.31 to 6.34.
inline constexpr ProgramLimits kEs30Minimums{16, 15, 256, 224, 16, 16, 32};

/// What one program uses, counted as the limits count it. Everything declared counts, used or not: an optimiser that
/// removes more only helps.
using ProgramCounts = ProgramLimits;

/// Both stages of a program as the compiler gets them.
struct ProgramTexts {
    std::string name;  ///< with its variant, for the sentences
    gl::Dialect dialect = gl::Dialect::es300;
    bool fragment_highp = true;  ///< false: the fragment stage may not say highp
    std::string vertex_file;     ///< path in shaders_es, for the sentences
    std::string fragment_file;
    gl::StageText vertex;
    gl::StageText fragment;
};

struct GateReport {
    std::vector<std::string>
        faults;            ///< "program name: sentence", with file and line where there is one; empty: passed
    ProgramCounts counts;  ///< zero when a stage does not compile
};

/// Compiles both stages as version 100 (with none of what its Appendix A leaves optional) or 300 es, links them, counts
/// them against `limits`, and compares the precision of every uniform and varying that both stages declare.
[[nodiscard]] GateReport check_program(const ProgramTexts& program, const ProgramLimits& limits);
/// The minimums of the program's own dialect.
[[nodiscard]] GateReport check_program(const ProgramTexts& program);

/// A variable of an interface, as the packing rules see it.
struct PackedVariable {
    int columns = 1;  ///< components of one row, 1..4
    int rows = 1;     ///< rows of one element times elements
};

/// Rows of four components that the variables need under the packing rules of GLSL ES 1.00, Appendix A.7 (3.00: chapter
/// 11).
[[nodiscard]] int packed_rows(std::vector<PackedVariable> variables);

}  // namespace halfframe::shaders
