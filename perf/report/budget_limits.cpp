// Finds the figure that each limit speaks of, and says what takes most of it.
#include "perf/report/budget_limits.h"

#include <algorithm>

#include <fmt/format.h>

#include "content/nearest.h"
#include "engine/error.h"
#include "perf/report/text_table.h"

namespace halfframe::perf {
namespace {

using Of = BudgetLimit::Of;

constexpr double kMiB = 1024.0 * 1024.0;

/// A figure of the frame, or why there is none.
struct Figure {
    std::optional<double> value;
    std::string most_of_it;  ///< what binds it or takes most; may be empty
    std::string missing;     ///< why there is no value
    Verdict without = Verdict::not_measured;
};

Figure no_such(const char* kind, const std::string& wanted, const std::vector<std::string>& there) {
    return {.missing = fmt::format("no {} '{}' in this frame{}", kind, wanted, content::did_you_mean(wanted, there)),
            .without = Verdict::not_called_for};
}

/// Figures of one report.
class Figures {
public:
    Figures(const FrameReport& report, bool judge_frame) : report_(report), judge_frame_(judge_frame) {}

    [[nodiscard]] Figure of(const BudgetLimit& limit) const {
        switch (limit.of) {
            case Of::frame_ms: return limit.column == kMeasuredColumn ? measured_frame() : modelled_frame(limit.column);
            case Of::pass_ms: return pass_ms(limit);
            case Of::effect_ms: return effect_ms(limit);
            case Of::counter: return counter(limit);
            case Of::target_mib: return targets();
            case Of::texture_mib: return {.value = static_cast<double>(report_.texture_bytes) / kMiB};
            case Of::bytes_per_pixel: return {.value = report_.plan.bytes_per_pixel()};
        }
        throw Mistake("a limit of nothing");
    }

private:
    [[nodiscard]] bool times_are_judged() const { return !report_.caps.software || judge_frame_; }

    /// Figures of this machine, if they are to be held against a budget.
    [[nodiscard]] Figure measured(const std::optional<PassTimer::Summary>& summary) const {
        if (!summary) return {.missing = "not measured"};
        Figure figure{.value = summary->median_ms};
        if (times_are_judged()) return figure;
        figure.missing = "not judged here (name a --budget to judge it)";
        figure.without = Verdict::not_judged;
        return figure;
    }

    [[nodiscard]] Figure measured_frame() const {
        if (!report_.measurement) return measured(std::nullopt);
        Figure figure = measured(report_.measurement->frame);
        double most_ms = 0.0;
        for (std::size_t i = 0; i < report_.measurement->passes.size() && i < report_.plan.passes.size(); ++i) {
            if (report_.measurement->passes[i].median_ms <= most_ms) continue;
            most_ms = report_.measurement->passes[i].median_ms;
            figure.most_of_it = fmt::format("most in {}, {} ms", report_.plan.passes[i].name, ms_text(most_ms));
        }
        return figure;
    }

    [[nodiscard]] const ModelledDevice* device(const std::string& column) const {
        return report_.modelled ? report_.modelled->find(column) : nullptr;
    }

    [[nodiscard]] Figure not_modelled() const {
        return {.missing = report_.modelled ? "not modelled here" : "not modelled (give --cost)"};
    }

    [[nodiscard]] Figure modelled_frame(const std::string& column) const {
        const ModelledDevice* on = device(column);
        if (on == nullptr) return not_modelled();
        Figure figure{.value = on->frame_ms};
        const auto most = std::ranges::max_element(on->passes, {}, &ModelledPass::ms);
        if (most != on->passes.end())
            figure.most_of_it = fmt::format("most in {}, {} ms: {}", most->pass, ms_text(most->ms), most->bound);
        return figure;
    }

    [[nodiscard]] Figure pass_ms(const BudgetLimit& limit) const {
        std::vector<std::string> names;
        for (const Pass& pass : report_.plan.passes) names.push_back(pass.name);
        const auto found = std::ranges::find(names, limit.name);
        if (found == names.end()) return no_such("pass", limit.name, names);
        const auto index = static_cast<std::size_t>(found - names.begin());
        if (limit.column == kMeasuredColumn) return measured(measured_together(report_, {index}));
        const ModelledDevice* on = device(limit.column);
        if (on == nullptr || index >= on->passes.size()) return not_modelled();
        return {.value = on->passes[index].ms, .most_of_it = on->passes[index].bound};
    }

    [[nodiscard]] Figure effect_ms(const BudgetLimit& limit) const {
        const EffectDecision* decision = report_.plan.find(limit.name);
        if (decision == nullptr) {
            std::vector<std::string> names;
            for (const EffectDecision& one : report_.plan.effects) names.push_back(one.effect);
            Figure figure = no_such("effect", limit.name, names);
            figure.without = Verdict::not_built;
            return figure;
        }
        if (!decision->in) return {.missing = "not called for", .without = Verdict::not_called_for};
        if (limit.column == kMeasuredColumn) {
            std::vector<std::size_t> passes;
            for (std::size_t i = 0; i < report_.plan.passes.size(); ++i)
                if (report_.plan.passes[i].effect == limit.name) passes.push_back(i);
            return measured(measured_together(report_, passes));
        }
        const ModelledDevice* on = device(limit.column);
        if (on == nullptr) return not_modelled();
        const auto found = std::ranges::find(on->effects, limit.name, &ModelledEffect::effect);
        if (found == on->effects.end()) return not_modelled();
        return {.value = found->ms, .most_of_it = found->bound};
    }

    [[nodiscard]] Figure counter(const BudgetLimit& limit) const {
        if (!limit.pass.empty()) return counter_of_pass(limit);
        // Drawn here: a frame that was not the first, which may leave out what has not changed.
        if (limit.name == "draws" && !report_.frame_calls.passes.empty()) return drawn();
        if (!report_.modelled) return {.missing = "not counted (give --cost)"};
        const auto found = report_.modelled->frame.find(limit.name);
        if (found == report_.modelled->frame.end()) return {.missing = "not counted here"};
        Figure figure{.value = found->second};
        double most = 0.0;
        for (const CountedPass& pass : report_.modelled->counts) {
            const auto part = pass.counters.find(limit.name);
            if (part == pass.counters.end() || part->second <= most) continue;
            most = part->second;
            figure.most_of_it = fmt::format("most in {}, {:.0f}", pass.pass, most);
        }
        return figure;
    }

    [[nodiscard]] Figure drawn() const {
        Figure figure{.value = static_cast<double>(report_.frame_calls.draws())};
        const auto most = std::ranges::max_element(report_.frame_calls.passes, {}, &CallsOfPass::draws);
        figure.most_of_it = fmt::format("most in {}, {}", most->pass, most->draws);
        return figure;
    }

    [[nodiscard]] Figure counter_of_pass(const BudgetLimit& limit) const {
        std::vector<std::string> names;
        for (const Pass& pass : report_.plan.passes) names.push_back(pass.name);
        if (std::ranges::find(names, limit.pass) == names.end()) return no_such("pass", limit.pass, names);
        if (!report_.modelled) return {.missing = "not counted (give --cost)"};
        const auto counted = std::ranges::find(report_.modelled->counts, limit.pass, &CountedPass::pass);
        if (counted == report_.modelled->counts.end()) return {.missing = "not counted here"};
        const auto found = counted->counters.find(limit.name);
        if (found == counted->counters.end()) return {.missing = "not counted here"};
        return {.value = found->second};
    }

    [[nodiscard]] Figure targets() const {
        Figure figure{.value = static_cast<double>(report_.plan.target_bytes()) / kMiB};
        const auto most = std::ranges::max_element(report_.plan.targets, {}, &Target::bytes);
        if (most != report_.plan.targets.end())
            figure.most_of_it = fmt::format("most in {}, {}", most->name, bytes_text(most->bytes()));
        return figure;
    }

    const FrameReport& report_;
    bool judge_frame_;
};

std::string title(const BudgetLimit& limit) {
    const bool measured = limit.column == kMeasuredColumn;
    switch (limit.of) {
        case Of::frame_ms: return measured ? "frame" : "frame on " + limit.column;
        case Of::pass_ms: return limit.name + (measured ? ", measured" : " on " + limit.column);
        case Of::effect_ms: return "effect " + limit.name + (measured ? ", measured" : " on " + limit.column);
        case Of::counter: return limit.name + (limit.pass.empty() ? "" : " of " + limit.pass);
        case Of::target_mib: return "targets";
        case Of::texture_mib: return "textures";
        case Of::bytes_per_pixel: return "bytes a pixel";
    }
    return {};
}

struct Unit {
    const char* name;
    int digits;
};

Unit unit_of(Of of) {
    switch (of) {
        case Of::frame_ms:
        case Of::pass_ms:
        case Of::effect_ms: return {"ms", 2};
        case Of::target_mib:
        case Of::texture_mib: return {"MiB", 2};
        case Of::bytes_per_pixel: return {"B", 1};
        case Of::counter: return {"", 0};
    }
    return {"", 0};
}

std::string with_unit(double value, const Unit& unit) {
    return fmt::format("{:.{}f}{}{}", value, unit.digits, *unit.name == '\0' ? "" : " ", unit.name);
}

LimitLine line_of(const BudgetLimit& limit, const Figure& figure) {
    const Unit unit = unit_of(limit.of);
    LimitLine line{.name = title(limit),
                   .value = figure.value ? with_unit(*figure.value, unit) : "-",
                   .limit = with_unit(limit.most, unit),
                   .level = limit.level,
                   .number = figure.value,
                   .most = limit.most,
                   .unit = unit.name,
                   .source = limit.source};
    if (limit.level == BudgetLevel::off) {
        line.limit = "off";
        line.verdict_text = "off";
    } else if (!figure.missing.empty()) {
        line.verdict = figure.without;
        line.verdict_text = figure.missing;
    } else if (*figure.value > limit.most) {
        line.verdict = limit.level == BudgetLevel::error ? Verdict::over : Verdict::warned;
        // A digit more where two would hide it.
        const double over = *figure.value - limit.most;
        const std::string by = *unit.name == 'm' && over < 1.0 ? ms_text(over) + " ms" : with_unit(over, unit);
        line.verdict_text = "over by " + by + (figure.most_of_it.empty() ? "" : ": " + figure.most_of_it);
    } else {
        line.verdict = Verdict::within;
        line.verdict_text = "within";
    }
    return line;
}

/// Quartiles as PassTimer gives them: by rank, no interpolation.
PassTimer::Summary summary_of(std::vector<double> samples) {
    std::sort(samples.begin(), samples.end());
    const auto at = [&](double part) {
        return samples[static_cast<std::size_t>(part * static_cast<double>(samples.size() - 1) + 0.5)];
    };
    return {.median_ms = at(0.5), .low_ms = at(0.25), .high_ms = at(0.75), .frames = static_cast<int>(samples.size())};
}

}  // namespace

std::optional<PassTimer::Summary> measured_together(const FrameReport& report, const std::vector<std::size_t>& passes) {
    if (!report.measurement || passes.empty()) {
        return std::nullopt;
    }
    if (passes.size() == 1) {
        return report.measurement->passes[passes.front()];
    }
    std::vector<double> sums;
    for (const std::size_t pass : passes) {
        const auto& samples = report.measurement->samples[pass];
        sums.resize(std::max(sums.size(), samples.size()), 0.0);
        for (std::size_t frame = 0; frame < samples.size(); ++frame) {
            sums[frame] += samples[frame];
        }
    }
    if (sums.empty()) {
        return std::nullopt;
    }
    return summary_of(std::move(sums));
}

void expect_column(const std::string& column, const FrameReport& report, const Budget& budget) {
    if (!report.modelled || column.empty() || column == kMeasuredColumn) return;
    std::vector<std::string> known(std::begin(kModelledDevices), std::end(kModelledDevices));
    for (const ModelledDevice& device : report.modelled->devices)
        if (std::ranges::find(known, device.name) == known.end()) known.push_back(device.name);
    known.emplace_back(kMeasuredColumn);
    if (std::ranges::find(known, column) != known.end()) return;
    std::string list;
    for (const std::string& one : known) list += (list.empty() ? "" : ", ") + one;
    throw Error(Fault::input,
                fmt::format("budget {}: no column is called '{}'{} There are {}; halfframe cost --profile "
                            "adds a device of yours",
                            budget.name, column, content::did_you_mean(column, known), list));
}

std::vector<LimitLine> limit_lines(const FrameReport& report, const Budget& budget, bool judge_frame) {
    const Figures figures(report, judge_frame);
    std::vector<LimitLine> lines;
    for (const BudgetLimit& limit : budget.limits_for(report.scene, report.camera, halfframe::name(report.plan.tier))) {
        expect_column(limit.column, report, budget);
        lines.push_back(line_of(limit, figures.of(limit)));
    }
    return lines;
}

}  // namespace halfframe::perf
