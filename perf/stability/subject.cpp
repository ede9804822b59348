// Compiles a function together with what its declaration says about it.
#include "perf/stability/subject.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <sstream>

#include <fmt/format.h>

#include "engine/error.h"
#include "perf/shader_ir/compile.h"

namespace halfframe::stability {
namespace {

using shader_ir::Columns;
using shader_ir::Model;

/// What promises may call: equal but for `slack`.
constexpr const char* kWithin = R"glsl(
bool within(highp float a, highp float b, highp float slack) { return abs(a - b) <= slack; }
bool within(highp vec3 a, highp vec3 b, highp float slack) { return all(lessThanEqual(abs(a - b), vec3(slack))); }
)glsl";

/// The type of `result` in promises.
std::string result_text(const Declaration& function) {
    const std::string precision = function.returns_full ? "highp " : "";
    if (function.plain()) return precision + function.returned_type + " result";
    if (function.returned > 4) return fmt::format("highp float result[{}]", function.returned);
    return fmt::format("{}{} result", precision,
                       function.returned == 1 ? "float" : fmt::format("vec{}", function.returned));
}

std::string helpers_of(const Declaration& function) {
    std::string text = kWithin + calls_text(function);
    const std::string parameters = pieces_text(function), names = unpacked(function);
    if (!function.where.empty())
        text += fmt::format("bool declared_where({}) {{{} return {}; }}\n", parameters, names, function.where);
    for (std::size_t i = 0; i < function.jumps.size(); ++i)
        text += fmt::format("float declared_jump_{}({}) {{{} return float({}); }}\n", i, parameters, names,
                            function.jumps[i]);
    for (std::size_t i = 0; i < function.exemptions.size(); ++i) {
        if (function.exemptions[i].within.empty()) continue;
        text += fmt::format("highp float declared_within_{}({}) {{{} return {}; }}\n", i, parameters, names,
                            function.exemptions[i].within);
    }
    for (std::size_t i = 0; i < function.promises.size(); ++i) {
        const Promise& promise = function.promises[i];
        if (promise.kind != Promise::Kind::holds) continue;
        text += fmt::format("bool declared_promise_{}({}, {}, highp float slack) {{{} return {}; }}\n", i, parameters,
                            result_text(function), names, promise.condition);
    }
    return text;
}

std::vector<gl::Define> defines_of(const std::string& variant) {
    std::vector<gl::Define> defines;
    std::istringstream words(variant);
    for (std::string word; words >> word;) defines.emplace_back(word, "1");
    return defines;
}

std::string_view text_of(const std::string& path, std::span<const gl::ShaderFile> files) {
    const auto file = std::ranges::find_if(files, [&](const gl::ShaderFile& one) { return one.path == path; });
    expect(file != files.end(), [&] { return path + " is not among the files given"; });
    return file->text;
}

/// A .glsl file may count on the numbers of its effect: whoever includes it has included them.
std::vector<std::string> paths_for(const std::string& path, std::span<const gl::ShaderFile> files) {
    std::vector<std::string> paths{"common/maths.glsl"};
    const std::string folder = path.substr(0, path.find('/'));
    const std::string limits = folder + "/" + folder + "_limits.h";
    if (std::ranges::any_of(files, [&](const gl::ShaderFile& one) { return one.path == limits; }))
        paths.push_back(limits);
    if (path != paths.front()) paths.push_back(path);
    return paths;
}

constexpr const char* kOutside = "<outside>";

/// The files, with the function's own one as a text that can be included, and what stands before it.
std::vector<gl::ShaderFile> files_for(const Declaration& function, const std::string& outside, const std::string& own,
                                      std::span<const gl::ShaderFile> files) {
    std::vector<gl::ShaderFile> all(files.begin(), files.end());
    if (outside.empty()) return all;
    for (gl::ShaderFile& one : all) {
        if (one.path == function.file) one.text = own;
    }
    all.push_back({kOutside, outside});
    return all;
}

shader_ir::Module compiled(const std::vector<std::string>& paths, const std::string& variant, const std::string& more,
                           std::span<const gl::ShaderFile> files) {
    return shader_ir::compile(
        shader_ir::FunctionFiles{
            .paths = paths, .arithmetic = gl::Arithmetic::half, .defines = defines_of(variant), .more_text = more},
        files);
}

bool defines_function(const shader_ir::Module& module, const std::string& name) {
    return std::ranges::any_of(module.functions,
                               [&](const shader_ir::Function& one) { return one.name.starts_with(name + "("); });
}

std::vector<bool> as_bools(const std::vector<double>& column) {
    std::vector<bool> bools;
    bools.reserve(column.size());
    for (const double value : column) bools.push_back(value != 0.0);
    return bools;
}

}  // namespace

std::vector<double> Batch::lane(std::size_t at) const {
    std::vector<double> scalars;
    for (const Columns& parameter : inputs) {
        for (const std::vector<double>& column : parameter) scalars.push_back(column[at]);
    }
    return scalars;
}

Batch batch_of(const Declaration& function, const std::vector<std::vector<double>>& lanes) {
    Batch batch;
    std::size_t first = 0;
    for (const DeclaredParameter& parameter : function.parameters) {
        Columns& columns = batch.inputs.emplace_back(static_cast<std::size_t>(parameter.components));
        for (std::size_t s = 0; s < columns.size(); ++s) {
            for (const std::vector<double>& lane : lanes) columns[s].push_back(lane.at(first + s));
        }
        first += columns.size();
    }
    return batch;
}

Subject::Subject(Declaration function, std::string variant, std::span<const gl::ShaderFile> files)
    : function_(std::move(function)),
      variant_(std::move(variant)),
      paths_(paths_for(function_.file, files)),
      text_(text_of(function_.file, files)),
      helpers_(helpers_of(function_)),
      pieces_(pieces_of(function_)) {
    if (!function_.plain() || is_stage(text_)) {
        outside_ = outside_begins(function_);
        own_text_ = without_stage(text_);
        paths_.insert(paths_.begin(), kOutside);
        helpers_ += outside_ends();
    }
    files_ = files_for(function_, outside_, own_text_, files);
    const auto missing = [&] {
        return Error(
            Fault::check,
            fmt::format("{}: {} does not exist where {} is defined; name the defines that it stands under in a "
                        "line //@variant above it",
                        function_.place(), function_.name, variant_));
    };
    try {
        module_ = compiled(paths_, variant_, helpers_, files_);
    } catch (const Error& error) {
        // Is it the text, or what was made of the declaration?
        if (!defines_function(compiled(paths_, variant_, outside_.empty() ? "" : outside_ends(), files_),
                              function_.name))
            throw missing();
        throw Error(Fault::check, fmt::format("{}: what is declared above {} does not compile with it: {}",
                                              function_.place(), function_.name, error.what()));
    }
    const std::string wanted = function_.plain() ? function_.mangled() : call_name(0) + "(";
    const shader_ir::Function* found = nullptr;
    int called_alike = 0;
    for (const shader_ir::Function& one : module_.functions) {
        if (function_.plain() ? one.name == wanted : one.name.starts_with(wanted)) found = &one;
        if (one.name.starts_with(function_.name + "(")) ++called_alike;
    }
    if (found == nullptr) throw missing();
    refuse_unset(*found);
    overloaded_ = called_alike > 1;
    for (const DeclaredParameter& parameter : function_.parameters)
        components_ += static_cast<std::size_t>(parameter.components);
    std::vector<const shader_ir::Function*> seen;
    collect_constants(*found, seen);
    std::ranges::sort(constants_);
    constants_.erase(std::unique(constants_.begin(), constants_.end()), constants_.end());
}

/// A variable that gets its first value when the stage begins: a function alone never sees that.
void Subject::refuse_started(const std::set<shader_ir::Id>& loaded) const {
    for (const shader_ir::Function& main : module_.functions) {
        if (main.name != "main" && main.name != "main(") continue;
        for (const shader_ir::Block& block : main.blocks) {
            for (const shader_ir::Instruction& one : block.instructions) {
                if (one.op != spv::OpStore || !loaded.contains(one.operands[0])) continue;
                const auto found = std::ranges::find(module_.variables, one.operands[0], &shader_ir::Variable::id);
                if (found == module_.variables.end() || found->storage == spv::StorageClassOutput) continue;
                const bool outside = std::ranges::any_of(
                    function_.parameters, [&](const DeclaredParameter& given) { return given.name == found->name; });
                if (outside) continue;
                throw Error(Fault::check,
                            fmt::format("{}: {} reads the variable {}, which is set before main(); make it const or "
                                        "local, or say what it may be in a line such as //@domain float {}: 0..1",
                                        function_.place(), function_.name, found->name, found->name));
            }
        }
    }
}

/// A variable that is read and that nothing was said about.
void Subject::refuse_unset(const shader_ir::Function& called) const {
    std::set<shader_ir::Id> stored, loaded;
    std::vector<const shader_ir::Function*> waiting{&called}, seen;
    std::map<shader_ir::Id, shader_ir::Id> root;  // of pointers into a variable
    while (!waiting.empty()) {
        const shader_ir::Function& function = *waiting.back();
        waiting.pop_back();
        if (std::ranges::find(seen, &function) != seen.end()) continue;
        seen.push_back(&function);
        const auto variable = [&](shader_ir::Id id) { return root.contains(id) ? root.at(id) : id; };
        for (const shader_ir::Block& block : function.blocks) {
            for (const shader_ir::Instruction& one : block.instructions) {
                if (one.op == spv::OpAccessChain) root[one.result] = variable(one.operands[0]);
                if (one.op == spv::OpStore) stored.insert(variable(one.operands[0]));
                if (one.op == spv::OpLoad) loaded.insert(variable(one.operands[0]));
                if (one.op == spv::OpKill)
                    throw Error(Fault::check,
                                fmt::format("{}: {} discards, and a fragment that is gone has no number; write its "
                                            "condition as a function of its own and try that",
                                            function_.place(), function_.name));
                if (one.op == spv::OpFunctionCall) waiting.push_back(&module_.function(one.operands[0]));
            }
        }
    }
    refuse_started(loaded);
    for (const shader_ir::Variable& one : module_.variables) {
        const bool given = one.initializer != 0 || stored.contains(one.id);
        if (given || !loaded.contains(one.id) || one.storage == spv::StorageClassOutput) continue;
        throw Error(Fault::check,
                    fmt::format("{}: {} reads {} from outside, and nothing says what it may be; write a line such as "
                                "//@domain vec4 {}: 0..1 above it, with its own type",
                                function_.place(), function_.name, one.name, one.name));
    }
}

void Subject::collect_constants(const shader_ir::Function& function, std::vector<const shader_ir::Function*>& seen) {
    if (std::ranges::find(seen, &function) != seen.end()) return;
    seen.push_back(&function);
    for (const shader_ir::Block& block : function.blocks) {
        for (const shader_ir::Instruction& one : block.instructions) {
            for (const std::uint32_t word : one.operands) {
                const auto constant = module_.constants.find(word);
                if (constant == module_.constants.end()) continue;
                const shader_ir::Type& type = module_.type(constant->second.type);
                for (std::size_t s = 0; s < constant->second.scalars.size(); ++s) {
                    if (type.float_leaf[s] && std::isfinite(constant->second.scalars[s]))
                        constants_.push_back(constant->second.scalars[s]);
                }
            }
            if (one.op == spv::OpFunctionCall) collect_constants(module_.function(one.operands[0]), seen);
        }
    }
}

std::vector<gl::Define> Subject::defines() const { return defines_of(variant_); }

std::string Subject::title() const {
    std::string text = function_.name;
    if (overloaded_) {
        text += "(";
        for (const DeclaredParameter& parameter : function_.parameters)
            text += (text.ends_with('(') ? "" : ", ") + parameter.type;
        text += ")";
    }
    return variant_ == "TIER_CONSOLE" ? text : text + " [" + variant_ + "]";
}

std::vector<Columns> Subject::pieces(const Batch& batch) const {
    std::vector<Columns> columns;
    for (const Piece& piece : pieces_) {
        const auto first = batch.inputs[piece.parameter].begin() + static_cast<std::ptrdiff_t>(piece.first);
        columns.emplace_back(first, first + piece.components);
    }
    return columns;
}

Columns Subject::run(const Batch& batch, Model model, const shader_ir::ResultWatch& watch) const {
    shader_ir::Bindings bindings;
    bindings.watch = watch;
    if (function_.plain())
        return shader_ir::evaluate(module_, function_.mangled(), batch.inputs, model, bindings).returned;
    const std::vector<Columns> inputs = pieces(batch);
    Columns results;
    for (std::size_t call = 0; call < calls_of(function_); ++call) {
        Columns some = shader_ir::evaluate(module_, call_name(call), inputs, model, bindings).returned;
        std::ranges::move(some, std::back_inserter(results));
    }
    return results;
}

std::vector<bool> Subject::meant(const Batch& batch) const {
    if (function_.where.empty()) return std::vector<bool>(batch.lanes(), true);
    return as_bools(shader_ir::evaluate(module_, "declared_where", pieces(batch), Model::in_double).returned.at(0));
}

Columns Subject::jumps(const Batch& batch) const {
    Columns values;
    for (std::size_t i = 0; i < function_.jumps.size(); ++i) {
        values.push_back(
            shader_ir::evaluate(module_, fmt::format("declared_jump_{}", i), pieces(batch), Model::in_double)
                .returned.at(0));
    }
    return values;
}

std::vector<double> Subject::exempted_error(const Batch& batch, Model model) const {
    const Exemption* exemption = function_.exemption(model);
    if (exemption == nullptr || exemption->within.empty()) return {};
    const std::string helper = fmt::format("declared_within_{}", exemption - function_.exemptions.data());
    return shader_ir::evaluate(module_, helper, pieces(batch), Model::in_double).returned.at(0);
}

std::vector<bool> Subject::kept(std::size_t promise, const Batch& batch, const Columns& result,
                                const std::vector<double>& slack, Model model) const {
    std::vector<Columns> inputs = pieces(batch);
    inputs.push_back(result);
    inputs.push_back({slack});
    return as_bools(
        shader_ir::evaluate(module_, fmt::format("declared_promise_{}", promise), inputs, model).returned.at(0));
}

}  // namespace halfframe::stability
