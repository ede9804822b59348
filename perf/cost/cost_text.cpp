// The terminal's view of a frame's cost.
#include <algorithm>

#include <fmt/format.h>

#include "perf/cost/cost_report.h"
#include "perf/report/text_report.h"
#include "perf/report/text_table.h"

namespace halfframe::cost {
namespace {

using perf::Align;
using perf::bytes_text;
using perf::ms_text;
using perf::TextTable;

constexpr std::size_t kLineWidth = 118;

std::string whole(double value) { return fmt::format("{:.0f}", value); }
std::string band(double low_ms, double high_ms) { return ms_text(low_ms) + ".." + ms_text(high_ms); }
const char* other_name(gl::Arithmetic arithmetic) { return arithmetic == gl::Arithmetic::half ? "full" : "half"; }

std::string counts_text(const FrameCost& cost) {
    TextTable table({{"counted"},
                     {"draws", Align::right},
                     {"vertices", Align::right},
                     {"triangles", Align::right},
                     {"fragments shaded", Align::right},
                     {"samples written", Align::right},
                     {"texture bytes", Align::right},
                     {"temporaries", Align::right}});
    const auto add = [&](const std::string& name, const WorkSum& sum, double texture_bytes) {
        table.add_row({name, whole(sum.draws), whole(sum.vertices), whole(sum.triangles), whole(sum.fragments_shaded),
                       whole(sum.samples_written), bytes_text(static_cast<std::size_t>(texture_bytes)),
                       fmt::format("{} full {} half", sum.most.full, sum.most.half)});
    };
    double texture_bytes = 0.0;
    for (const PassWork& pass : cost.works) {
        WorkSum sum;
        sum.add(pass);
        add(pass.name, sum, pass.texture_bytes);
        texture_bytes += pass.texture_bytes;
    }
    table.add_rule();
    add("frame", cost.sum(), texture_bytes);
    return table.text();
}

std::string device_text(const DeviceCost& device, gl::Arithmetic arithmetic) {
    const bool xenos = device.profile.model == ModelKind::xenos;
    std::vector<TextTable::Column> columns{{device.profile.name},     {"ms", Align::right},
                                           {"band", Align::left},     {"branches", Align::left},
                                           {"bound by", Align::left}, {"of it", Align::right}};
    const char* work = device.profile.model == ModelKind::rsx ? "passes" : xenos ? "instr." : "MADs";
    columns.push_back({work, Align::right});
    columns.push_back({"memory", Align::right});
    if (xenos) columns.push_back({"EDRAM tiles", Align::right});
    if (xenos) columns.push_back({"resolve", Align::right});
    columns.push_back({std::string(other_name(arithmetic)) + " ms", Align::right});
    TextTable table(columns);
    const auto add = [&](const std::string& name, const PassCost& pass, double other_ms) {
        const auto most = std::ranges::max_element(pass.units, {}, &UnitTime::ms);
        std::vector<std::string> row{name,
                                     ms_text(pass.ms),
                                     band(pass.low_ms, pass.high_ms),
                                     pass.longest_ms > pass.shortest_ms ? band(pass.shortest_ms, pass.longest_ms) : "-",
                                     pass.bound,
                                     most != pass.units.end() ? ms_text(most->ms) : "-",
                                     fmt::format("{:.1f}", pass.passes),
                                     bytes_text(static_cast<std::size_t>(pass.memory_bytes))};
        if (xenos) {
            row.push_back(pass.edram_replays > 1 ? fmt::format("{} x{}", pass.edram_tiles, pass.edram_replays)
                                                 : std::to_string(pass.edram_tiles));
            row.push_back(pass.resolve_ms > 0.0 ? ms_text(pass.resolve_ms) : "-");
        }
        row.push_back(ms_text(other_ms));
        table.add_row(row);
    };
    for (std::size_t i = 0; i < device.passes.size(); ++i)
        add(device.passes[i].name, device.passes[i], device.other_passes[i].ms);
    table.add_rule();
    std::vector<std::string> total{
        "frame",
        ms_text(device.frame_ms()),
        band(device.frame_ms(&PassCost::low_ms), device.frame_ms(&PassCost::high_ms)),
        band(device.frame_ms(&PassCost::shortest_ms), device.frame_ms(&PassCost::longest_ms)),
        "",
        "",
        "",
        bytes_text(static_cast<std::size_t>(device.frame_ms(&PassCost::memory_bytes)))};
    if (xenos) total.insert(total.end(), {"", ms_text(device.frame_ms(&PassCost::resolve_ms))});
    total.push_back(ms_text(device.other_frame_ms()));
    table.add_row(total);
    return fmt::format("{}: {}\n", device.profile.name, device.profile.device) + table.text();
}

std::string effects_text(const FrameCost& cost) {
    std::vector<TextTable::Column> columns{{"effect"}};
    for (const DeviceCost& device : cost.devices) {
        columns.push_back({device.profile.name, Align::right});
        columns.push_back({"marginal", Align::right});
        columns.push_back({other_name(cost.arithmetic), Align::right});
    }
    TextTable table(columns);
    for (const EffectCost& effect : cost.devices.empty() ? std::vector<EffectCost>{} : cost.devices.front().effects) {
        std::vector<std::string> row{effect.effect};
        for (const DeviceCost& device : cost.devices) {
            const EffectCost* here = device.find(effect.effect);
            row.push_back(ms_text(here->ms));
            row.push_back(here->marginal_ms != 0.0 ? ms_text(here->marginal_ms) : "-");
            row.push_back(ms_text(here->other_ms));
        }
        table.add_row(row);
    }
    return table.text();
}

/// Limits that fit the frame, and the rows of effects that are over in a modelled column.
std::string budget_text(const perf::BudgetTable& budget) {
    TextTable limits(
        {{"budget " + budget.budget}, {"here", Align::right}, {"limit", Align::right}, {"level"}, {"verdict"}});
    for (const perf::LimitLine& line : budget.limits)
        limits.add_row({line.name, line.value, line.limit, halfframe::name(line.level), line.verdict_text});
    std::string text = limits.text();
    std::string rows;
    for (const perf::BudgetLine& line : budget.lines)
        if (!line.modelled_over.empty()) rows += fmt::format("{}: {}\n", line.name, line.modelled_over);
    return text + (rows.empty() ? "" : "\nrows that are over:\n" + rows);
}

std::string paragraph(const std::string& text) { return perf::wrapped(text, kLineWidth, 0) + "\n"; }

}  // namespace

std::string cost_text(const FrameCost& cost, const perf::BudgetTable* budget) {
    FramePlan shown = cost.plan;
    shown.arithmetic = cost.arithmetic;
    std::string text = fmt::format("cost of {}: {}\n", cost.title(), perf::configuration_text(shown));
    text += fmt::format("model version {}, {}\n\n", kModelVersion, cost.compiler) + counts_text(cost);
    for (const DeviceCost& device : cost.devices) text += '\n' + device_text(device, cost.arithmetic);
    text += '\n' + effects_text(cost) + "\n";
    if (budget != nullptr) text += budget_text(*budget) + "\n";
    text += paragraph(
        "Milliseconds. Band: every slot filled, to a third of the slots empty. Branches: all fragments take the short "
        "sides, to all take the long ones; ms has half of them on each side. Of it: the unit that binds, alone. "
        "Marginal: what an effect adds to the passes of others, which is in its own figure and not in theirs.");
    text += paragraph(kModelledWords);
    for (const std::string& notice : cost.notices) text += paragraph("notice: " + notice);
    return text;
}

}  // namespace halfframe::cost
