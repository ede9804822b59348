// The same facts for machines.
#include "perf/report/json_report.h"

#include <nlohmann/json.hpp>

namespace halfframe::perf {
namespace {

using Json = nlohmann::ordered_json;

Json program_uses_json(const std::vector<ProgramUse>& uses) {
    Json all = Json::array();
    for (const ProgramUse& use : uses) {
        all.push_back({{"effect", use.effect},
                       {"defines", use.defines},
                       {"insertions", use.insertions},
                       {"draws", use.draws},
                       {"materials", use.users}});
    }
    return all;
}

Json optional_number(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json summary_json(const std::optional<PassTimer::Summary>& summary) {
    if (!summary) {
        return nullptr;
    }
    return {{"median_ms", summary->median_ms},
            {"p25_ms", summary->low_ms},
            {"p75_ms", summary->high_ms},
            {"frames", summary->frames}};
}

Json target_name(const FramePlan& plan, const std::optional<int>& target) {
    return target ? Json(plan.targets[static_cast<std::size_t>(*target)].name) : Json(nullptr);
}

const char* name(StartAction action) {
    switch (action) {
        case StartAction::keep: return "keep";
        case StartAction::clear: return "clear";
        case StartAction::discard: return "discard";
    }
    return "keep";
}

Json pass_json(const FramePlan& plan, const Pass& pass) {
    Json reads = Json::array();
    for (const int target : pass.reads) {
        reads.push_back(plan.targets[static_cast<std::size_t>(target)].name);
    }
    if (pass.resolves) reads.push_back(plan.targets[static_cast<std::size_t>(*pass.resolves)].name);
    return {{"name", pass.name},
            {"effect", pass.effect},
            {"reads", reads},
            {"color", target_name(plan, pass.color)},
            {"depth", target_name(plan, pass.depth)},
            {"writes_color", pass.writes_color},
            {"writes_depth", pass.writes_depth},
            {"start_color", name(pass.start_color)},
            {"start_depth", name(pass.start_depth)},
            {"full_screen", pass.full_screen},
            {"bytes_written", bytes_written(plan, pass)}};
}

Json measurement_json(const FrameReport& report) {
    if (!report.measurement) {
        return nullptr;
    }
    const Measurement& measurement = *report.measurement;
    Json passes = Json::array();
    for (std::size_t index = 0; index < measurement.passes.size(); ++index) {
        passes.push_back({{"pass", report.plan.passes[index].name},
                          {"summary", summary_json(measurement.passes[index])},
                          {"samples_ms", measurement.samples[index]}});
    }
    return {{"method", halfframe::name(measurement.calibration.method)},
            {"calibration", measurement.calibration.sentence},
            {"frame", summary_json(measurement.frame)},
            {"passes", passes}};
}

Json modelled_json(const FrameReport& report) {
    if (!report.modelled) return nullptr;
    Json devices = Json::array();
    for (const ModelledDevice& device : report.modelled->devices) {
        devices.push_back({{"profile", device.name},
                           {"frame_ms", device.frame_ms},
                           {"low_ms", device.low_ms},
                           {"high_ms", device.high_ms},
                           {"other_arithmetic_ms", device.other_arithmetic_ms}});
    }
    return {{"arithmetic", report.modelled->arithmetic}, {"words", report.modelled->words}, {"devices", devices}};
}

Json census_json(const FrameReport& report) {
    if (!report.census) {
        return nullptr;
    }
    Json rows = Json::array();
    for (const CensusRow& row : *report.census) {
        rows.push_back({{"target", row.target},
                        {"values", row.values},
                        {"nan", row.nan},
                        {"inf", row.inf},
                        {"negative", row.negative}});
    }
    return rows;
}

}  // namespace

Json plan_json(const FramePlan& plan) {
    Json targets = Json::array();
    for (const Target& target : plan.targets) {
        targets.push_back({{"name", target.name},
                           {"format", gl::name(target.format)},
                           {"width", target.width},
                           {"height", target.height},
                           {"bytes_per_pixel", gl::bytes_per_pixel(target.format) * target.samples},
                           {"samples", target.samples},
                           {"bytes", target.bytes()}});
    }
    Json passes = Json::array();
    for (const Pass& pass : plan.passes) {
        passes.push_back(pass_json(plan, pass));
    }
    Json effects = Json::array();
    for (const EffectDecision& effect : plan.effects) {
        effects.push_back({{"effect", effect.effect},
                           {"in", effect.in},
                           {"tier", halfframe::name(effect.tier)},
                           {"why", effect.why}});
    }
    return {{"scene", plan.scene},
            {"width", plan.width},
            {"height", plan.height},
            {"tier", halfframe::name(plan.tier)},
            {"arithmetic", halfframe::name(plan.arithmetic)},
            {"storage", gl::name(plan.storage)},
            {"target_bytes", plan.target_bytes()},
            {"bytes_per_pixel", plan.bytes_per_pixel()},
            {"bytes_per_pixel_limit", bytes_per_pixel_limit(plan.tier)},
            {"targets", targets},
            {"passes", passes},
            {"effects", effects},
            {"notices", plan.notices}};
}

Json caps_json(const gl::Caps& caps) {
    Json renders = Json::object();
    for (int index = 0; index < gl::kPixelFormatCount; ++index) {
        if (static_cast<gl::PixelFormat>(index) == gl::PixelFormat::srgb8_alpha8) {
            continue;  // for textures alone: never drawn to
        }
        renders[gl::name(static_cast<gl::PixelFormat>(index))] = caps.renders[static_cast<std::size_t>(index)];
    }
    const auto precision = [](const gl::PrecisionFormat& format) {
        return Json{{"range_min_log2", format.range_min},
                    {"range_max_log2", format.range_max},
                    {"fraction_bits", format.precision}};
    };
    return {{"renderer", caps.renderer},
            {"vendor", caps.vendor},
            {"version", caps.version},
            {"device", caps.device},
            {"es_version", caps.es_version},
            {"desktop", caps.desktop},
            {"core_profile", caps.core_profile},
            {"software", caps.software},
            {"fragment_highp", caps.fragment_highp},
            {"fragment_mediump_format", precision(caps.fragment_mediump)},
            {"fragment_highp_format", precision(caps.fragment_highp_format)},
            {"limits",
             {{"texture_size", caps.max_texture_size},
              {"cube_map_size", caps.max_cube_map_size},
              {"renderbuffer_size", caps.max_renderbuffer_size},
              {"vertex_attributes", caps.max_vertex_attributes},
              {"vertex_uniform_vectors", caps.max_vertex_uniform_vectors},
              {"fragment_uniform_vectors", caps.max_fragment_uniform_vectors},
              {"varying_vectors", caps.max_varying_vectors},
              {"fragment_samplers", caps.max_fragment_samplers},
              {"vertex_samplers", caps.max_vertex_samplers},
              {"combined_samplers", caps.max_combined_samplers},
              {"draw_buffers", caps.max_draw_buffers},
              {"samples", caps.max_samples},
              {"texture_3d_size", caps.max_texture_3d_size}}},
            {"abilities",
             {{"explicit_lod", caps.explicit_lod},
              {"derivatives", caps.derivatives},
              {"index_uint", caps.index_uint},
              {"vertex_array_objects", caps.vertex_array_objects},
              {"sized_formats", caps.sized_formats},
              {"srgb_textures", caps.srgb_textures},
              {"depth_texture", caps.depth_texture},
              {"npot_textures", caps.npot_textures},
              {"program_binary", caps.program_binary},
              {"fence_sync", caps.fence_sync},
              {"timer_query", caps.timer_query},
              {"samples_passed", caps.samples_passed},
              {"debug_labels", caps.debug_labels},
              {"anisotropy", caps.anisotropy},
              {"discard_framebuffer", caps.discard_framebuffer}}},
            {"renders", renders},
            {"extensions", caps.extensions}};
}

Json calls_json(const CallReport& calls) {
    Json passes = Json::array();
    for (const CallsOfPass& pass : calls.passes) {
        Json by_name = Json::object();
        for (const auto& [call, count] : pass.by_name) {
            by_name[call] = count;
        }
        passes.push_back({{"pass", pass.pass},
                          {"calls", pass.calls},
                          {"draws", pass.draws},
                          {"vertices", pass.vertices},
                          {"bytes_uploaded", pass.bytes_uploaded},
                          {"bytes_read_back", pass.bytes_read_back},
                          {"by_name", by_name}});
    }
    return {{"object_creations", calls.object_creations}, {"program_links", calls.program_links}, {"passes", passes}};
}

Json budget_json(const BudgetTable& table) {
    Json lines = Json::array();
    for (const BudgetLine& line : table.lines) {
        lines.push_back({{"name", line.name},
                         {"kind", line.is_pass ? "pass" : "row"},
                         {"published_ms", optional_number(line.published_ms)},
                         {"published_high_ms", optional_number(line.published_high_ms)},
                         {"platforms", line.platforms},
                         {"ours_ms", optional_number(line.ours_ms)},
                         {"source", line.source},
                         {"note", line.note},
                         {"modelled_ps3_ms", optional_number(line.modelled_ms[0])},
                         {"modelled_x360_ms", optional_number(line.modelled_ms[1])},
                         {"modelled_es2_ms", optional_number(line.modelled_ms[2])},
                         {"modelled_bound", line.modelled_bound},
                         {"modelled_over", line.modelled_over},
                         {"measured", summary_json(line.measured)},
                         {"share_of_frame", optional_number(line.share_of_frame)},
                         {"bytes_written", line.bytes},
                         {"verdict", name(line.verdict)},
                         {"verdict_text", line.verdict_text}});
    }
    Json limits = Json::array();
    for (const LimitLine& line : table.limits) {
        limits.push_back({{"name", line.name},
                          {"value", line.value},
                          {"limit", line.limit},
                          {"number", optional_number(line.number)},
                          {"most", line.most},
                          {"unit", line.unit},
                          {"level", halfframe::name(line.level)},
                          {"source", line.source},
                          {"verdict", name(line.verdict)},
                          {"verdict_text", line.verdict_text}});
    }
    return {{"name", table.budget},
            {"frame_ms", table.frame_ms},
            {"exceeded", table.exceeded()},
            {"lines", lines},
            {"limits", limits}};
}

Json report_json(const FrameReport& report, const BudgetTable& table) {
    return {{"scene", report.scene},
            {"camera", report.camera},
            {"picture_file", report.picture_file.empty() ? Json(nullptr) : Json(report.picture_file)},
            {"reproduce", report.reproduce},
            {"context", report.context},
            {"renderer", report.caps.renderer},
            {"version", report.caps.version},
            {"device", report.caps.device},
            {"software", report.caps.software},
            {"plan", plan_json(report.plan)},
            {"budget", budget_json(table)},
            {"modelled", modelled_json(report)},
            {"measurement", measurement_json(report)},
            {"texture_bytes", report.texture_bytes},
            {"prepare_calls", calls_json(report.prepare_calls)},
            {"frame_calls", calls_json(report.frame_calls)},
            {"program_uses", program_uses_json(report.program_uses)},
            {"programs",
             {{"compiled", report.programs.compiled},
              {"from_disk", report.programs.from_disk},
              {"disk_ignored", report.programs.disk_ignored}}},
            {"census", census_json(report)},
            {"notices", report.notices}};
}

}  // namespace halfframe::perf
