// What the comments above a shader function say: over which inputs it is meant to work, and what it promises there.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/gl/program.h"
#include "perf/shader_ir/precision.h"

namespace halfframe::stability {

/// The inputs a parameter may get.
struct Domain {
    enum class Kind : std::uint8_t {
        missing,  ///< nothing is declared
        range,    ///< every component within low..high
        unit,     ///< a direction: length 1, as its precision holds it
        any,      ///< every value there is, NaN and inf included
    };
    Kind kind = Kind::missing;
    double low = 0.0, high = 0.0;
};

struct DeclaredParameter {
    std::string name;
    std::string text;          ///< as in the signature: "FULL vec3 n"
    std::string type;          ///< "vec3", without the size of an array
    int components = 0;        ///< scalars of all of it; 0: a type that nothing can be given for
    int piece = 0;             ///< components of each number or vector that it is made of, 1..4: a column, an element
    int elements = 0;          ///< of an array; 0: it is none
    bool full = false;         ///< FULL or highp
    bool half = false;         ///< HALF, mediump or lowp: said, not left to the stage
    bool whole = false;        ///< int, uint, bool and vectors of them: no precision is lost, and no half is between
    bool handed_in = true;     ///< false: out
    bool handed_back = false;  ///< out or inout
    bool outside = false;      ///< no parameter: a uniform, a varying, an attribute or a texture that is read
    Domain domain;
    [[nodiscard]] int pieces() const { return piece == 0 ? 0 : components / piece; }
    [[nodiscard]] bool is_sampler() const { return type.find("ampler") != std::string::npos; }
};

struct Promise {
    enum class Kind : std::uint8_t {
        finite,   ///< the result is finite whatever comes in, NaN and inf too
        within,   ///< every component of the result in low..high
        error,    ///< at most `high` from the result in double, however ill-conditioned
        rising,   ///< never falls by more than 2 steps of the result while `parameter` grows
        falling,  ///< never rises by more than that
        holds,    ///< a GLSL condition over the parameters, `result` and `slack`
    };
    Kind kind = Kind::holds;
    std::string text;  ///< as written
    double low = 0.0, high = 0.0;
    std::size_t parameter = 0;
    std::string condition;  ///< GLSL; only of Kind::holds
};

/// A model that may exceed the criterion, and how far.
struct Exemption {
    std::vector<shader_ir::Model> models;
    double at_most = 1.0;  ///< times the criterion
    std::string within;    ///< GLSL over the parameters: an error that is allowed at least; may be empty
    std::string reason;
    [[nodiscard]] std::string bound() const;  ///< "up to 3 times", "up to 0.002 off"
};

struct Declaration {
    std::string file;  ///< relative to shaders_es
    int line = 0;      ///< of the signature
    std::string name;
    std::string returned_type;
    int returned = 0;           ///< components of all that comes back; 0: nothing that can be judged
    bool returns_full = false;  ///< all of it is FULL or whole
    std::vector<DeclaredParameter> signature;   ///< as written
    std::vector<DeclaredParameter> parameters;  ///< what it gets: what is handed in, and what it reads from outside
    std::vector<DeclaredParameter> written;     ///< variables outside that it writes, as //@writes says
    bool vertex = false;                        ///< of the vertex stage: floats are highp unless it says otherwise
    std::vector<std::string> variants;  ///< sets of defines, separated by spaces; TIER_CONSOLE where none is named
    std::vector<Promise> promises;
    std::vector<std::string> jumps;  ///< GLSL; where one of these changes its value, the function may jump
    std::string where;               ///< GLSL; inputs outside are none
    std::vector<Exemption> exemptions;
    std::string not_run;  ///< why the function is not run on its own; empty: it is

    /// "surface/surface.glsl:41"
    [[nodiscard]] std::string place() const;
    /// Floats and vectors in, one of them back, and nothing outside: it can be called as it is.
    [[nodiscard]] bool plain() const;
    /// As glslang mangles a plain one: "storable(vf3;f1;".
    [[nodiscard]] std::string mangled() const;
    /// The exemption of a model, or nullptr.
    [[nodiscard]] const Exemption* exemption(shader_ir::Model model) const;
};

/// Every function but main that `text` defines, with what the comment lines right above each say. The lines:
///
///     //@variant TIER_LOW                        one set of defines to run it with; may be repeated
///     //@domain x: 0..1; n: unit; a: any; where x > a
///     //@promise finite; in 0..1; error 0.004; rising x; falling x; where x == 0.0: result == 0.0
///     //@jumps floor(8.0 * x)
///     //@exempt half_flushed, es_minimum: at most 12 times; the reason
///     //@exempt half: within 0.001 * reach_m; the reason
///     //@not_run the reason
///     //@stage vertex
///     //@writes highp vec4 bone_x; vec3 light
///
/// A domain with a type is of something outside that the function reads: `vec4 terms[9]: -64..64`, `sampler2D map: 0..1`.
/// Functions without any line have parameters of Domain::Kind::missing. Error(check) with file and line for a line that
/// cannot be read, or a parameter that does not exist.
[[nodiscard]] std::vector<Declaration> functions_of(std::string_view path, std::string_view text);

/// Reads "x: 0..1; n: unit" into the parameters, as //@domain does.
void declare_domain(Declaration& function, std::string_view text);

/// Why `function` says too little to be run, as a sentence; empty when it says enough.
[[nodiscard]] std::string gap_in(const Declaration& function);

/// All functions of these files but those of `main`, in the order of the list.
[[nodiscard]] std::vector<Declaration> all_functions(std::span<const gl::ShaderFile> files = gl::shader_files());

}  // namespace halfframe::stability
