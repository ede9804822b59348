// The search: batches through all arithmetics, each result held to the criterion and to the promises.
#include "perf/stability/search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "engine/error.h"
#include "perf/accuracy/function_bench.h"

namespace halfframe::stability {
namespace {

using shader_ir::Columns;
using shader_ir::Model;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Lanes at once: a square of 256 pixels.
constexpr std::size_t kBatch = 65536;

bool finite_input(const Batch& batch, std::size_t lane) {
    for (const Columns& parameter : batch.inputs) {
        for (const std::vector<double>& column : parameter) {
            if (!std::isfinite(column[lane])) return false;
        }
    }
    return true;
}

/// A batch with what is known of it, and the tally that a result of it goes into.
struct Trial {
    const Subject& subject;
    const Batch& batch;
    const Allowed& allowed;
    const Columns& got;
    Tally& tally;

    [[nodiscard]] Finding finding(std::size_t lane, std::size_t component, double ratio) const {
        return {.input = batch.lane(lane),
                .component = component,
                .expected = allowed.truth[component][lane],
                .got = got[component][lane],
                .allowed = allowed.error[component][lane],
                .ratio = ratio};
    }
    void break_promise(const Promise& promise, std::size_t lane, std::size_t component,
                       std::vector<double>& badness) const {
        const auto known = std::ranges::find(tally.broken, promise.text, &BrokenPromise::promise);
        badness[lane] = kInfinity;
        if (known != tally.broken.end()) {
            ++known->lanes;
        } else {
            tally.broken.push_back({promise.text, 1, finding(lane, component, kInfinity)});
        }
    }
};

/// Error over allowed, per lane.
std::vector<double> judge_errors(const Trial& trial) {
    std::vector<double> badness(trial.batch.lanes(), 0.0);
    for (std::size_t lane = 0; lane < badness.size(); ++lane) {
        if (!finite_input(trial.batch, lane)) continue;
        bool lost = false;
        for (std::size_t s = 0; s < trial.got.size(); ++s) {
            const double truth = trial.allowed.truth[s][lane], got = trial.got[s][lane];
            double ratio = 0.0;
            if (!std::isfinite(got)) {
                ratio = kInfinity;
                lost = true;
            } else if (!trial.allowed.near_jump[lane] && got != truth) {
                ratio = std::fabs(got - truth) / trial.allowed.error[s][lane];
            }
            badness[lane] = std::max(badness[lane], ratio);
            if (ratio > trial.tally.worst.ratio) trial.tally.worst = trial.finding(lane, s, ratio);
        }
        trial.tally.not_finite += lost ? 1 : 0;
        trial.tally.over += badness[lane] > 1.0 ? 1 : 0;
    }
    trial.tally.lanes += trial.batch.lanes();
    return badness;
}

/// `end_slack`: what the ends of a range may be passed by.
bool keeps(const Promise& promise, double got, double truth, double end_slack) {
    if (promise.kind == Promise::Kind::finite) return std::isfinite(got);
    if (promise.kind == Promise::Kind::error) return std::fabs(got - truth) <= promise.high;
    return got >= promise.low - end_slack && got <= promise.high + end_slack;
}

void judge_values(const Trial& trial, const Promise& promise, std::vector<double>& badness) {
    // A shader's constants have 24 bits, so that what should end at 1 may end a step of fp32 beyond. Half has no such
    // steps.
    const bool narrow = shader_ir::is_narrow(trial.tally.model);
    const double end_slack = narrow ? 0.0 : 0x1p-22 * std::max(std::fabs(promise.low), std::fabs(promise.high));
    for (std::size_t lane = 0; lane < badness.size(); ++lane) {
        if (promise.kind != Promise::Kind::finite && !finite_input(trial.batch, lane)) continue;
        if (promise.kind == Promise::Kind::error && trial.allowed.near_jump[lane]) continue;
        for (std::size_t s = 0; s < trial.got.size(); ++s) {
            if (keeps(promise, trial.got[s][lane], trial.allowed.truth[s][lane], end_slack)) continue;
            trial.break_promise(promise, lane, s, badness);
            break;
        }
    }
}

void judge_promises(const Trial& trial, Model model, std::vector<double>& badness) {
    const Declaration& function = trial.subject.function();
    for (std::size_t i = 0; i < function.promises.size(); ++i) {
        const Promise& promise = function.promises[i];
        if (promise.kind == Promise::Kind::finite || promise.kind == Promise::Kind::within ||
            promise.kind == Promise::Kind::error)
            judge_values(trial, promise, badness);
        if (promise.kind != Promise::Kind::holds) continue;
        std::vector<double> slack(badness.size(), 0.0);
        for (const std::vector<double>& error : trial.allowed.error) {
            for (std::size_t lane = 0; lane < slack.size(); ++lane) slack[lane] = std::max(slack[lane], error[lane]);
        }
        const std::vector<bool> kept = trial.subject.kept(i, trial.batch, trial.got, slack, model);
        for (std::size_t lane = 0; lane < kept.size(); ++lane) {
            if (!kept[lane] && !trial.allowed.near_jump[lane]) trial.break_promise(promise, lane, 0, badness);
        }
    }
}

/// Sweeps one behind the other, each from where `begins` says: no result falls (or rises) by more than 2 of its steps
/// below (or above) the highest (lowest) before it, so that many small steps back are seen too.
void judge_sweep(const Trial& trial, const Promise& promise, const std::vector<bool>& begins,
                 std::vector<double>& badness) {
    const double sign = promise.kind == Promise::Kind::rising ? 1.0 : -1.0;
    const Format format = format_of(trial.tally.model);
    std::vector<double> furthest(trial.got.size());
    for (std::size_t lane = 0; lane < badness.size(); ++lane) {
        for (std::size_t s = 0; s < trial.got.size(); ++s) {
            const double here = trial.got[s][lane];
            if (begins[lane] || sign * here > sign * furthest[s]) {
                furthest[s] = here;
                continue;
            }
            const double before = furthest[s];
            const double slack = kResultSteps * step_at(std::max(std::fabs(before), std::fabs(here)), format,
                                                        trial.subject.function().returns_full);
            if (sign * (here - before) >= -slack) continue;
            trial.break_promise(promise, lane, s, badness);
            break;
        }
    }
}

/// A context has sixteen textures for what a function gets.
bool can_draw(const Declaration& function) { return pieces_of(function).size() <= 16; }

/// Draws a batch: mediump as written, or everything in highp.
Columns drawn(const Subject& subject, const Batch& batch, const Drawing& drawing, gl::Arithmetic arithmetic) {
    const Declaration& function = subject.function();
    accuracy::DrawnFunction wanted{.files = subject.paths(),
                                   .more_text = subject.helpers(),
                                   .available = subject.files(),
                                   .arithmetic = arithmetic,
                                   .defines = subject.defines()};
    std::vector<Columns> inputs;
    for (const Piece& piece : pieces_of(function)) {
        wanted.parameters.push_back({.components = piece.components, .full = piece.full});
        const auto first = batch.inputs[piece.parameter].begin() + static_cast<std::ptrdiff_t>(piece.first);
        inputs.emplace_back(first, first + piece.components);
    }
    Columns results;
    for (std::size_t call = 0; call < calls_of(function); ++call) {
        wanted.function = function.plain() ? function.name : call_name(call);
        wanted.returned = std::min(function.returned - 4 * static_cast<int>(call), 4);
        const std::vector<float> pixels = accuracy::draw_function(drawing.gl, drawing.caps, wanted, inputs);
        for (std::size_t s = 0; s < static_cast<std::size_t>(wanted.returned); ++s) {
            std::vector<double>& column = results.emplace_back(batch.lanes());
            for (std::size_t lane = 0; lane < batch.lanes(); ++lane) column[lane] = pixels[lane * 4 + s];
        }
    }
    return results;
}

void fill_strip(Strip& strip, const Subject& subject, const Batch& batch, const Allowed& allowed,
                const std::vector<Columns>& in_models) {
    const Declaration& function = subject.function();
    std::size_t p = 0;
    while (p + 1 < function.parameters.size() && function.parameters[p].domain.kind == Domain::Kind::unit) ++p;
    if (strip.at.empty()) {
        const std::vector<double> values = all_halves(function.parameters[p]);
        strip.parameter = function.parameters[p].name + (function.parameters[p].components > 1 ? ".x" : "");
        for (std::size_t i = 0; i <= Strip::kBins; ++i)
            strip.at.push_back(values[i * (values.size() - 1) / Strip::kBins]);
        strip.allowed.assign(Strip::kBins, kInfinity);
        strip.errors.assign(in_models.size(), std::vector<double>(Strip::kBins, -1.0));
    }
    for (std::size_t lane = 0; lane < batch.lanes(); ++lane) {
        const double x = batch.inputs[p][0][lane];
        if (!finite_input(batch, lane)) continue;
        const auto above = std::upper_bound(strip.at.begin() + 1, strip.at.end() - 1, x);
        const auto bin = static_cast<std::size_t>(above - strip.at.begin() - 1);
        for (std::size_t s = 0; s < allowed.truth.size(); ++s) {
            if (std::isfinite(allowed.error[s][lane]))
                strip.allowed[bin] = std::min(strip.allowed[bin], allowed.error[s][lane]);
            for (std::size_t m = 0; m < in_models.size(); ++m) {
                const double error = std::fabs(in_models[m][s][lane] - allowed.truth[s][lane]);
                strip.errors[m][bin] = std::max(strip.errors[m][bin], std::isnan(error) ? kInfinity : error);
            }
        }
    }
}

std::vector<Tally> empty_tallies(const Declaration& function, const Drawing* drawing) {
    std::vector<Tally> tallies;
    for (const Model model : shader_ir::kModels) {
        Tally& tally = tallies.emplace_back(Tally{.arithmetic = shader_ir::name(model), .model = model});
        if (const Exemption* exemption = function.exemption(model)) tally.at_most = exemption->at_most;
    }
    if (drawing == nullptr || !can_draw(function)) return tallies;
    const perf::ArithmeticProbe& mediump = drawing->probe.mediump;
    const Model like = mediump.is_half() && !mediump.keeps_subnormals ? Model::half_flushed : Model::half;
    for (const auto& [name, model] : {std::pair{"mediump here", like}, std::pair{"highp here", Model::in_float}}) {
        Tally& tally = tallies.emplace_back(Tally{.arithmetic = name, .model = model});
        if (const Exemption* exemption = function.exemption(model)) tally.at_most = exemption->at_most;
    }
    return tallies;
}

bool on_context(const Tally& tally) { return tally.arithmetic.ends_with("here"); }

class Search {
public:
    Search(const Subject& subject, const Effort& effort, const Drawing* drawing)
        : subject_(subject), effort_(effort), drawing_(drawing), source_(subject, effort) {
        result_.function = subject.function();
        result_.title = subject.title();
        result_.variant = subject.variant();
        result_.method = source_.method();
        result_.tallies = empty_tallies(subject.function(), drawing);
    }

    FunctionStability run(const std::function<void(std::size_t, std::size_t)>& step) {
        for (Batch batch = source_.next(kBatch); batch.lanes() > 0; batch = source_.next(kBatch)) {
            if (step) step(result_.lanes, source_.planned());
            result_.lanes += batch.lanes();
            try_all(batch, nullptr, {});
        }
        if (result_.lanes == 0)
            throw Error(Fault::usage,
                        subject_.function().place() + ": not one input of " + subject_.function().name +
                            " fulfils its 'where'; it contradicts the ranges, or asks for numbers that are "
                            "hardly ever met");
        for (const Promise& promise : subject_.function().promises) {
            if (promise.kind == Promise::Kind::rising || promise.kind == Promise::Kind::falling) sweep(promise);
        }
        conclude();
        return std::move(result_);
    }

private:
    Columns result_of(const Tally& tally, const Batch& batch) const {
        if (!on_context(tally)) return subject_.run(batch, tally.model);
        return drawn(subject_, batch, *drawing_,
                     tally.arithmetic.starts_with("mediump") ? gl::Arithmetic::half : gl::Arithmetic::full);
    }

    /// All arithmetics over a batch; `sweep` is the promise that it was made for, or nullptr.
    void try_all(const Batch& batch, const Promise* sweep, const std::vector<bool>& begins) {
        std::vector<Columns> in_models;
        const Criteria criteria(subject_, batch);
        for (Tally& tally : result_.tallies) {
            const Allowed& allowed = criteria.of(tally.model);
            const Columns got = result_of(tally, batch);
            const Trial trial{subject_, batch, allowed, got, tally};
            std::vector<double> badness = judge_errors(trial);
            judge_promises(trial, tally.model, badness);
            if (sweep != nullptr) judge_sweep(trial, *sweep, begins, badness);
            if (!on_context(tally) && tally.model != Model::in_double) in_models.push_back(got);
        }
        for (const bool near : criteria.of(Model::half).near_jump) result_.near_jump += near ? 1 : 0;
        fill_strip(result_.strip, subject_, batch, criteria.of(Model::half), in_models);
    }

    void sweep(const Promise& promise) {
        const bool alone = subject_.components() == 1;
        std::vector<std::vector<double>> lanes;
        std::vector<bool> begins;
        for (std::size_t i = 0; i < (alone ? 1 : effort_.sweeps); ++i) {
            const auto one = source_.sweep(promise.parameter, alone ? kBatch : effort_.sweep_points);
            lanes.insert(lanes.end(), one.begin(), one.end());
            for (std::size_t lane = 0; lane < one.size(); ++lane) begins.push_back(lane == 0);
        }
        expect(!lanes.empty(), [&] { return subject_.function().place() + ": a promise is tried with no input"; });
        result_.lanes += lanes.size();
        try_all(batch_of(subject_.function(), lanes), &promise, begins);
    }

    void conclude() {
        const std::string subject = fmt::format("{}: {}", subject_.function().place(), result_.title);
        for (const Tally& tally : result_.tallies) {
            const auto accuse = [&](const Finding& finding, const std::string& what) {
                std::vector<double> input = finding.input;
                if (!on_context(tally)) input = shrunk(subject_, input, tally.model, tally.at_most);
                result_.violations.push_back(fmt::format("{}, {}: {}; try {}", subject, tally.arithmetic, what,
                                                         input_text(subject_.function(), input)));
            };
            if (tally.not_finite > 0) accuse(tally.worst, fmt::format("{} inputs give NaN or inf", tally.not_finite));
            else if (tally.worst.ratio > tally.at_most)
                accuse(tally.worst,
                       fmt::format("{:.3g} times the criterion of {:.3g} ({:.6g} for {:.6g}; {} inputs are over)",
                                   tally.worst.ratio, tally.worst.allowed, tally.worst.got, tally.worst.expected,
                                   tally.over));
            for (const BrokenPromise& broken : tally.broken)
                accuse(broken.first, fmt::format("'{}' does not hold for {} inputs ({:.6g} for {:.6g})", broken.promise,
                                                 broken.lanes, broken.first.got, broken.first.expected));
        }
        const Tally& worst = result_.worst();
        if (worst.worst.ratio >= 0.0)
            result_.steps = steps_of(subject_, worst.worst.input, on_context(worst) ? Model::half : worst.model);
    }

    const Subject& subject_;
    Effort effort_;
    const Drawing* drawing_;
    InputSource source_;
    FunctionStability result_;
};

}  // namespace

const Tally& FunctionStability::worst() const {
    return *std::ranges::max_element(
        tallies, {}, [](const Tally& one) { return one.broken.empty() ? one.worst.ratio / one.at_most : kInfinity; });
}

bool FunctionStability::portable() const {
    return function.exemptions.empty() && std::ranges::all_of(tallies, &Tally::holds);
}

FunctionStability search(const Subject& subject, const Effort& effort, const Drawing* drawing,
                         const std::function<void(std::size_t done, std::size_t planned)>& step) {
    // The criterion moves each component by itself, so the work grows with their square. What hands on uniforms gets
    // fewer inputs for it: the plain function that it calls gets them all.
    Effort scaled = effort;
    constexpr std::size_t kUsual = 12;
    if (!subject.function().plain() && subject.components() > kUsual) {
        scaled.combinations = effort.combinations * kUsual / subject.components();
        scaled.drawn = effort.drawn * kUsual / subject.components();
    }
    return Search(subject, scaled, drawing).run(step);
}

std::vector<double> badness(const Subject& subject, const Batch& batch, Model model) {
    Tally tally{.arithmetic = shader_ir::name(model), .model = model};
    const Criteria criteria(subject, batch);
    const Allowed& allowed = criteria.of(model);
    const Columns got = subject.run(batch, model);
    const Trial trial{subject, batch, allowed, got, tally};
    std::vector<double> lanes = judge_errors(trial);
    judge_promises(trial, model, lanes);
    return lanes;
}

}  // namespace halfframe::stability
