// GLSL round a function that is not plain: everything it gets becomes a float or a vector, everything it gives too.
#pragma once

#include <string>
#include <string_view>

#include "perf/stability/declaration.h"

namespace halfframe::stability {

/// One float or vector of the call: a component of the batch's columns.
struct Piece {
    std::string name;            ///< in GLSL
    std::size_t parameter = 0;   ///< of Declaration::parameters
    std::size_t first = 0;       ///< its first component there
    int components = 0;
    bool full = false;
};

/// What a call is handed, in order: parameters as they are where the function is plain.
[[nodiscard]] std::vector<Piece> pieces_of(const Declaration& function);

/// "highp vec3 given_n, float given_x".
[[nodiscard]] std::string pieces_text(const Declaration& function);

/// Statements that make what the declaration calls by name out of the pieces; empty where the function is plain.
[[nodiscard]] std::string unpacked(const Declaration& function);

/// How many functions return the results, at most four components each, and their names.
[[nodiscard]] std::size_t calls_of(const Declaration& function);
[[nodiscard]] std::string call_name(std::size_t call);
/// Those functions; empty where the function is plain.
[[nodiscard]] std::string calls_text(const Declaration& function);

/// What stands before the file of a function that reads variables: uniforms, varyings and attributes become plain
/// variables, a texture two texels side by side, split at 0.5 of the first coordinate. And what ends that.
[[nodiscard]] std::string outside_begins(const Declaration& function);
[[nodiscard]] const char* outside_ends();
/// The file's text with what only a whole stage may say left out: #version, precisions of samplers, gl_Position and
/// gl_FragColor as variables. Lines stay where they are.
[[nodiscard]] std::string without_stage(std::string_view text);
/// Does the text need that: has it a main() or a #version?
[[nodiscard]] bool is_stage(std::string_view text);

}  // namespace halfframe::stability
