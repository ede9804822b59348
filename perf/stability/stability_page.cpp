// The page: what each function promises, its error along its inputs, all arithmetics side by side, its worst input.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "perf/report/html_page.h"
#include "perf/report/picture_file.h"
#include "perf/stability/stability_report.h"

namespace halfframe::stability {
namespace {

using perf::html_escaped;

constexpr std::string_view kStyle = R"css(
:root { color-scheme: light dark; --ink: #16181d; --soft: #555b67; --paper: #fff; --line: #c9ccd3; --band: #eef0f3; }
@media (prefers-color-scheme: dark) { :root { --ink: #e8eaee; --soft: #a8aebb; --paper: #15171b; --line: #3c414b;
  --band: #20242a; } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 72rem; padding: 1.5rem 1.25rem 4rem; background: var(--paper); color: var(--ink);
  font: 1rem/1.5 system-ui, "Liberation Sans", sans-serif; }
h1 { font-size: 1.6rem; margin: 0 0 .25rem; } h2 { font-size: 1.3rem; margin: 2.5rem 0 .5rem; }
h3 { font-size: 1.05rem; margin: 1.5rem 0 .25rem; }
p { margin: .35rem 0; max-width: 60rem; } .soft, figcaption, td.soft { color: var(--soft); }
a { color: inherit; } :focus-visible { outline: 3px solid var(--ink); outline-offset: 2px; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-size: .875rem; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: .2rem .7rem .2rem 0; border-bottom: 1px solid var(--line); vertical-align: top; }
thead th { border-bottom: 2px solid var(--ink); } .number { text-align: right; white-space: nowrap; }
td.over { font-weight: 700; text-decoration: underline; } td.exempt { font-style: italic; }
figure { margin: .75rem 0; } svg, img { display: block; max-width: 100%; height: auto; }
svg text { font: 11px "DejaVu Sans Mono", monospace; fill: var(--ink); }
.pair { display: flex; gap: 1rem; flex-wrap: wrap; } .pair img { border: 1px solid var(--line); width: 22rem;
  image-rendering: pixelated; }
details { border-top: 1px solid var(--line); padding: .4rem 0; } summary { cursor: pointer; }
summary b { font-size: 1.05rem; } pre, code { font: .85rem/1.45 "DejaVu Sans Mono", monospace; }
pre { overflow-x: auto; padding: .5rem .8rem; background: var(--band); white-space: pre-wrap; }
.skip { position: absolute; left: -99rem; } .skip:focus { left: 1rem; }
@media print { details { break-inside: avoid; } body { max-width: none; } }
)css";

constexpr double kWidth = 760.0, kHeight = 170.0, kLeft = 62.0, kTop = 8.0;

/// One line of the strip: the largest error of each bin, as steps; dash patterns tell models apart without colour.
std::string line_of(const std::vector<double>& values, double low, double high, const char* style) {
    std::string path;
    bool pen_down = false;
    for (std::size_t bin = 0; bin < values.size(); ++bin) {
        const double value = values[bin];
        if (!(value >= 0.0) || value == std::numeric_limits<double>::infinity()) {
            pen_down = false;
            continue;
        }
        const double share =
            (std::log10(std::clamp(value, low, high)) - std::log10(low)) / (std::log10(high) - std::log10(low));
        const double y = kTop + kHeight * (1.0 - share);
        const double x = kLeft + kWidth * static_cast<double>(bin) / static_cast<double>(Strip::kBins);
        path += fmt::format("{}{:.1f} {:.1f}H{:.1f}", pen_down ? "L" : "M", x, y, x + kWidth / Strip::kBins);
        pen_down = true;
    }
    return fmt::format("<path d=\"{}\" fill=\"none\" stroke=\"currentColor\" {}/>", path, style);
}

std::string strip_svg(const FunctionStability& function) {
    const Strip& strip = function.strip;
    if (strip.at.empty()) return "";
    double low = HUGE_VAL, high = 0.0;
    const auto widen = [&](double value) {
        if (!(value > 0.0) || !std::isfinite(value)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    };
    for (const double value : strip.allowed) widen(value);
    for (const auto& errors : strip.errors) std::ranges::for_each(errors, widen);
    if (high == 0.0) return "<p class=\"soft\">No arithmetic is off by anything, anywhere.</p>";
    low = std::pow(10.0, std::floor(std::log10(std::max(low, high * 1e-9))));
    high = std::pow(10.0, std::ceil(std::log10(high)));
    std::string svg = fmt::format(
        "<figure><svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"Largest error of {} along {}, logarithmic\">",
        kLeft + kWidth + 10, kTop + kHeight + 34, html_escaped(function.title), html_escaped(strip.parameter));
    for (const double level : {low, std::sqrt(low * high), high}) {
        const double y =
            kTop + kHeight * (1.0 - (std::log10(level) - std::log10(low)) / (std::log10(high) - std::log10(low)));
        svg += fmt::format(
            "<path d=\"M{} {:.1f}H{}\" stroke=\"currentColor\" opacity=\".25\"/>"
            "<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{:.0e}</text>",
            kLeft, y, kLeft + kWidth, kLeft - 6, y + 4, level);
    }
    for (const std::size_t bin :
         {std::size_t{0}, Strip::kBins / 4, Strip::kBins / 2, 3 * Strip::kBins / 4, Strip::kBins}) {
        const double x = kLeft + kWidth * static_cast<double>(bin) / static_cast<double>(Strip::kBins);
        svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"{}\">{:.3g}</text>", x, kTop + kHeight + 15,
                           bin == 0              ? "start"
                           : bin == Strip::kBins ? "end"
                                                 : "middle",
                           strip.at[bin]);
    }
    // float, half, half_flushed, es_minimum: the order of kModels behind double.
    constexpr const char* kStyles[] = {"stroke-width=\"1\" opacity=\".45\"", "stroke-width=\"2.2\"",
                                       "stroke-width=\"1.4\" stroke-dasharray=\"7 4\"",
                                       "stroke-width=\"1.4\" stroke-dasharray=\"2 3\""};
    for (std::size_t m = 0; m < strip.errors.size(); ++m) svg += line_of(strip.errors[m], low, high, kStyles[m]);
    svg += line_of(strip.allowed, low, high, "stroke-width=\"5\" opacity=\".22\"");
    return svg + fmt::format(
                     "</svg><figcaption>Largest error along {} (its halves, evenly). Thick line half, dashed "
                     "flushed, dotted ES minimum, thin float; the broad grey line is the least that the "
                     "criterion allows there.</figcaption></figure>\n",
                     html_escaped(strip.parameter));
}

std::string verdict_cell(const Tally& tally, bool exempted) {
    const bool fails = !tally.holds();
    const double ratio = std::max(tally.worst.ratio, 0.0);
    return fmt::format("<td class=\"number{}\">{}{}</td>",
                       fails      ? " over"
                       : exempted ? " exempt"
                                  : "",
                       tally.broken.empty() ? ratio_text(ratio) : "broken",
                       fails      ? " &#10007;"
                       : exempted ? " *"
                                  : "");
}

const char* const kArithmetics[] = {"double",     "float",        "half",      "half_flushed",
                                    "es_minimum", "mediump here", "highp here"};

std::string row_of(const FunctionStability& function, std::size_t index) {
    std::string row =
        fmt::format("<tr><th scope=\"row\"><a href=\"#f{}\">{}</a></th>", index, html_escaped(function.title));
    for (const char* arithmetic : kArithmetics) {
        const auto tally = std::ranges::find(function.tallies, arithmetic, &Tally::arithmetic);
        row += tally == function.tallies.end()
                   ? std::string("<td class=\"number\">-</td>")
                   : verdict_cell(*tally, function.function.exemption(tally->model) != nullptr);
    }
    return row + fmt::format("<td class=\"number\">{}</td></tr>\n", function.lanes);
}

std::string table_of(const std::vector<FunctionStability>& functions) {
    std::string table =
        "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"all "
        "functions\"><table><thead><tr><th>function</th>";
    for (const char* arithmetic : kArithmetics)
        table += fmt::format("<th class=\"number\" scope=\"col\">{}</th>", arithmetic);
    table += "<th class=\"number\" scope=\"col\">inputs</th></tr></thead><tbody>\n";
    for (std::size_t i = 0; i < functions.size(); ++i) table += row_of(functions[i], i);
    return table + "</tbody></table></div>\n";
}

std::string scalars_text(const std::vector<double>& scalars) {
    std::string text;
    for (const double x : scalars) text += fmt::format("{}{:.6g}", text.empty() ? "" : ", ", x);
    return text;
}

std::string steps_table(const FunctionStability& function) {
    if (function.steps.empty()) return "";
    std::string table =
        "<div class=\"wide\" tabindex=\"0\" role=\"region\" aria-label=\"steps\"><table><thead><tr><th>step</th><th>in "
        "double</th><th>in this "
        "arithmetic</th>"
        "</tr></thead><tbody>\n";
    for (const Step& step : function.steps)
        table +=
            fmt::format("<tr><td><code>{}</code><br><span class=\"soft\">{}</span></td><td>{}</td><td>{}</td></tr>\n",
                        html_escaped(step.text), html_escaped(step.place), scalars_text(step.in_double),
                        scalars_text(step.in_model));
    return table + "</tbody></table></div>\n";
}

std::string promise_line(const Declaration& function) {
    std::string text;
    for (const DeclaredParameter& one : function.parameters) {
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", one.name,
                            one.domain.kind == Domain::Kind::any ? "any, NaN and inf too"
                            : one.domain.kind == Domain::Kind::unit
                                ? "of length 1"
                                : fmt::format("{:g}..{:g}", one.domain.low, one.domain.high));
    }
    if (!function.where.empty()) text += ", where " + function.where;
    text += ": finite";
    for (const Promise& one : function.promises) {
        if (one.kind != Promise::Kind::finite) text += "; " + one.text;
    }
    return text + ".";
}

std::string section(const FunctionStability& function, std::size_t index, const std::string& command, bool open) {
    const Tally& worst = function.worst();
    std::string html = fmt::format("<details{}><summary><b>{}</b> <span class=\"soft\">{}</span></summary>\n",
                                   open && !function.violations.empty() ? " open" : "", html_escaped(function.title),
                                   html_escaped(function.function.place()));
    // A browser opens what holds the target of a link, and not the target itself.
    html += fmt::format("<p id=\"f{}\" tabindex=\"-1\">{}</p>\n", index, html_escaped(promise_line(function.function)));
    for (const Exemption& one : function.function.exemptions)
        html +=
            fmt::format("<p class=\"soft\">Exempt, {}: {}</p>\n", html_escaped(one.bound()), html_escaped(one.reason));
    for (const std::string& one : function.violations)
        html += "<p><b>Does not hold:</b> " + html_escaped(one) + "</p>\n";
    html += strip_svg(function);
    if (worst.worst.ratio > 0.0) {
        html += fmt::format("<p>Worst, {}: {}. It gives {:.7g} for {:.7g}; {:.3g} is allowed.</p>\n", worst.arithmetic,
                            html_escaped(input_text(function.function, worst.worst.input)), worst.worst.got,
                            worst.worst.expected, worst.worst.allowed);
        html += steps_table(function);
    }
    return html + fmt::format("<p>{}. Again: <code>{}</code></p></details>\n", html_escaped(function.method),
                              html_escaped(command));
}

std::string picture(const Picture& drawn, const std::string& words) {
    return fmt::format("<figure><img alt=\"{}\" src=\"data:image/png;base64,{}\"><figcaption>{}</figcaption></figure>",
                       html_escaped(words), perf::base64(perf::png_bytes(drawn)), html_escaped(words));
}

std::string costs_paragraph(const std::vector<FixCost>& costs) {
    std::string words;
    for (const FixCost& cost : costs) {
        words +=
            fmt::format("{}{} {:+.3f} ms ({:.3f} for {:.3f})", words.empty() ? "" : "; ", html_escaped(cost.profile),
                        cost.mended_ms - cost.printed_ms, cost.mended_ms, cost.printed_ms);
    }
    return "<p>What the fix costs, modelled, one call at each pixel of 1280x720, mediump as half (no mediump hardware "
           "was "
           "measured): " +
           words + ".</p>\n";
}

std::string exhibit_section(const std::vector<ExhibitResult>& exhibit) {
    if (exhibit.empty()) return "";
    std::string html = "<h2 id=\"exhibit\">Listings as printed, half everywhere</h2>\n";
    for (std::size_t i = 0; i < exhibit.size(); ++i) {
        const ExhibitResult& one = exhibit[i];
        html += fmt::format("<h3>{}: {}</h3><p>Breaks at {}. Here: {}.</p>\n", html_escaped(one.entry.name),
                            one.found ? "found" : "not found", html_escaped(one.entry.breaks),
                            html_escaped(one.entry.shipped));
        if (!one.printed.violations.empty())
            html += "<p class=\"soft\">" + html_escaped(one.printed.violations.front()) + "</p>\n";
        html += costs_paragraph(one.costs);
        const std::string arithmetic =
            one.entry.pictured == shader_ir::Model::half ? "half" : "half without subnormals";
        html += "<div class=\"pair\">" + picture(one.picture_printed, "as printed, in " + arithmetic) +
                picture(one.picture_mended, one.entry.mended + std::string(", in ") + arithmetic) +
                picture(one.picture_difference, "where they differ, four times as strong") + "</div>\n";
        html += section(one.printed, 1000 + 2 * i, "halfframe stability", false) +
                section(one.mended, 1001 + 2 * i, "halfframe stability", true);
    }
    return html;
}

}  // namespace

std::string stability_page(const StabilityReport& report) {
    std::string html =
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Where half breaks</title>\n"
        "<meta name=\"viewport\" content=\"width=device-width\"><style>";
    html += kStyle;
    html += "</style></head><body><a class=\"skip\" href=\"#table\">To the table</a>\n<h1>Where half breaks</h1>\n";
    const std::vector<std::string> violations = report.violations();
    html +=
        fmt::format("<p><b>{}</b> {} inputs through {} functions; NaN or inf: {}. {}</p>\n",
                    violations.empty() ? "Everything holds." : fmt::format("{} things do not hold.", violations.size()),
                    report.inputs(), report.functions.size(), report.not_finite(),
                    report.in_shaders_es == 0
                        ? ""
                        : fmt::format("Covered: {} of the {} functions of shaders_es, {} of them with a reason not "
                                      "to be run alone. Planted faults found: {} of {}.",
                                      report.covered(), report.in_shaders_es, report.not_run.size(), report.found(),
                                      report.exhibit.size()));
    html += fmt::format(
        "<p class=\"soft\">{}</p>\n",
        html_escaped(report.missing.empty() ? "Drawn on " + report.driver : "Nothing was drawn: " + report.missing));
    html +=
        "<p class=\"soft\">A figure is the largest error over what is allowed: 4 times what rounding the inputs must "
        "cause, "
        "and 2 steps of the result. Above 1 it fails and is crossed; a star marks an exemption, which is told "
        "below.</p>\n";
    html += "<h2 id=\"table\">All functions</h2>\n" + table_of(report.functions);
    html += "<h2>One by one</h2>\n";
    for (std::size_t i = 0; i < report.functions.size(); ++i)
        html += section(report.functions[i], i, "halfframe stability " + report.functions[i].function.name, true);
    html += exhibit_section(report.exhibit);
    if (!report.not_run.empty()) html += "<h2>Not run alone</h2>\n<ul>\n";
    for (const Declaration& one : report.not_run)
        html += fmt::format("<li><code>{}</code> {}: {}</li>\n", html_escaped(one.name), html_escaped(one.place()),
                            html_escaped(one.not_run));
    if (!report.not_run.empty()) html += "</ul>\n";
    return html + "</body></html>\n";
}

}  // namespace halfframe::stability
