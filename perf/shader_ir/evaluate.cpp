// The public face of the machine: cuts the inputs into runs of a fixed number of lanes, and collects what comes out.
#include "perf/shader_ir/evaluate.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/error.h"
#include "perf/shader_ir/machine.h"

namespace halfframe::shader_ir {
namespace {

using Kind = Type::Kind;

/// Lanes at once: enough to hide the cost of looking at an instruction, few enough for the registers to stay in the
/// cache.
constexpr std::size_t kWidth = 256;

void count(const Columns& columns, const std::string& whose, std::size_t& lanes) {
    for (const std::vector<double>& column : columns) {
        expect(!column.empty(), [&] { return "an empty column for " + whose; });
        if (column.size() == 1) continue;
        expect(lanes == 1 || lanes == column.size(), [&] {
            return fmt::format("{} has columns of {} numbers, others have {}", whose, column.size(), lanes);
        });
        lanes = column.size();
    }
}

std::size_t lanes_of(std::span<const Columns> inputs, const Bindings& bindings) {
    std::size_t lanes = 1;
    for (const Columns& columns : inputs) count(columns, "a parameter", lanes);
    for (const auto& [name, columns] : bindings.variables) count(columns, name, lanes);
    return lanes;
}

/// Appends `lanes` lanes of `data` to the columns from `first` on.
void append(Columns& columns, const std::vector<double>& data, std::size_t first, std::size_t scalars,
            std::size_t width, std::size_t lanes) {
    columns.resize(scalars);
    for (std::size_t s = 0; s < scalars; ++s) {
        const auto begin = data.begin() + static_cast<std::ptrdiff_t>((first + s) * width);
        columns[s].insert(columns[s].end(), begin, begin + static_cast<std::ptrdiff_t>(lanes));
    }
}

class Evaluator {
public:
    Evaluator(const Module& module, const Function& function, Model model, const Bindings& bindings)
        : module_(module), function_(function), bindings_(bindings), machine_(module, model, bindings, kWidth) {
        for (const Parameter& parameter : function.parameters) {
            const Type& type = module.type(parameter.type);
            const bool by_pointer = type.kind == Kind::pointer;
            arguments_.push_back(machine_.make_storage(by_pointer ? type.element : parameter.type, "a parameter"));
        }
        result_.parameters.resize(arguments_.size());
        for (Storage& argument : arguments_) {
            const Parameter& parameter = function.parameters[static_cast<std::size_t>(&argument - arguments_.data())];
            if (module.type(parameter.type).kind == Kind::pointer) machine_.point(parameter.id, argument);
        }
    }

    void run(std::span<const Columns> inputs, std::size_t first, std::size_t lanes) {
        machine_.begin(bindings_, first, lanes);
        for (std::size_t i = 0; i < arguments_.size(); ++i) give(i, inputs[i], first);
        machine_.call(function_);
        collect(lanes);
    }

    Evaluation take() { return std::move(result_); }

private:
    void give(std::size_t i, const Columns& columns, std::size_t first) {
        const Parameter& parameter = function_.parameters[i];
        Storage& argument = arguments_[i];
        const bool relaxed = module_.relaxed[parameter.id];
        machine_.at(parameter.id).relaxed = relaxed;
        if (module_.type(argument.type).kind == Kind::sampler) {
            const double place = machine_.sampler_at(module_.names.at(parameter.id));
            std::fill(argument.data.begin(), argument.data.end(), place);
        } else if (!columns.empty()) {
            machine_.fill(argument, columns, first, relaxed);
        }
        if (module_.type(parameter.type).kind != Kind::pointer) machine_.at(parameter.id).data = argument.data;
    }

    void collect(std::size_t lanes) {
        const std::size_t returned = module_.type(function_.return_type).scalars;
        if (returned > 0) append(result_.returned, machine_.at(function_.id).data, 0, returned, kWidth, lanes);
        for (std::size_t i = 0; i < arguments_.size(); ++i) {
            append(result_.parameters[i], arguments_[i].data, 0, module_.type(arguments_[i].type).scalars, kWidth,
                   lanes);
        }
        for (const Variable& variable : module_.variables) {
            if (variable.storage != spv::StorageClassOutput) continue;
            const std::vector<double>& data = machine_.variable(variable.id).data;
            if (variable.name == "gl_PerVertex") {  // the block of the vertex stage's built-in outputs
                append(result_.outputs["gl_Position"], data, 0, 4, kWidth, lanes);
                append(result_.outputs["gl_PointSize"], data, 4, 1, kWidth, lanes);
                continue;
            }
            append(result_.outputs[variable.name], data, 0, module_.type(variable.type).scalars, kWidth, lanes);
        }
        for (Lane lane = 0; lane < lanes; ++lane) result_.discarded.push_back(machine_.discarded(lane));
    }

    const Module& module_;
    const Function& function_;
    const Bindings& bindings_;
    Machine machine_;
    std::vector<Storage> arguments_;
    Evaluation result_;
};

}  // namespace

Evaluation evaluate(const Module& module, std::string_view function, std::span<const Columns> inputs, Model model,
                    const Bindings& bindings) {
    const Function& called = module.function(function);
    expect(inputs.size() == called.parameters.size(), [&] {
        return fmt::format("{} inputs given to {}, which has {} parameters", inputs.size(), called.name,
                           called.parameters.size());
    });
    const std::size_t lanes = lanes_of(inputs, bindings);
    Evaluator evaluator(module, called, model, bindings);
    for (std::size_t first = 0; first < lanes; first += kWidth) {
        evaluator.run(inputs, first, std::min(kWidth, lanes - first));
    }
    return evaluator.take();
}

}  // namespace halfframe::shader_ir
