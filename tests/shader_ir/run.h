// Short ways to compile a few lines of GLSL and run a function of them.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "engine/error.h"
#include "perf/shader_ir/compile.h"
#include "perf/shader_ir/evaluate.h"

namespace halfframe::shader_ir {

/// A module of functions written here. Unqualified floats are mediump in half arithmetic, highp in full.
inline Module module_of(const std::string& text, gl::Arithmetic arithmetic = gl::Arithmetic::full) {
    return compile(FunctionFiles{.paths = {}, .arithmetic = arithmetic, .defines = {}, .more_text = text});
}

/// Inputs of one lane: {{x}, {y, z}} is a float and a vec2.
inline std::vector<Columns> lane(const std::vector<std::vector<double>>& arguments) {
    std::vector<Columns> inputs;
    for (const std::vector<double>& scalars : arguments) {
        Columns& columns = inputs.emplace_back();
        for (const double scalar : scalars) columns.push_back({scalar});
    }
    return inputs;
}

inline std::vector<double> first_lane(const Columns& columns) {
    std::vector<double> values;
    for (const std::vector<double>& column : columns) values.push_back(column.at(0));
    return values;
}

/// What `function` returns for one lane.
inline std::vector<double> result_of(const Module& module, const std::string& function,
                                     const std::vector<std::vector<double>>& arguments, Model model = Model::in_double,
                                     const Bindings& bindings = {}) {
    return first_lane(evaluate(module, function, lane(arguments), model, bindings).returned);
}

inline double number_of(const Module& module, const std::string& function,
                        const std::vector<std::vector<double>>& arguments, Model model = Model::in_double,
                        const Bindings& bindings = {}) {
    return result_of(module, function, arguments, model, bindings).at(0);
}

/// The message of the Error that `action` throws; empty, with a failure, when it throws none.
template <typename Action>
std::string error_of(Action action) {
    try {
        action();
    } catch (const Error& error) {
        return error.what();
    }
    ADD_FAILURE() << "no Error was thrown";
    return {};
}

}  // namespace halfframe::shader_ir
