// A declared function, compiled with one set of defines and ready to run in any model.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "perf/shader_ir/evaluate.h"
#include "perf/stability/call_text.h"
#include "perf/stability/declaration.h"

namespace halfframe::stability {

/// Inputs of many lanes: for each parameter an array per component.
struct Batch {
    std::vector<shader_ir::Columns> inputs;
    [[nodiscard]] std::size_t lanes() const { return inputs.empty() ? 0 : inputs[0][0].size(); }
    /// All components of a lane, one parameter after the other.
    [[nodiscard]] std::vector<double> lane(std::size_t at) const;
};

/// A batch of the lanes given, each as from Batch::lane().
[[nodiscard]] Batch batch_of(const Declaration& function, const std::vector<std::vector<double>>& lanes);

class Subject {
public:
    /// Compiles the function. `files` are all there is to include, and outlive the subject. Error(check) for text
    /// that does not compile, promises and jumps included, and for a variant that
    /// leaves the function out.
    Subject(Declaration function, std::string variant, std::span<const gl::ShaderFile> files);
    Subject(const Subject&) = delete;  // files() points into it
    Subject& operator=(const Subject&) = delete;

    [[nodiscard]] const Declaration& function() const { return function_; }
    [[nodiscard]] const std::string& variant() const { return variant_; }
    [[nodiscard]] std::vector<gl::Define> defines() const;
    /// What is included to compile the function: maths, the limits of its folder, its own file.
    [[nodiscard]] const std::vector<std::string>& paths() const { return paths_; }
    /// The file that holds the function.
    [[nodiscard]] std::string_view text() const { return text_; }
    /// All that there is to include, for whoever compiles it again; and what stands behind paths().
    [[nodiscard]] std::span<const gl::ShaderFile> files() const { return files_; }
    [[nodiscard]] const std::string& helpers() const { return helpers_; }
    /// "blinn_lobe", or "blinn_lobe (TIER_REFERENCE)" where another set of defines than the usual one is meant;
    /// an overload goes with its types.
    [[nodiscard]] std::string title() const;
    [[nodiscard]] std::size_t components() const { return components_; }  ///< of all parameters

    [[nodiscard]] shader_ir::Columns run(const Batch& batch, shader_ir::Model model,
                                         const shader_ir::ResultWatch& watch = {}) const;
    /// Lanes that the declaration means: inside `where`.
    [[nodiscard]] std::vector<bool> meant(const Batch& batch) const;
    /// What the expressions of //@jumps are, in double.
    [[nodiscard]] shader_ir::Columns jumps(const Batch& batch) const;
    /// The error that an exemption of the model allows in any case, per lane; empty where there is none.
    [[nodiscard]] std::vector<double> exempted_error(const Batch& batch, shader_ir::Model model) const;
    /// Which lanes keep a promise of Kind::holds whose result and slack are given, in the arithmetic of `model`.
    [[nodiscard]] std::vector<bool> kept(std::size_t promise, const Batch& batch, const shader_ir::Columns& result,
                                         const std::vector<double>& slack, shader_ir::Model model) const;
    /// The numbers in the function's text, and in what it calls: where a formula changes, or has a pole.
    [[nodiscard]] const std::vector<double>& constants() const { return constants_; }
    /// "surface/surface.glsl:41" of a line in the module.
    [[nodiscard]] std::string place(std::uint32_t line) const { return module_.place(line); }

private:
    void collect_constants(const shader_ir::Function& function, std::vector<const shader_ir::Function*>& seen);
    void refuse_unset(const shader_ir::Function& called) const;
    void refuse_started(const std::set<shader_ir::Id>& loaded) const;
    [[nodiscard]] std::vector<shader_ir::Columns> pieces(const Batch& batch) const;

    Declaration function_;
    std::string variant_;
    std::vector<std::string> paths_;
    std::string_view text_;
    std::string helpers_;
    std::string outside_, own_text_;  ///< what stands before the file, and the file without its stage; may be empty
    std::vector<gl::ShaderFile> files_;
    std::vector<Piece> pieces_;
    shader_ir::Module module_;
    std::size_t components_ = 0;
    bool overloaded_ = false;
    std::vector<double> constants_;
};

}  // namespace halfframe::stability
