// A shader in memory: the one form that is evaluated, and that can be counted.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <glslang/SPIRV/spirv.hpp>

namespace halfframe::shader_ir {

using Id = std::uint32_t;

/// A type. Values of it are `scalars` numbers in a row: columns of a matrix one after the other, elements of an array,
/// members of a structure. A sampler is one number, its place in a list.
struct Type {
    enum class Kind : std::uint8_t {
        none,
        boolean,
        integer,
        floating,
        vector,
        matrix,
        array,
        structure,
        pointer,
        sampler
    };
    Kind kind = Kind::none;
    Id element = 0;           ///< of vectors (scalar), matrices (column), arrays; what a pointer points to
    std::uint32_t count = 0;  ///< elements
    std::uint32_t scalars = 0;
    bool is_signed = false;  ///< of integers
    std::vector<Id> members = {};
    std::vector<bool> float_leaf = {};    ///< per scalar: it is a float
    std::vector<bool> relaxed_leaf = {};  ///< per scalar: a member that holds it is decorated RelaxedPrecision
    spv::StorageClass storage = spv::StorageClassMax;  ///< of pointers
    std::uint32_t coordinates = 0;                     ///< of samplers: how many numbers say where, the layer included
    std::uint32_t directions = 0;                      ///< of samplers: the same without the layer
    spv::Dim dimension = spv::Dim2D;                   ///< of samplers
    bool compares = false;                             ///< of samplers: answers a comparison with a depth
};

/// `operands` are the words after the result: ids and literals, as the SPIR-V specification lists them.
struct Instruction {
    spv::Op op = spv::OpNop;
    Id type = 0;
    Id result = 0;
    bool relaxed = false;       ///< decorated RelaxedPrecision: may run in half
    std::uint32_t line = 0;     ///< of the assembled text's #line directives; 0 unknown
    std::uint32_t ordinal = 0;  ///< place in the module, counted in instructions
    std::vector<std::uint32_t> operands;
};

/// Instructions up to a terminator, which is the last. Merge instructions stay where they stood and do nothing.
struct Block {
    Id label = 0;
    std::vector<Instruction> instructions;
};

struct Parameter {
    Id id = 0;
    Id type = 0;
};

struct Function {
    Id id = 0;
    std::string name;  ///< as glslang mangles it: "tone_map(vf3;"; "main" or "main(" for the entry point
    Id return_type = 0;
    bool relaxed = false;  ///< what it returns is rounded
    std::vector<Parameter> parameters;
    std::vector<Block> blocks;           ///< the first is the entry
    std::map<Id, std::size_t> block_at;  ///< by label
};

struct Constant {
    Id type = 0;
    std::vector<double> scalars;
};

/// A variable outside all functions.
struct Variable {
    Id id = 0;
    Id type = 0;          ///< what it holds
    Id pointer_type = 0;  ///< of the id itself
    spv::StorageClass storage = spv::StorageClassMax;
    std::string name;  ///< as in the text; of a built-in: "gl_FragCoord" and the like
    Id initializer = 0;
};

/// One stage. Made by compile(); plain data from there on.
struct Module {
    std::vector<std::uint32_t> words;  ///< the SPIR-V it came from
    std::vector<std::string> files;    ///< as in gl::StageText: what the #line directives number
    bool up_converted = false;         ///< the description asked for ES 1.00; this is its ES 3.00 twin

    Id bound = 0;  ///< every id is below
    std::uint32_t instruction_count = 0;
    std::map<Id, Type> types;
    std::map<Id, Constant> constants;
    std::vector<Variable> variables;
    std::vector<Function> functions;
    std::map<Id, std::string> names;
    std::vector<bool> relaxed;  ///< per id
    Id standard_functions = 0;  ///< the import "GLSL.std.450"

    /// By mangled name, or by plain name where no overload shares it. Mistake that lists what there is otherwise.
    [[nodiscard]] const Function& function(std::string_view name) const;
    [[nodiscard]] const Function& function(Id id) const;
    [[nodiscard]] const Type& type(Id id) const { return types.at(id); }
    /// "surface/surface.glsl:41", or "an unknown line".
    [[nodiscard]] std::string place(std::uint32_t line) const;
    /// The instruction as SPIRV-Tools writes it: "%12 = OpDPdx %float %11".
    [[nodiscard]] std::string text_of(const Instruction& instruction) const;
};

/// Reads SPIR-V words that a validator accepted. Error(check) for what no ES shader has, naming instruction and line.
[[nodiscard]] Module parse(std::vector<std::uint32_t> words, std::vector<std::string> files);

}  // namespace halfframe::shader_ir
