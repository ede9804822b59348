// One page that stands alone. Bars are drawn against the frame of the budget; past its end a bar is cut and striped.
#include "perf/report/html_page.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include <fmt/format.h>

#include "perf/report/picture_file.h"
#include "perf/report/text_report.h"
#include "perf/report/text_table.h"

namespace halfframe::perf {
namespace {

constexpr std::string_view kStyle = R"css(
:root { color-scheme: light dark; --ink: #1b1d22; --soft: #5b616e; --paper: #fbfbf9; --line: #d9dbe0; --band: #f0f1f3;
  --bar: #2f6f9f; --over: #b3401f; --good: #2c6e3f; --focus: #b3621f; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e6ea; --soft: #a2a8b4; --paper: #16181c; --line: #363a43;
  --band: #1e2126; --bar: #6fb1e0; --over: #f0906c; --good: #86c897; --focus: #f0b06c; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 80rem; padding: 1.5rem 1.25rem 4rem; background: var(--paper); color: var(--ink);
  font: 1rem/1.5 system-ui, "Segoe UI", "Liberation Sans", sans-serif; }
h1 { font-size: 1.5rem; margin: 0 0 .25rem; }
h2 { font-size: 1.3rem; margin: 3rem 0 .5rem; padding-top: 1rem; border-top: 1px solid var(--line); }
h3 { font-size: 1.05rem; margin: 1.75rem 0 .5rem; }
p { margin: .35rem 0; max-width: 60rem; }
.soft, figcaption { color: var(--soft); }
nav a { margin-right: 1rem; }
a { color: var(--bar); }
:focus-visible { outline: 3px solid var(--focus); outline-offset: 2px; }
figure { margin: 1rem 0; }
img { display: block; max-width: 100%; height: auto; border: 1px solid var(--line); }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .875rem; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .25rem .6rem .25rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
thead th { border-bottom: 2px solid var(--line); color: var(--soft); font-weight: 600; vertical-align: bottom; }
tbody th { font-weight: 600; } tr.pass th { font-weight: 400; padding-left: 1.1rem; }
.number { text-align: right; white-space: nowrap; }
caption { text-align: left; font-weight: 600; padding: 1.1rem 0 .3rem; } table.device { min-width: 52rem; }
th.group { text-align: center; }
td:last-child { white-space: nowrap; }
td.why { white-space: normal; }
.bar { min-width: 7rem; } .bar span { display: block; height: .8rem; margin-top: .3rem; background: var(--bar); }
.bar div { background: var(--band); } tr.pass .bar span { height: .5rem; margin-top: .4rem; opacity: .75; }
.bar div { position: relative; } .bar b { position: absolute; top: -.15rem; bottom: -.15rem; width: 2px; background: var(--ink); }
.bar .high { position: absolute; top: 0; margin: 0; opacity: .35; height: 100%; }
tr.pass .bar .high { height: .5rem; margin: 0; } table.device .bar { min-width: 14rem; }
.bar .past { background: repeating-linear-gradient(135deg, var(--over) 0 6px, var(--bar) 6px 12px); }
.over { color: var(--over); font-weight: 600; } .warned { color: var(--focus); font-weight: 600; } .within { color: var(--good); }
.out td, .out th { color: var(--soft); }
pre { overflow-x: auto; padding: .6rem .8rem; background: var(--band);
  font: .85rem/1.45 ui-monospace, "DejaVu Sans Mono", monospace; }
ol.sources { font-size: .875rem; padding-left: 1.4rem; } summary { cursor: pointer; }
@media print { body { max-width: none; } }
)css";

std::string anchor(const std::string& text, std::size_t index) {
    std::string id = fmt::format("scene-{}-", index + 1);
    for (const char character : text) {
        id += std::isalnum(static_cast<unsigned char>(character)) != 0 ? character : '-';
    }
    return id;
}

std::string cell(const std::string& text, const char* style = "") {
    return *style == '\0' ? "<td>" + html_escaped(text) + "</td>"
                          : fmt::format("<td class=\"{}\">{}</td>", style, html_escaped(text));
}

std::string header(std::initializer_list<std::pair<const char*, bool>> titles) {
    std::string row = "<thead><tr>";
    for (const auto& [title, is_number] : titles) {
        row += fmt::format("<th scope=\"col\"{}>{}</th>", is_number ? " class=\"number\"" : "", html_escaped(title));
    }
    return row + "</tr></thead>\n";
}

const char* style_of(Verdict verdict) {
    return verdict == Verdict::over     ? "over"
           : verdict == Verdict::warned ? "warned"
           : verdict == Verdict::within ? "within"
                                        : "";
}

/// What a row allows: the upper end of what was published, or our own.
std::optional<double> allowed_ms(const BudgetLine& line) {
    if (line.published_high_ms) return line.published_high_ms;
    return line.published_ms ? line.published_ms : line.ours_ms;
}

/// A figure, with a mark where its limit is; the longer of the two fills the cell.
std::string marked_bar(double value, double limit) {
    // A tenth more than the limit, so that a mark within has something behind it.
    const double whole = std::max({value, 1.1 * limit, 1e-12});
    return fmt::format(
        "<td class=\"bar\" aria-hidden=\"true\"><div><span{} style=\"width:{:.2f}%\"></span><b "
        "style=\"left:{:.2f}%\"></b>"
        "</div></td>",
        value > limit ? " class=\"past\"" : "", std::clamp(100.0 * value / whole, 0.3, 100.0), 100.0 * limit / whole);
}

/// All bars of a page are of one kind: shares that were measured here or, where nothing was, the modelled PS3.
std::string bar(const BudgetLine& line, bool measured) {
    if (!measured || !line.share_of_frame) {
        const std::optional<double> allowed = measured ? std::nullopt : allowed_ms(line);
        return line.modelled_ms[0] && allowed ? marked_bar(*line.modelled_ms[0], *allowed) : "<td class=\"bar\"></td>";
    }
    const double percent = 100.0 * *line.share_of_frame;
    // The number stands in the column beside it; the bar is for the eye alone.
    return fmt::format("<td class=\"bar\" aria-hidden=\"true\"><div><span{} style=\"width:{:.2f}%\"></span></div></td>",
                       percent > 100.0 ? " class=\"past\"" : "", std::clamp(percent, 0.3, 100.0));
}

/// Distinct sources in order of appearance; the number of `source` in the list, 0 for an empty one.
std::size_t source_number(std::vector<std::string>& sources, const BudgetLine& line) {
    if (line.source.empty()) {
        return 0;
    }
    const std::string text = line.platforms.empty() ? line.source : line.platforms + ": " + line.source;
    const auto found = std::find(sources.begin(), sources.end(), text);
    if (found != sources.end()) {
        return static_cast<std::size_t>(found - sources.begin()) + 1;
    }
    sources.push_back(text);
    return sources.size();
}

std::string budget_rows(const BudgetTable& table, std::vector<std::string>& sources, const std::string& id,
                        bool measured) {
    std::string rows;
    for (std::size_t index = 0; index < table.lines.size(); ++index) {
        if (table.repeats_its_row(index)) {
            continue;
        }
        const BudgetLine& line = table.lines[index];
        const bool out = line.verdict == Verdict::not_built || line.verdict == Verdict::not_called_for;
        const std::size_t number = source_number(sources, line);
        rows += fmt::format("<tr class=\"{}\"><th scope=\"row\">{}",
                            line.is_pass ? "pass"
                            : out        ? "out"
                                         : "row",
                            html_escaped(line.name));
        if (number > 0) {
            rows += fmt::format(" <a href=\"#{0}-source-{1}\" aria-label=\"source {1}\">[{1}]</a>", id, number);
        }
        rows += "</th>" + cell(published_text(line), "number");
        rows += cell(line.ours_ms ? ms_text(*line.ours_ms) : "-", "number");
        for (int column = 0; column < kModelledCount; ++column) rows += cell(modelled_text(line, column), "number");
        rows += cell(line.measured ? ms_text(line.measured->median_ms) : "-", "number");
        rows += cell(line.measured ? ms_text(line.measured->low_ms) + " to " + ms_text(line.measured->high_ms) : "-",
                     "number");
        rows += cell(line.share_of_frame ? fmt::format("{:.1f} %", 100.0 * *line.share_of_frame) : "-", "number");
        rows += bar(line, measured);
        rows += cell(line.bytes > 0 ? bytes_text(line.bytes) : "-", "number");
        const char* style = line.modelled_over.empty() ? style_of(line.verdict) : "why";  // long: it may wrap
        rows += cell(line.verdict_text, style) + "</tr>\n";
    }
    return rows;
}

std::string limit_bar(const LimitLine& line) {
    const bool shown = line.number && line.level != BudgetLevel::off;
    return shown ? marked_bar(*line.number, line.most) : "<td class=\"bar\"></td>";
}

std::string limits_section(const BudgetTable& table) {
    std::string html = "<h3>Limits of the frame</h3>\n<div class=\"wide\"><table>" +
                       header({{"limit", false},
                               {"here", true},
                               {"limit", true},
                               {"bar, mark: limit", false},
                               {"level", false},
                               {"verdict", false}}) +
                       "<tbody>";
    for (const LimitLine& line : table.limits) {
        html += fmt::format("<tr{}><th scope=\"row\"{}>{}</th>", line.level == BudgetLevel::off ? " class=\"out\"" : "",
                            line.source.empty() ? "" : " title=\"" + html_escaped(line.source) + "\"",
                            html_escaped(line.name)) +
                cell(line.value, "number") + cell(line.limit, "number") + limit_bar(line) +
                cell(halfframe::name(line.level)) + cell(line.verdict_text, style_of(line.verdict)) + "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

std::string budget_section(const FrameReport& report, const BudgetTable& table, const std::string& id) {
    std::string html = "<h3>Milliseconds</h3>\n";
    html += fmt::format(
        "<p>{}</p>\n",
        report.measurement
            ? html_escaped(fmt::format("Measured here: median of {} frames after a first one, with the "
                                       "25th to 75th percentile; {}.",
                                       report.measurement->frame.frames, report.measurement->calibration.sentence))
            : "Nothing was measured.");
    html += fmt::format(
        "<p class=\"soft\">Budget {}, in milliseconds. {} Published "
        "figures are of the named console, ours are allowances on it, modelled ones {}; "
        "none is ever mixed with what was measured here.{}</p>\n",
        html_escaped(table.budget),
        report.measurement ? "Bars are shares of its frame, " + ms_text(table.frame_ms) + " ms."
                           : std::string("Bars are the modelled PS3, the mark in them what the row allows."),
        report.modelled ? "are computed from counts" : "were not asked for (--cost)",
        report.caps.software && report.measurement
            ? " This is a software driver: its times are a CPU's, so no console's row "
              "is judged by them."
            : "");
    html += "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"milliseconds\"><table>\n";
    html += fmt::format(
        "<thead><tr><th scope=\"col\" rowspan=\"2\">row, passes</th>"
        "<th scope=\"col\" rowspan=\"2\" class=\"number\">published</th>"
        "<th scope=\"col\" rowspan=\"2\" class=\"number\">ours</th>"
        "<th scope=\"colgroup\" colspan=\"3\" class=\"group\">modelled</th>"
        "<th scope=\"colgroup\" colspan=\"{}\" class=\"group\">measured here</th>{}"
        "<th scope=\"col\" rowspan=\"2\" class=\"number\">writes</th>"
        "<th scope=\"col\" rowspan=\"2\">verdict</th></tr>\n"
        "<tr><th scope=\"col\" class=\"number\">ps3</th><th scope=\"col\" class=\"number\">x360</th>"
        "<th scope=\"col\" class=\"number\">es2</th><th scope=\"col\" class=\"number\">median</th>"
        "<th scope=\"col\" class=\"number\">p25 to p75</th><th scope=\"col\" class=\"number\">of {}</th>"
        "{}</tr></thead>\n",
        report.measurement ? 4 : 3,
        report.measurement ? "" : "<th scope=\"col\" rowspan=\"2\" aria-hidden=\"true\">ps3, mark: allowed</th>",
        ms_text(table.frame_ms), report.measurement ? "<th aria-hidden=\"true\"></th>" : "");
    std::vector<std::string> sources;
    html += "<tbody>" + budget_rows(table, sources, id, report.measurement.has_value()) + "</tbody></table></div>\n";

    html += limits_section(table);
    if (!sources.empty()) {
        html += "<h3>Sources</h3>\n<ol class=\"sources\">";
        for (std::size_t index = 0; index < sources.size(); ++index) {
            html += fmt::format("<li id=\"{}-source-{}\">{}</li>\n", id, index + 1, html_escaped(sources[index]));
        }
        html += "</ol>\n";
    }
    return html;
}

/// The bar of a modelled time on the scale of `whole_ms`: solid for the central value, pale to the end of the band, a
/// mark where the frame ends.
std::string modelled_bar(double ms, double high_ms, double whole_ms, double frame_ms) {
    return fmt::format(
        "<td class=\"bar\" aria-hidden=\"true\"><div><span class=\"high\" style=\"width:{:.2f}%\"></span>"
        "<span{} style=\"width:{:.2f}%\"></span>{}</div></td>",
        std::clamp(100.0 * high_ms / whole_ms, 0.0, 100.0), ms > frame_ms ? " class=\"past\"" : "",
        std::clamp(100.0 * ms / whole_ms, 0.3, 100.0),
        frame_ms <= whole_ms ? fmt::format("<b style=\"left:{:.2f}%\"></b>", 100.0 * frame_ms / whole_ms) : "");
}

/// "shader 14.7, targets 0.6, draws 0.97": units of a pass that take a hundredth of it or more, longest first.
std::string units_text(const ModelledPass& pass) {
    std::vector<std::pair<std::string, double>> units = pass.units_ms;
    units.emplace_back("draws and switches", pass.fixed_ms);
    units.emplace_back("resolve", pass.resolve_ms);
    std::ranges::stable_sort(units, std::ranges::greater{}, [](const auto& unit) { return unit.second; });
    std::string text;
    for (const auto& [unit, ms] : units)
        if (ms >= 0.01 * pass.ms && ms > 0.0)
            text += fmt::format("{}{} {}", text.empty() ? "" : ", ", unit, ms_text(ms));
    return text;
}

std::string modelled_rows(const ModelledDevice& device, double frame_ms) {
    const double whole_ms = std::max(1.05 * frame_ms, device.high_ms);
    std::string html =
        "<tr class=\"row\"><th scope=\"row\">frame</th>" + cell(ms_text(device.frame_ms), "number") +
        cell(ms_text(device.low_ms) + " to " + ms_text(device.high_ms), "number") +
        modelled_bar(device.frame_ms, device.high_ms, whole_ms, frame_ms) +
        cell(ms_text(device.other_arithmetic_ms), "number") +
        (device.frame_ms > frame_ms ? cell("over by " + ms_text(device.frame_ms - frame_ms) + " ms", "over")
                                    : cell("within", "within")) +
        "<td></td></tr>\n";
    for (const ModelledPass& pass : device.passes) {
        html += "<tr class=\"pass\"><th scope=\"row\">" + html_escaped(pass.pass) + "</th>" +
                cell(ms_text(pass.ms), "number") +
                cell(ms_text(pass.low_ms) + " to " + ms_text(pass.high_ms), "number") +
                modelled_bar(pass.ms, pass.high_ms, whole_ms, frame_ms) +
                cell(ms_text(pass.other_arithmetic_ms), "number") + cell(pass.bound) + cell(units_text(pass), "why") +
                "</tr>\n";
    }
    return html;
}

std::string modelled_section(const FrameReport& report, double frame_ms) {
    if (!report.modelled) return "";
    const bool half = report.modelled->arithmetic == "half";
    std::string html = "<h3>Modelled devices</h3>\n<p class=\"soft\">" + html_escaped(report.modelled->words) +
                       fmt::format(
                           " Milliseconds in {} arithmetic, and in {} beside them. The mark in the bars is a "
                           "frame of {} ms, the pale end of a bar the end of its band.</p>\n",
                           half ? "half" : "full", half ? "full" : "half", ms_text(frame_ms));
    for (const ModelledDevice& device : report.modelled->devices) {
        html += fmt::format(
            "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\"><table class=\"device\">"
            "<caption>{0}: {1}</caption>"
            "<thead><tr><th scope=\"col\">pass</th><th scope=\"col\" class=\"number\">ms</th>"
            "<th scope=\"col\" class=\"number\">band</th><th aria-hidden=\"true\"></th>"
            "<th scope=\"col\" class=\"number\">{2}</th>"
            "<th scope=\"col\">bound by</th><th scope=\"col\">units, ms</th></tr></thead><tbody>\n",
            html_escaped(device.name), html_escaped(device.title), half ? "full" : "half");
        html += modelled_rows(device, frame_ms) + "</tbody></table></div>\n";
    }
    return html;
}

std::string effects_section(const FramePlan& plan) {
    std::string html = "<h3>Effects, in and out</h3>\n<div class=\"wide\"><table>" +
                       header({{"effect", false}, {"", false}, {"tier", false}, {"why", false}}) + "<tbody>";
    for (const EffectDecision& effect : plan.effects) {
        html += fmt::format("<tr class=\"{}\"><th scope=\"row\">{}</th>", effect.in ? "in" : "out",
                            html_escaped(effect.effect)) +
                cell(effect.in ? "in" : "out") + cell(effect.in ? halfframe::name(effect.tier) : "-") +
                cell(effect.why, "why") + "</tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

std::string scene_section(const PageScene& scene, std::size_t index) {
    const FrameReport& report = *scene.report;
    const std::string id = anchor(report.scene, index);
    std::string html =
        fmt::format("<section aria-labelledby=\"{0}\"><h2 id=\"{0}\">{1}</h2>\n", id,
                    html_escaped(report.scene + (report.camera.empty() ? "" : ", camera " + report.camera)));
    html += "<p>" + html_escaped(configuration_text(report.plan)) + "</p>\n";
    if (report.display.width > 0) {
        html += fmt::format(
            "<figure><img alt=\"{} rendered\" width=\"{}\" height=\"{}\" src=\"data:image/png;base64,{}\">"
            "<figcaption>{}</figcaption></figure>\n",
            html_escaped(report.scene), report.display.width, report.display.height, base64(png_bytes(report.display)),
            html_escaped(report.picture_file));
    }
    html += budget_section(report, *scene.budget, id);
    html += modelled_section(report, scene.budget->frame_ms);
    html += effects_section(report.plan);
    html += "<h3>Plan</h3>\n<details><summary>Passes and targets of the frame</summary><pre tabindex=\"0\">" +
            html_escaped(plan_text(report.plan)) + "</pre></details>\n";
    if (report.census) {
        html += "<h3>Census</h3>\n<pre tabindex=\"0\">" + html_escaped(census_text(*report.census)) + "</pre>\n";
    }
    if (!report.notices.empty()) {
        html += "<h3>Notices</h3>\n<ul>";
        for (const std::string& notice : report.notices) {
            html += "<li>" + html_escaped(notice) + "</li>\n";
        }
        html += "</ul>\n";
    }
    html += "<h3>Make this again</h3>\n<pre tabindex=\"0\">" + html_escaped(report.reproduce) + "</pre>\n</section>\n";
    return html;
}

}  // namespace

std::string html_escaped(const std::string& text) {
    std::string result;
    for (const char character : text) {
        switch (character) {
            case '&': result += "&amp;"; break;
            case '<': result += "&lt;"; break;
            case '>': result += "&gt;"; break;
            case '"': result += "&quot;"; break;
            default: result += character;
        }
    }
    return result;
}

std::string base64(const std::vector<std::uint8_t>& bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::size_t there = std::min<std::size_t>(3, bytes.size() - at);
        std::uint32_t group = 0;
        for (std::size_t index = 0; index < 3; ++index) {
            group = (group << 8) | (index < there ? bytes[at + index] : 0u);
        }
        for (std::size_t digit = 0; digit < 4; ++digit) {
            text += digit <= there ? kDigits[(group >> (18 - 6 * digit)) & 63u] : '=';
        }
    }
    return text;
}

std::string html_page(const std::vector<PageScene>& scenes) {
    std::string html =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>halfframe "
        "report</title>\n<style>";
    html += kStyle;
    html += "</style>\n</head>\n<body>\n<header><h1>halfframe report</h1>\n";
    // A cost page was drawn nowhere.
    if (!scenes.empty() && !scenes.front().report->caps.renderer.empty()) {
        const FrameReport& first = *scenes.front().report;
        html += "<p class=\"soft\">" + html_escaped(driver_text(first.caps)) + "<br>" + html_escaped(first.context) +
                "</p>\n";
    }
    if (scenes.size() > 1) {
        html += "<nav aria-label=\"scenes\">";
        for (std::size_t index = 0; index < scenes.size(); ++index) {
            const std::string& scene = scenes[index].report->scene;
            html += fmt::format("<a href=\"#{}\">{}</a>", anchor(scene, index), html_escaped(scene));
        }
        html += "</nav>\n";
    }
    html += "</header>\n<main>\n";
    for (std::size_t index = 0; index < scenes.size(); ++index) {
        html += scene_section(scenes[index], index);
    }
    return html + "</main>\n</body>\n</html>\n";
}

}  // namespace halfframe::perf
