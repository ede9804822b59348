// Condition by central differences of half a step, in double.
#include "perf/stability/criterion.h"

#include <algorithm>
#include <cmath>

namespace halfframe::stability {
namespace {

using shader_ir::Columns;
using shader_ir::Model;

constexpr double kSmallestNormal = 0x1p-14;  // of half and of the ES minimum
constexpr double kMinimumEnd = 0x1p14 - 0x1p3;

/// Where a lane's component may lie once it has been rounded, at most: on the side of `direction`, which also says how
/// many half steps.
double shifted(double x, double direction, const DeclaredParameter& parameter, Model model) {
    if (!std::isfinite(x) || parameter.whole) return x;
    double shift = 0.5 * step_at(x, format_of(model), parameter.full);
    // What is flushed loses all of itself, not half a step.
    if (!parameter.full && format_of(model) == Format::flushed && std::fabs(x) < kSmallestNormal) shift *= 2.0;
    double to = x + direction * shift;
    if (!parameter.full && model == Model::es_minimum && std::fabs(x) > kMinimumEnd && direction < 0.0)
        to = std::copysign(kMinimumEnd, x);
    if (parameter.domain.kind == Domain::Kind::range)
        to = std::clamp(to, std::min(parameter.domain.low, x), std::max(parameter.domain.high, x));
    return to;
}

/// The larger of what is known and the difference that moving a component made.
void add_difference(const Columns& truth, const Columns& moved, Columns& largest) {
    for (std::size_t s = 0; s < truth.size(); ++s) {
        for (std::size_t lane = 0; lane < truth[s].size(); ++lane) {
            const double difference = std::fabs(moved[s][lane] - truth[s][lane]);
            if (std::isfinite(difference)) largest[s][lane] = std::max(largest[s][lane], difference);
        }
    }
}

void mark_jumps(const Columns& here, const Columns& there, std::vector<bool>& near_jump) {
    for (std::size_t i = 0; i < here.size(); ++i) {
        for (std::size_t lane = 0; lane < near_jump.size(); ++lane) {
            if (here[i][lane] != there[i][lane]) near_jump[lane] = true;
        }
    }
}

bool reaches(const std::vector<Columns>& values) {
    for (const Columns& columns : values) {
        for (const std::vector<double>& column : columns) {
            if (std::ranges::any_of(column, [](double x) { return std::fabs(x) > kMinimumEnd; })) return true;
        }
    }
    return false;
}

}  // namespace

Format format_of(Model model) {
    return model == Model::half_flushed || model == Model::es_minimum ? Format::flushed : Format::gradual;
}

double step_at(double x, Format format, bool full) {
    const double size = std::fabs(x);
    // Whatever is below 2^-126 on the way may be flushed, so no step counts as less.
    if (full) return size < 0x1p-103 ? 0x1p-126 : std::ldexp(1.0, std::ilogb(size) - 23);
    if (size < kSmallestNormal) return format == Format::flushed ? kSmallestNormal : 0x1p-24;
    return std::ldexp(1.0, std::ilogb(size) - 10);
}

Allowed allowed_errors(const Subject& subject, const Batch& batch, Model model) {
    const Declaration& function = subject.function();
    Allowed allowed{.truth = subject.run(batch, Model::in_double), .error = {}, .near_jump = {}};
    allowed.near_jump.assign(batch.lanes(), false);
    const Columns jumps = subject.jumps(batch);
    Columns condition(allowed.truth.size(), std::vector<double>(batch.lanes(), 0.0));
    Batch moved = batch;
    for (std::size_t p = 0; p < function.parameters.size(); ++p) {
        for (std::size_t s = 0; s < batch.inputs[p].size(); ++s) {
            Columns largest(allowed.truth.size(), std::vector<double>(batch.lanes(), 0.0));
            for (const double direction : {-1.0, 1.0}) {
                for (std::size_t lane = 0; lane < batch.lanes(); ++lane)
                    moved.inputs[p][s][lane] =
                        shifted(batch.inputs[p][s][lane], direction, function.parameters[p], model);
                add_difference(allowed.truth, subject.run(moved, Model::in_double), largest);
                if (jumps.empty()) continue;
                for (std::size_t lane = 0; lane < batch.lanes(); ++lane)
                    moved.inputs[p][s][lane] =
                        shifted(batch.inputs[p][s][lane], kConditionFactor * direction, function.parameters[p], model);
                mark_jumps(jumps, subject.jumps(moved), allowed.near_jump);
            }
            moved.inputs[p][s] = batch.inputs[p][s];
            for (std::size_t r = 0; r < largest.size(); ++r) {
                for (std::size_t lane = 0; lane < batch.lanes(); ++lane) condition[r][lane] += largest[r][lane];
            }
        }
    }
    allowed.error = std::move(condition);
    for (std::size_t r = 0; r < allowed.error.size(); ++r) {
        for (std::size_t lane = 0; lane < batch.lanes(); ++lane) {
            const double truth = allowed.truth[r][lane];
            double& error = allowed.error[r][lane];
            error *= kConditionFactor;
            if (!std::isfinite(truth)) continue;
            error += kResultSteps * step_at(truth, format_of(model), function.returns_full);
            if (!function.returns_full && model == Model::es_minimum)
                error += std::max(std::fabs(truth) - kMinimumEnd, 0.0);
        }
    }
    return allowed;
}

Criteria::Criteria(const Subject& subject, const Batch& batch) {
    const Allowed gradual = allowed_errors(subject, batch, Model::half);
    const Allowed flushed = allowed_errors(subject, batch, Model::half_flushed);
    for (const Model model : shader_ir::kModels) {
        // The ES minimum is a flushed half as long as nothing reaches its end.
        const bool cut = model == Model::es_minimum && (reaches(batch.inputs) || reaches({flushed.truth}));
        Allowed& allowed = allowed_[model];
        allowed = cut ? allowed_errors(subject, batch, model) : format_of(model) == Format::flushed ? flushed : gradual;
        const std::vector<double> exempted = subject.exempted_error(batch, model);
        for (std::vector<double>& error : allowed.error) {
            for (std::size_t lane = 0; lane < exempted.size(); ++lane)
                error[lane] = std::max(error[lane], exempted[lane]);
        }
    }
}

const Allowed& Criteria::of(Model model) const { return allowed_.at(model); }

}  // namespace halfframe::stability
