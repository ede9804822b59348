// The three forms of a check's result.
#include "perf/check/check_report.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "perf/report/text_table.h"

namespace halfframe::check {
namespace {

using Json = nlohmann::ordered_json;

std::string codes(const Percentiles& p) { return fmt::format("{:.0f} {:.0f} {:.0f}", p.p5, p.p50, p.p95); }
std::string shares(const Percentiles& p) { return fmt::format("{:.2f} {:.2f} {:.2f}", p.p5, p.p50, p.p95); }

Json json_of(const Percentiles& p) { return {{"p5", p.p5}, {"p50", p.p50}, {"p95", p.p95}}; }

/// The share of texels that break the worst broken rule; smoothness is only a note and does not count.
double worst_share(const MaterialFigures& figures) {
    return *std::max_element(figures.broken.begin(),
                             figures.broken.begin() + static_cast<int>(RuleId::smoothness_ends));
}

std::string material_table(const Report& report) {
    using perf::Align;
    perf::TextTable table({{"material"},
                           {"texels", Align::right},
                           {"albedo", Align::right},
                           {"specular", Align::right},
                           {"metallic", Align::right},
                           {"smoothness", Align::right},
                           {"outside", Align::right}});
    for (const MaterialFigures& each : report.materials) {
        table.add_row({each.name, std::to_string(each.texels), codes(each.albedo), codes(each.specular),
                       shares(each.metallic), shares(each.smoothness),
                       each.unlit ? "unlit" : fmt::format("{:.1f} %", 100.0 * worst_share(each))});
    }
    return table.text() + "(albedo and specular: sRGB codes of the luminance; each at 5, 50 and 95 % of the texels)\n";
}

std::string grouped(std::size_t count) {
    std::string text = std::to_string(count);
    for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, 1, ' ');
    return text;
}

std::string storage_table(const StorageFigures& figures) {
    using perf::Align;
    perf::TextTable table({{"stored"}, {"bytes", Align::right}, {"after", Align::right}, {"worst error", Align::right},
                           {"in"}});
    table.add_row({"vertices", grouped(figures.vertex_bytes_before), grouped(figures.vertex_bytes_after), "", ""});
    const auto add = [&](const char* what, const Worst& worst, const char* unit) {
        if (!worst.where.empty()) table.add_row({what, "", "", fmt::format("{:.2g} {}", worst.error, unit), worst.where});
    };
    add("  positions", figures.positions_mm, "mm");
    add("  normals", figures.normals_degrees, "degrees");
    add("  tangents", figures.tangents_degrees, "degrees");
    add("  coordinates", figures.coordinates_texels, "texels");
    add("  colours", figures.colors_codes, "display codes");
    if (figures.color_images > 0) {
        table.add_row({"colour textures", grouped(figures.texture_bytes_before), grouped(figures.texture_bytes_after),
                       "", ""});
        add("  mean of an image", figures.texture_rms_codes, "display codes");
        add("  one texel", figures.texture_worst_codes, "display codes");
    }
    std::string text = table.text() + "(vertices: 32-bit floats, then 16 and 8 bits; textures: 8 bits a channel, then "
                                      "DXT where a device has it; mip levels included)\n";
    if (figures.full_positions > 0) {
        text += fmt::format("meshes that keep 32-bit positions: {}; {}\n", figures.full_positions,
                            figures.why_full_positions.empty() ? "their vertices move against each other"
                                                               : figures.why_full_positions);
    }
    if (figures.smaller_images > 0)
        text += fmt::format("images that this device takes only smaller: {}\n", figures.smaller_images);
    return text;
}

Json json_of(const Worst& worst) { return {{"error", worst.error}, {"where", worst.where}}; }

Json json_of(const StorageFigures& figures) {
    return {{"vertices",
             {{"bytes_before", figures.vertex_bytes_before},
              {"bytes_after", figures.vertex_bytes_after},
              {"meshes_with_32_bit_positions", figures.full_positions},
              {"positions_mm", json_of(figures.positions_mm)},
              {"normals_degrees", json_of(figures.normals_degrees)},
              {"tangents_degrees", json_of(figures.tangents_degrees)},
              {"coordinates_texels", json_of(figures.coordinates_texels)},
              {"colors_codes", json_of(figures.colors_codes)}}},
            {"color_textures",
             {{"images", figures.color_images},
              {"made_smaller", figures.smaller_images},
              {"bytes_before", figures.texture_bytes_before},
              {"bytes_after", figures.texture_bytes_after},
              {"rms_codes", json_of(figures.texture_rms_codes)},
              {"worst_codes", json_of(figures.texture_worst_codes)}}}};
}

/// File path as a URI reference: what RFC 3986 does not leave plain is percent-encoded.
std::string uri_of(const std::string& path) {
    std::string uri;
    for (const char character : path) {
        const auto byte = static_cast<unsigned char>(character);
        const bool plain =
            std::isalnum(byte) != 0 || std::string_view("-._~/").find(character) != std::string_view::npos;
        uri += plain && byte < 128 ? std::string(1, character) : fmt::format("%{:02X}", byte);
    }
    return path.starts_with('/') ? "file://" + uri : uri;
}

Json location_of(const Report& report, const Finding& finding) {
    Json location = Json::object();
    const bool is_file = !finding.place.empty();
    if (is_file) location["physicalLocation"] = {{"artifactLocation", {{"uri", uri_of(report.scene)}}}};
    location["logicalLocations"] = Json::array({Json{{"name", finding.thing},
                                                     {"fullyQualifiedName", is_file ? finding.place : finding.thing},
                                                     {"kind", "element"}}});
    return location;
}

Json rules_sarif() {
    Json all = Json::array();
    for (const Rule& rule : rules()) {
        all.push_back({{"id", rule.name},
                       {"shortDescription", {{"text", rule.sentence}}},
                       {"fullDescription", {{"text", fmt::format("{} Source: {}.", rule.sentence, rule.source)}}},
                       {"help", {{"text", rule.remedy}}}});
    }
    return all;
}

}  // namespace

std::string check_text(const Report& report) {
    std::string text = report.materials.empty() ? "" : material_table(report);
    if (report.storage.vertex_bytes_before > 0) text += '\n' + storage_table(report.storage);
    for (const Finding& finding : report.findings) {
        const Rule& broken = rule(finding.rule);
        const std::string where = finding.place.empty() ? "" : finding.place + ", ";
        text += '\n' + perf::wrapped(fmt::format("{} {}: {}{}: {}", name(finding.level), broken.name, where,
                                                 finding.thing, finding.words),
                                     112, 4);
        text += "\n    " + perf::wrapped(broken.remedy, 108, 4) + "\n";
    }
    const auto counted = [&](Level level) {
        const std::size_t count = report.count(level);
        return fmt::format("{} {}{}", count, name(level), count == 1 ? "" : "s");
    };
    text += fmt::format("{}{}: {}, {}, {}\n", text.empty() ? "" : "\n", report.scene, counted(Level::error),
                        counted(Level::warning), counted(Level::note));
    return text;
}

Json check_json(const Report& report) {
    Json materials = Json::array();
    for (const MaterialFigures& each : report.materials) {
        Json broken = Json::object();
        for (int rule_index = 0; rule_index < kTexelRuleCount; ++rule_index) {
            broken[rule(static_cast<RuleId>(rule_index)).name] = each.broken[static_cast<std::size_t>(rule_index)];
        }
        materials.push_back({{"name", each.name},
                             {"place", each.place},
                             {"texels", each.texels},
                             {"unlit", each.unlit},
                             {"albedo", json_of(each.albedo)},
                             {"specular", json_of(each.specular)},
                             {"metallic", json_of(each.metallic)},
                             {"smoothness", json_of(each.smoothness)},
                             {"share_outside", broken}});
    }
    Json meshes = Json::array();
    for (const MeshFigures& each : report.meshes) {
        meshes.push_back({{"name", each.name},
                          {"place", each.place},
                          {"vertices", each.vertices},
                          {"triangles", each.triangles},
                          {"degenerate", each.degenerate},
                          {"unused_vertices", each.unused_vertices}});
    }
    Json findings = Json::array();
    for (const Finding& finding : report.findings) {
        const Rule& broken = rule(finding.rule);
        findings.push_back({{"rule", broken.name},
                            {"level", name(finding.level)},
                            {"place", finding.place},
                            {"thing", finding.thing},
                            {"words", finding.words},
                            {"remedy", broken.remedy}});
    }
    return {{"scene", report.scene},
            {"device", report.device},
            {"errors", report.count(Level::error)},
            {"warnings", report.count(Level::warning)},
            {"notes", report.count(Level::note)},
            {"materials", materials},
            {"meshes", meshes},
            {"storage", json_of(report.storage)},
            {"findings", findings}};
}

Json check_sarif(const Report& report, const std::string& version) {
    Json results = Json::array();
    for (const Finding& finding : report.findings) {
        results.push_back({{"ruleId", rule(finding.rule).name},
                           {"ruleIndex", static_cast<int>(finding.rule)},
                           {"level", name(finding.level)},
                           {"message", {{"text", fmt::format("{}: {}", finding.thing, finding.words)}}},
                           {"locations", Json::array({location_of(report, finding)})}});
    }
    const Json driver{{"name", "halfframe"}, {"version", version}, {"rules", rules_sarif()}};
    const Json run{{"tool", {{"driver", driver}}}, {"results", results}};
    return {{"$schema", "https://docs.oasis-open.org/sarif/sarif/v2.1.0/os/schemas/sarif-schema-2.1.0.json"},
            {"version", "2.1.0"},
            {"runs", Json::array({run})}};
}

}  // namespace halfframe::check
