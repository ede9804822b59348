// Compiles a function together with what its declaration says about it.
#include "perf/stability/subject.h"

#include <algorithm>
#include <cmath>
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

std::string signature(const Declaration& function) {
    std::string text;
    for (const DeclaredParameter& parameter : function.parameters) text += (text.empty() ? "" : ", ") + parameter.text;
    return text;
}

std::string helpers_of(const Declaration& function) {
    std::string text = kWithin;
    const std::string parameters = signature(function);
    if (!function.where.empty())
        text += fmt::format("bool declared_where({}) {{ return {}; }}\n", parameters, function.where);
    for (std::size_t i = 0; i < function.jumps.size(); ++i)
        text += fmt::format("float declared_jump_{}({}) {{ return float({}); }}\n", i, parameters, function.jumps[i]);
    for (std::size_t i = 0; i < function.exemptions.size(); ++i) {
        if (function.exemptions[i].within.empty()) continue;
        text += fmt::format("highp float declared_within_{}({}) {{ return {}; }}\n", i, parameters,
                            function.exemptions[i].within);
    }
    for (std::size_t i = 0; i < function.promises.size(); ++i) {
        const Promise& promise = function.promises[i];
        if (promise.kind != Promise::Kind::holds) continue;
        text +=
            fmt::format("bool declared_promise_{}({}, {}{} result, highp float slack) {{ return {}; }}\n", i,
                        parameters, function.returns_full ? "highp " : "", function.returned_type, promise.condition);
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
      module_(shader_ir::compile(shader_ir::FunctionFiles{.paths = paths_,
                                                          .arithmetic = gl::Arithmetic::half,
                                                          .defines = defines_of(variant_),
                                                          .more_text = helpers_},
                                 files)) {
    const shader_ir::Function* found = nullptr;
    int called_alike = 0;
    for (const shader_ir::Function& one : module_.functions) {
        if (one.name == function_.mangled()) found = &one;
        if (one.name.starts_with(function_.name + "(")) ++called_alike;
    }
    if (found == nullptr) {
        throw Error(Fault::check,
                    fmt::format("{}: {} does not exist where {} is defined; name the defines that it stands under in a "
                                "line //@variant above it",
                                function_.place(), function_.name, variant_));
    }
    overloaded_ = called_alike > 1;
    for (const DeclaredParameter& parameter : function_.parameters)
        components_ += static_cast<std::size_t>(parameter.components);
    std::vector<const shader_ir::Function*> seen;
    collect_constants(*found, seen);
    std::ranges::sort(constants_);
    constants_.erase(std::unique(constants_.begin(), constants_.end()), constants_.end());
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

Columns Subject::run(const Batch& batch, Model model, const shader_ir::ResultWatch& watch) const {
    shader_ir::Bindings bindings;
    bindings.watch = watch;
    return shader_ir::evaluate(module_, function_.mangled(), batch.inputs, model, bindings).returned;
}

std::vector<bool> Subject::meant(const Batch& batch) const {
    if (function_.where.empty()) return std::vector<bool>(batch.lanes(), true);
    return as_bools(shader_ir::evaluate(module_, "declared_where", batch.inputs, Model::in_double).returned.at(0));
}

Columns Subject::jumps(const Batch& batch) const {
    Columns values;
    for (std::size_t i = 0; i < function_.jumps.size(); ++i) {
        values.push_back(
            shader_ir::evaluate(module_, fmt::format("declared_jump_{}", i), batch.inputs, Model::in_double)
                .returned.at(0));
    }
    return values;
}

std::vector<double> Subject::exempted_error(const Batch& batch, Model model) const {
    const Exemption* exemption = function_.exemption(model);
    if (exemption == nullptr || exemption->within.empty()) return {};
    const std::string helper = fmt::format("declared_within_{}", exemption - function_.exemptions.data());
    return shader_ir::evaluate(module_, helper, batch.inputs, Model::in_double).returned.at(0);
}

std::vector<bool> Subject::kept(std::size_t promise, const Batch& batch, const Columns& result,
                                const std::vector<double>& slack, Model model) const {
    std::vector<Columns> inputs = batch.inputs;
    inputs.push_back(result);
    inputs.push_back({slack});
    return as_bools(
        shader_ir::evaluate(module_, fmt::format("declared_promise_{}", promise), inputs, model).returned.at(0));
}

}  // namespace halfframe::stability
