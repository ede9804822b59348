// SPIR-V words to a Module.
#define SPV_ENABLE_UTILITY_CODE  // which instructions have a type and a result
#include "perf/shader_ir/module.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <spirv-tools/libspirv.hpp>
#include <sstream>

#include "engine/error.h"
#include "engine/gl/program.h"

namespace halfframe::shader_ir {
namespace {

using Kind = Type::Kind;

/// A string literal: bytes of words, closed by a zero byte.
std::string text_at(const std::vector<std::uint32_t>& words, std::size_t first) {
    std::string text;
    for (std::size_t i = first; i < words.size(); ++i) {
        for (int byte = 0; byte < 4; ++byte) {
            const char letter = static_cast<char>((words[i] >> (8 * byte)) & 0xffu);
            if (letter == '\0') return text;
            text += letter;
        }
    }
    return text;
}

const char* name_of_built_in(std::uint32_t built_in) {
    switch (built_in) {
        case spv::BuiltInPosition: return "gl_Position";
        case spv::BuiltInPointSize: return "gl_PointSize";
        case spv::BuiltInFragCoord: return "gl_FragCoord";
        case spv::BuiltInPointCoord: return "gl_PointCoord";
        case spv::BuiltInFrontFacing: return "gl_FrontFacing";
        case spv::BuiltInFragDepth: return "gl_FragDepth";
        case spv::BuiltInVertexId:
        case spv::BuiltInVertexIndex: return "gl_VertexID";
        case spv::BuiltInInstanceId:
        case spv::BuiltInInstanceIndex: return "gl_InstanceID";
        default: return nullptr;
    }
}

class Parser {
public:
    explicit Parser(Module& module) : module_(module) {}

    void run() {
        constexpr std::size_t kHeaderWords = 5;
        module_.bound = module_.words.at(3);
        module_.relaxed.assign(module_.bound, false);
        std::uint32_t ordinal = 0;
        for (std::size_t at = kHeaderWords; at < module_.words.size();) {
            const std::uint32_t length = module_.words[at] >> spv::WordCountShift;
            const auto begin = module_.words.begin() + static_cast<std::ptrdiff_t>(at);
            read(Instruction{.op = static_cast<spv::Op>(module_.words[at] & spv::OpCodeMask),
                             .line = line_,
                             .ordinal = ordinal++,
                             .operands = {begin + 1, begin + length}});
            at += length;
        }
        module_.instruction_count = ordinal;
        std::stable_sort(module_.variables.begin(), module_.variables.end(),
                         [](const Variable& one, const Variable& other) { return one.name < other.name; });
    }

private:
    void read(Instruction one) {
        bool has_result = false;
        bool has_type = false;
        spv::HasResultAndType(one.op, &has_result, &has_type);
        std::size_t taken = 0;
        if (has_type) one.type = one.operands.at(taken++);
        if (has_result) one.result = one.operands.at(taken++);
        one.operands.erase(one.operands.begin(), one.operands.begin() + static_cast<std::ptrdiff_t>(taken));
        one.relaxed = one.result != 0 && module_.relaxed.at(one.result);
        if (one.op == spv::OpLine) {
            line_ = one.operands.at(1);
        } else if (one.op == spv::OpNoLine) {
            line_ = 0;
        } else if (block_ != nullptr && one.op != spv::OpFunctionEnd && one.op != spv::OpLabel) {
            block_->instructions.push_back(std::move(one));
        } else if (!read_annotation(one) && !read_type(one) && !read_constant(one)) {
            read_structure(one);
        }
    }

    bool read_annotation(const Instruction& one) {
        switch (one.op) {
            case spv::OpName: module_.names[one.operands.at(0)] = text_at(one.operands, 1); return true;
            case spv::OpExtInstImport:
                if (text_at(one.operands, 0) == "GLSL.std.450") module_.standard_functions = one.result;
                return true;
            case spv::OpDecorate:
                if (one.operands.at(1) == spv::DecorationRelaxedPrecision) module_.relaxed.at(one.operands[0]) = true;
                if (one.operands.at(1) == spv::DecorationBuiltIn) built_in_[one.operands[0]] = one.operands.at(2);
                return true;
            case spv::OpMemberDecorate:
                if (one.operands.at(2) == spv::DecorationRelaxedPrecision)
                    relaxed_member_[one.operands[0]].push_back(one.operands.at(1));
                if (one.operands.at(2) == spv::DecorationBuiltIn) built_in_member_[one.operands[0]] = true;
                return true;
            default: return false;
        }
    }

    Type made_of(Kind kind, Id element, std::uint32_t count) const {
        const Type& inner = module_.type(element);
        Type type{.kind = kind, .element = element, .count = count, .scalars = inner.scalars * count};
        for (std::uint32_t i = 0; i < count; ++i) append_leaves(type, inner, false);
        return type;
    }

    static void append_leaves(Type& type, const Type& inner, bool relaxed) {
        type.float_leaf.insert(type.float_leaf.end(), inner.float_leaf.begin(), inner.float_leaf.end());
        for (const bool leaf : inner.relaxed_leaf) type.relaxed_leaf.push_back(leaf || relaxed);
    }

    static Type scalar(Kind kind) {
        return {
            .kind = kind, .count = 1, .scalars = 1, .float_leaf = {kind == Kind::floating}, .relaxed_leaf = {false}};
    }

    bool read_type(const Instruction& one) {
        Type type;
        switch (one.op) {
            case spv::OpTypeVoid:
            case spv::OpTypeFunction:
            case spv::OpTypeRuntimeArray: break;  // of storage buffers, which nothing uses: refuse_uncounted()
            case spv::OpTypeBool: type = scalar(Kind::boolean); break;
            case spv::OpTypeInt:
                type = scalar(Kind::integer);
                type.is_signed = one.operands.at(1) != 0;
                break;
            case spv::OpTypeFloat: type = scalar(Kind::floating); break;
            case spv::OpTypeVector: type = made_of(Kind::vector, one.operands.at(0), one.operands.at(1)); break;
            case spv::OpTypeMatrix: type = made_of(Kind::matrix, one.operands.at(0), one.operands.at(1)); break;
            case spv::OpTypeArray:
                type = made_of(Kind::array, one.operands.at(0),
                               static_cast<std::uint32_t>(module_.constants.at(one.operands.at(1)).scalars.at(0)));
                break;
            case spv::OpTypeStruct: type = structure(one); break;
            case spv::OpTypePointer:
                type = {.kind = Kind::pointer,
                        .element = one.operands.at(1),
                        .storage = static_cast<spv::StorageClass>(one.operands.at(0))};
                break;
            case spv::OpTypeImage: type = image(one); break;
            case spv::OpTypeSampledImage: type = module_.type(one.operands.at(0)); break;
            default: return false;
        }
        module_.types[one.result] = std::move(type);
        return true;
    }

    Type structure(const Instruction& one) const {
        Type type{.kind = Kind::structure, .count = static_cast<std::uint32_t>(one.operands.size())};
        type.members = one.operands;
        const auto relaxed = relaxed_member_.find(one.result);
        for (std::uint32_t i = 0; i < type.count; ++i) {
            const Type& inner = module_.type(type.members[i]);
            type.scalars += inner.scalars;
            append_leaves(type, inner,
                          relaxed != relaxed_member_.end() &&
                              std::find(relaxed->second.begin(), relaxed->second.end(), i) != relaxed->second.end());
        }
        return type;
    }

    static Type image(const Instruction& one) {
        Type type = scalar(Kind::sampler);
        const auto dimension = static_cast<spv::Dim>(one.operands.at(1));
        type.directions = dimension == spv::Dim1D ? 1 : dimension == spv::Dim2D ? 2 : 3;
        type.coordinates = type.directions + (one.operands.at(3) != 0 ? 1 : 0);
        type.dimension = dimension;
        type.compares = one.operands.at(2) == 1;
        return type;
    }

    bool read_constant(const Instruction& one) {
        Constant constant{.type = one.type, .scalars = {}};
        switch (one.op) {
            case spv::OpConstantTrue: constant.scalars = {1.0}; break;
            case spv::OpConstantFalse: constant.scalars = {0.0}; break;
            case spv::OpConstant: constant.scalars = {number(module_.type(one.type), one.operands.at(0))}; break;
            case spv::OpConstantNull:
            case spv::OpUndef: constant.scalars.assign(module_.type(one.type).scalars, 0.0); break;
            case spv::OpConstantComposite:
                for (const Id part : one.operands) {
                    const std::vector<double>& scalars = module_.constants.at(part).scalars;
                    constant.scalars.insert(constant.scalars.end(), scalars.begin(), scalars.end());
                }
                break;
            default: return false;
        }
        module_.constants[one.result] = std::move(constant);
        return true;
    }

    static double number(const Type& type, std::uint32_t word) {
        if (type.kind == Kind::floating) return static_cast<double>(std::bit_cast<float>(word));
        return type.is_signed ? static_cast<double>(static_cast<std::int32_t>(word)) : static_cast<double>(word);
    }

    std::string name(Id id) const {
        const auto found = module_.names.find(id);
        return found != module_.names.end() ? found->second : std::string();
    }

    void read_variable(const Instruction& one) {
        const Type& pointer = module_.type(one.type);
        Variable variable{.id = one.result,
                          .type = pointer.element,
                          .pointer_type = one.type,
                          .storage = pointer.storage,
                          .name = name(one.result),
                          .initializer = one.operands.size() > 1 ? one.operands[1] : 0};
        const auto built_in = built_in_.find(one.result);
        const char* spelled = built_in != built_in_.end() ? name_of_built_in(built_in->second) : nullptr;
        if (spelled != nullptr) variable.name = spelled;
        // gl_PerVertex is a nameless block; what shaders write there is its first member, gl_Position.
        if (built_in_member_.contains(pointer.element)) variable.name = "gl_PerVertex";
        module_.variables.push_back(std::move(variable));
    }

    void read_structure(const Instruction& one) {
        switch (one.op) {
            case spv::OpVariable: read_variable(one); break;
            case spv::OpFunction:
                module_.functions.push_back({.id = one.result,
                                             .name = name(one.result),
                                             .return_type = one.type,
                                             .relaxed = one.relaxed,
                                             .parameters = {},
                                             .blocks = {},
                                             .block_at = {}});
                break;
            case spv::OpFunctionParameter: module_.functions.back().parameters.push_back({one.result, one.type}); break;
            case spv::OpLabel: {
                Function& function = module_.functions.back();
                function.block_at[one.result] = function.blocks.size();
                function.blocks.push_back({one.result, {}});
                block_ = &function.blocks.back();
                break;
            }
            case spv::OpFunctionEnd: block_ = nullptr; break;
            default: break;  // capabilities, sources, strings, execution modes, layouts: nothing that computes
        }
    }

    Module& module_;
    Block* block_ = nullptr;
    std::uint32_t line_ = 0;
    std::map<Id, std::uint32_t> built_in_;
    std::map<Id, bool> built_in_member_;
    std::map<Id, std::vector<std::uint32_t>> relaxed_member_;
};

}  // namespace

const Function& Module::function(std::string_view name) const {
    const Function* found = nullptr;
    bool several = false;
    std::string known;
    for (const Function& one : functions) {
        known += ' ' + one.name;
        const bool plain = one.name.substr(0, one.name.find('(')) == name;
        if (one.name == name) return one;
        several = several || (plain && found != nullptr);
        if (plain) found = &one;
    }
    expect(found != nullptr && !several,
           [&] { return fmt::format("no one function {} in the module, which has:{}", name, known); });
    return *found;
}

const Function& Module::function(Id id) const {
    const auto found =
        std::find_if(functions.begin(), functions.end(), [&](const Function& one) { return one.id == id; });
    expect(found != functions.end(), "a call of a function that the module does not have");
    return *found;
}

std::string Module::place(std::uint32_t line) const {
    const std::uint32_t file = line / gl::kLinesPerFile;
    if (line == 0 || file >= files.size()) return "an unknown line";
    return fmt::format("{}:{}", files[file], line % gl::kLinesPerFile);
}

std::string Module::text_of(const Instruction& instruction) const {
    std::string all;
    const spvtools::SpirvTools tools(SPV_ENV_OPENGL_4_5);
    if (!tools.Disassemble(words, &all, SPV_BINARY_TO_TEXT_OPTION_NO_HEADER)) return "an instruction";
    // Counted from the end: only the source text near the beginning takes more than one line.
    std::istringstream lines(all);
    std::vector<std::string> list;
    for (std::string line; std::getline(lines, line);) list.push_back(line);
    const std::string& line = list.at(list.size() - (instruction_count - instruction.ordinal));
    return line.substr(std::min(line.find_first_not_of(' '), line.size()));
}

Module parse(std::vector<std::uint32_t> words, std::vector<std::string> files) {
    Module module;
    module.words = std::move(words);
    module.files = std::move(files);
    Parser(module).run();
    return module;
}

}  // namespace halfframe::shader_ir
