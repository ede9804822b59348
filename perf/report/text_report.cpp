// The terminal's view of a plan, a budget, a ledger, a census.
#include "perf/report/text_report.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "perf/report/text_table.h"

namespace halfframe::perf {
namespace {

constexpr std::size_t kLineWidth = 118;

std::string target_names(const FramePlan& plan, const std::vector<int>& targets) {
    std::string text;
    for (const int target : targets) {
        text += (text.empty() ? "" : ", ") + plan.targets[static_cast<std::size_t>(target)].name;
    }
    return text.empty() ? "-" : text;
}

std::string writes_text(const FramePlan& plan, const Pass& pass) {
    std::string text;
    if (pass.color) {
        text = plan.targets[static_cast<std::size_t>(*pass.color)].name + (pass.writes_color ? "" : " (start only)");
    }
    if (pass.depth) {
        text += (text.empty() ? "" : ", ") + plan.targets[static_cast<std::size_t>(*pass.depth)].name +
                (pass.writes_depth ? "" : " (test only)");
    }
    return text.empty() ? "-" : text;
}

const char* name(StartAction action) {
    switch (action) {
        case StartAction::keep: return "keep";
        case StartAction::clear: return "clear";
        case StartAction::discard: return "discard";
    }
    return "keep";
}

std::string formats_text(const FramePlan& plan, const Pass& pass) {
    std::string text;
    for (const auto& target : {pass.color, pass.depth}) {
        if (target) {
            const gl::PixelFormat format = plan.targets[static_cast<std::size_t>(*target)].format;
            text += fmt::format("{}{}", text.empty() ? "" : "+", gl::name(format));
        }
    }
    return text.empty() ? "-" : text;
}

int bytes_per_pixel_of(const FramePlan& plan, const Pass& pass) {
    int bytes = 0;
    for (const auto& target : {pass.color, pass.depth}) {
        if (target) {
            bytes += gl::bytes_per_pixel(plan.targets[static_cast<std::size_t>(*target)].format) *
                     plan.targets[static_cast<std::size_t>(*target)].samples;
        }
    }
    return bytes;
}

std::string start_text(const Pass& pass) {
    std::string text;
    if (pass.color) {
        text = name(pass.start_color);
    }
    if (pass.depth) {
        text += fmt::format("{}{}", text.empty() ? "" : ", ", name(pass.start_depth));
    }
    return text.empty() ? "-" : text;
}

/// Numbers the distinct sources of a table in order of appearance.
class Sources {
public:
    std::string mark(const BudgetLine& line) {
        if (line.source.empty()) {
            return "";
        }
        const std::string text = line.platforms.empty() ? line.source : line.platforms + ": " + line.source;
        const auto [at, added] = numbers_.emplace(text, numbers_.size() + 1);
        if (added) {
            texts_.push_back(text);
        }
        return fmt::format(" [{}]", at->second);
    }
    [[nodiscard]] std::string text() const {
        std::string all;
        for (std::size_t index = 0; index < texts_.size(); ++index) {
            all += wrapped(fmt::format("[{}] {}", index + 1, texts_[index]), kLineWidth, 4) + "\n";
        }
        return all;
    }

private:
    std::map<std::string, std::size_t> numbers_;
    std::vector<std::string> texts_;
};

std::string limits_text(const BudgetTable& table) {
    TextTable limits({{"limit of the frame", Align::left},
                      {"here", Align::right},
                      {"limit", Align::right},
                      {"verdict", Align::left}});
    for (const LimitLine& line : table.limits) {
        limits.add_row({line.name, line.value, line.limit, line.verdict_text});
    }
    return limits.text();
}

}  // namespace

std::string configuration_text(const FramePlan& plan) {
    return fmt::format("{}x{}, tier {}, {} arithmetic, {} storage", plan.width, plan.height, halfframe::name(plan.tier),
                       halfframe::name(plan.arithmetic), gl::name(plan.storage));
}

std::string driver_text(const gl::Caps& caps) {
    return fmt::format("{}, {}, device {}", caps.renderer, caps.version, caps.device);
}

std::string published_text(const BudgetLine& line) {
    if (!line.published_ms) {
        return "-";
    }
    return line.published_high_ms ? ms_text(*line.published_ms) + ".." + ms_text(*line.published_high_ms)
                                  : ms_text(*line.published_ms);
}

std::string modelled_text(const BudgetLine& line, int column) {
    const auto& ms = line.modelled_ms[static_cast<std::size_t>(column)];
    return ms ? ms_text(*ms) : "-";
}

std::string modelled_frame_text(const Modelled& modelled) {
    std::string text = "Modelled frame, " + modelled.arithmetic + " arithmetic:";
    for (const ModelledDevice& device : modelled.devices) {
        text += fmt::format(" {} {} ms ({}..{}),", device.name, ms_text(device.frame_ms), ms_text(device.low_ms),
                            ms_text(device.high_ms));
    }
    text.back() = '.';
    return text + " " + modelled.words;
}

std::string plan_text(const FramePlan& plan) {
    std::string text = fmt::format("plan of {}: {}\n\n", plan.scene, configuration_text(plan));
    TextTable passes({{"pass"}, {"effect"}, {"reads"}, {"writes"}, {"start"}, {"formats"}, {"B/pixel", Align::right}});
    for (const Pass& pass : plan.passes) {
        std::vector<int> reads = pass.reads;
        if (pass.resolves) reads.push_back(*pass.resolves);
        passes.add_row({pass.name, pass.effect, target_names(plan, reads), writes_text(plan, pass), start_text(pass),
                        formats_text(plan, pass), std::to_string(bytes_per_pixel_of(plan, pass))});
    }
    text += passes.text() + "\n";

    TextTable targets({{"target"}, {"format"}, {"size"}, {"B/pixel", Align::right}, {"memory", Align::right}});
    for (const Target& target : plan.targets) {
        targets.add_row({target.name, gl::name(target.format), fmt::format("{}x{}", target.width, target.height),
                         std::to_string(gl::bytes_per_pixel(target.format) * target.samples),
                         bytes_text(target.bytes())});
    }
    targets.add_rule();
    targets.add_row(
        {"together", "", "", fmt::format("{:.1f}", plan.bytes_per_pixel()), bytes_text(plan.target_bytes())});
    text += targets.text();
    text += fmt::format("limit of tier {}: {:.1f} B/pixel\n\n", halfframe::name(plan.tier),
                        bytes_per_pixel_limit(plan.tier));

    TextTable effects({{"effect"}, {""}, {"tier"}, {"why"}});
    for (const EffectDecision& effect : plan.effects) {
        effects.add_row(
            {effect.effect, effect.in ? "in" : "out", effect.in ? halfframe::name(effect.tier) : "-", effect.why});
    }
    return text + effects.text();
}

std::string budget_text(const BudgetTable& table, const FrameReport& report) {
    TextTable rows({{"row, passes"},
                    {"published", Align::left},
                    {"ours", Align::right},
                    {"ps3", Align::right},
                    {"x360", Align::right},
                    {"es2", Align::right},
                    {"here", Align::right},
                    {"p25..p75", Align::left},
                    {fmt::format("of {}", ms_text(table.frame_ms)), Align::right},
                    {"writes", Align::right},
                    {"verdict"}});
    Sources sources;
    for (std::size_t index = 0; index < table.lines.size(); ++index) {
        if (table.repeats_its_row(index)) {
            continue;
        }
        const BudgetLine& line = table.lines[index];
        rows.add_row({(line.is_pass ? "  " : "") + line.name + sources.mark(line), published_text(line),
                      line.ours_ms ? ms_text(*line.ours_ms) : "-", modelled_text(line, 0), modelled_text(line, 1),
                      modelled_text(line, 2), line.measured ? ms_text(line.measured->median_ms) : "-",
                      line.measured ? ms_text(line.measured->low_ms) + ".." + ms_text(line.measured->high_ms) : "-",
                      line.share_of_frame ? fmt::format("{:.1f} %", 100.0 * *line.share_of_frame) : "-",
                      line.bytes > 0 ? bytes_text(line.bytes) : "-", line.verdict_text});
    }
    std::string text =
        fmt::format("budget {} of {}: {}\n", table.budget, report.scene, configuration_text(report.plan));
    text += "driver: " + driver_text(report.caps) + "\n";
    if (report.measurement) {
        text += fmt::format("here: median of {} frames after a first one; {}\n", report.measurement->frame.frames,
                            report.measurement->calibration.sentence);
    } else {
        text += "here: nothing was measured\n";
    }
    text += "\n" + rows.text() + "\n" + limits_text(table) + "\n";
    text +=
        wrapped(
            "All in milliseconds, and columns are never mixed: published is the source's figure on the console named "
            "there, ours an allowance on that console, ps3, x360 and es2 are modelled" +
                std::string(report.modelled ? "" : " (by --cost, which was not given)") + ", here is this device.",
            kLineWidth, 0) +
        "\n";
    if (report.modelled) text += wrapped(modelled_frame_text(*report.modelled), kLineWidth, 0) + "\n";
    if (report.caps.software) {
        text += "This is a software driver: its times are a CPU's, so no console's row is judged by them.\n";
    }
    return text + sources.text();
}

std::string programs_text(const FrameReport& report) {
    std::string text = fmt::format("{} programs of {}\n", report.program_uses.size(), report.scene);
    for (const ProgramUse& use : report.program_uses) {
        text += "  " + use.effect;
        if (use.draws > 0) {
            constexpr std::size_t kNamed = 4;
            std::string names;
            for (std::size_t i = 0; i < std::min(use.users.size(), kNamed); ++i)
                names += (i == 0 ? "" : ", ") + use.users[i];
            if (use.users.size() > kNamed) names += fmt::format(" and {} more", use.users.size() - kNamed);
            text += fmt::format(": {} surface{} of {}", use.draws, use.draws == 1 ? "" : "s", names);
        }
        if (!use.insertions.empty()) text += fmt::format("\n      with code of {}", use.insertions);
        if (!use.defines.empty()) text += fmt::format("\n      {}", use.defines);
        text += "\n";
    }
    return text;
}

std::string ledger_text(const FrameReport& report) {
    TextTable passes({{"pass"},
                      {"calls", Align::right},
                      {"draws", Align::right},
                      {"vertices", Align::right},
                      {"uploaded", Align::right},
                      {"read back", Align::right}});
    const auto add = [&](const CallReport& calls, const std::string& prefix) {
        for (const CallsOfPass& pass : calls.passes) {
            passes.add_row({prefix + pass.pass, std::to_string(pass.calls), std::to_string(pass.draws),
                            std::to_string(pass.vertices), bytes_text(pass.bytes_uploaded),
                            bytes_text(pass.bytes_read_back)});
        }
    };
    add(report.prepare_calls, "prepare: ");
    passes.add_rule();
    add(report.frame_calls, "");
    std::string text = fmt::format("calls of {}: preparing, then one frame\n", report.scene) + passes.text();
    text += fmt::format("objects made in the frame: {}, programs linked in the frame: {}\n\n",
                        report.frame_calls.object_creations, report.frame_calls.program_links);

    TextTable names({{"frame, pass"}, {"call"}, {"count", Align::right}});
    for (const CallsOfPass& pass : report.frame_calls.passes) {
        for (const auto& [call, count] : pass.by_name) {
            names.add_row({pass.pass, call, std::to_string(count)});
        }
    }
    return text + names.text();
}

std::string census_text(const std::vector<CensusRow>& rows) {
    TextTable table({{"target"},
                     {"values", Align::right},
                     {"NaN", Align::right},
                     {"inf", Align::right},
                     {"negative", Align::right}});
    for (const CensusRow& row : rows) {
        table.add_row({row.target, std::to_string(row.values), std::to_string(row.nan), std::to_string(row.inf),
                       std::to_string(row.negative)});
    }
    return "census, every target RGBA32F\n" + table.text();
}

}  // namespace halfframe::perf
