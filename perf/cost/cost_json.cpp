// A frame's cost as JSON, and as a trace of events.
#include <algorithm>

#include <nlohmann/json.hpp>

#include "perf/cost/cost_report.h"

namespace halfframe::cost {
namespace {

using Json = nlohmann::ordered_json;

Json pass_json(const PassCost& pass, double other_ms) {
    Json units = Json::object();
    for (const UnitTime& unit : pass.units) units[unit.unit] = unit.ms;
    return {{"pass", pass.name},
            {"ms", pass.ms},
            {"low_ms", pass.low_ms},
            {"high_ms", pass.high_ms},
            {"shortest_ms", pass.shortest_ms},
            {"longest_ms", pass.longest_ms},
            {"other_arithmetic_ms", other_ms},
            {"bound", pass.bound},
            {"units_ms", units},
            {"fixed_ms", pass.fixed_ms},
            {"resolve_ms", pass.resolve_ms},
            {"memory_bytes", pass.memory_bytes},
            {"edram_tiles", pass.edram_tiles},
            {"edram_replays", pass.edram_replays},
            {"work_per_fragment", pass.passes},
            {"temporaries", pass.temporaries}};
}

/// By the words of budget_counters().
Json counters_json(const WorkSum& sum, int programs) {
    return {{"draws", static_cast<std::int64_t>(sum.draws)},
            {"vertices", sum.vertices},
            {"triangles", sum.triangles},
            {"fragments_shaded", sum.fragments_shaded},
            {"samples_written", sum.samples_written},
            {"programs", programs},
            {"target_switches", static_cast<std::int64_t>(sum.target_switches)},
            {"resolves", static_cast<std::int64_t>(sum.resolves)}};
}

Json counts_json(const PassWork& pass) {
    WorkSum sum;
    sum.add(pass);
    Json json{{"pass", pass.name}};
    json.update(counters_json(sum, pass.programs));
    json["copies"] = pass.copies;
    json["texture_bytes"] = pass.texture_bytes;
    json["full_temporaries"] = sum.most.full;
    json["half_temporaries"] = sum.most.half;
    return json;
}

Json frame_counts_json(const FrameCost& cost) {
    Json json = counters_json(cost.sum(), cost.programs);
    json["target_bytes"] = cost.plan.target_bytes();
    json["texture_bytes"] = cost.texture_bytes;
    json["bytes_per_pixel"] = cost.plan.bytes_per_pixel();
    return json;
}

Json decisions_json(const FramePlan& plan) {
    Json decisions = Json::array();
    for (const EffectDecision& decision : plan.effects) {
        decisions.push_back({{"effect", decision.effect},
                             {"in", decision.in},
                             {"tier", halfframe::name(decision.tier)},
                             {"why", decision.why}});
    }
    return decisions;
}

Json device_json(const DeviceCost& device) {
    Json passes = Json::array();
    for (std::size_t i = 0; i < device.passes.size(); ++i)
        passes.push_back(pass_json(device.passes[i], device.other_passes[i].ms));
    Json effects = Json::array();
    for (const EffectCost& effect : device.effects) {
        effects.push_back({{"effect", effect.effect},
                           {"passes", effect.passes},
                           {"ms", effect.ms},
                           {"marginal_ms", effect.marginal_ms},
                           {"other_arithmetic_ms", effect.other_ms},
                           {"bound", effect.bound}});
    }
    Json constants = Json::object();
    for (const ConstantValue& constant : device.profile.constants) {
        constants[constant.key] = {
            {"value", constant.value}, {"unit", constant.unit}, {"tag", constant.tag}, {"source", constant.source}};
    }
    return {{"profile", device.profile.name},
            {"device", device.profile.device},
            {"model", name(device.profile.model)},
            {"frame_ms", device.frame_ms()},
            {"frame_low_ms", device.frame_ms(&PassCost::low_ms)},
            {"frame_high_ms", device.frame_ms(&PassCost::high_ms)},
            {"other_arithmetic_frame_ms", device.other_frame_ms()},
            {"passes", passes},
            {"effects", effects},
            {"constants", constants}};
}

/// Events of one process. Times of trace events are microseconds.
class Process {
public:
    Process(Json& events, int id, const std::string& title) : events_(events), id_(id) {
        name("process_name", 0, title);
    }
    void name(const char* kind, int thread, const std::string& words) {
        events_.push_back({{"name", kind}, {"ph", "M"}, {"pid", id_}, {"tid", thread}, {"args", {{"name", words}}}});
    }
    void add(int thread, const std::string& words, double start_ms, double ms, const Json& details) {
        events_.push_back({{"name", words},
                           {"ph", "X"},
                           {"pid", id_},
                           {"tid", thread},
                           {"ts", start_ms * 1e3},
                           {"dur", ms * 1e3},
                           {"args", details}});
    }

private:
    Json& events_;
    int id_;
};

void add_device(Json& events, int id, const DeviceCost& device) {
    Process process(events, id, device.profile.name + " (modelled): " + device.profile.device);
    process.name("thread_name", 0, "passes");
    std::vector<std::string> units;  // each on a thread of its own behind that of the passes
    double start_ms = 0.0;
    for (const PassCost& pass : device.passes) {
        process.add(0, pass.name, start_ms, pass.ms,
                    {{"bound", pass.bound},
                     {"low_ms", pass.low_ms},
                     {"high_ms", pass.high_ms},
                     {"memory_bytes", pass.memory_bytes}});
        for (const UnitTime& unit : pass.units) {
            if (!(unit.ms > 0.0)) continue;
            const auto place = std::ranges::find(units, unit.unit);
            const int thread = static_cast<int>(place - units.begin()) + 1;
            if (place == units.end()) {
                units.emplace_back(unit.unit);
                process.name("thread_name", thread, unit.unit);
            }
            process.add(thread, pass.name, start_ms, unit.ms, {{"unit", unit.unit}});
        }
        start_ms += pass.ms;
    }
}

}  // namespace

Json cost_json(const FrameCost& cost) {
    Json counts = Json::array();
    for (const PassWork& pass : cost.works) counts.push_back(counts_json(pass));
    Json devices = Json::array();
    for (const DeviceCost& device : cost.devices) devices.push_back(device_json(device));
    return {{"scene", cost.scene},
            {"camera", cost.camera},
            {"width", cost.plan.width},
            {"height", cost.plan.height},
            {"tier", halfframe::name(cost.plan.tier)},
            {"arithmetic", halfframe::name(cost.arithmetic)},
            {"storage", gl::name(cost.plan.storage)},
            {"model_version", kModelVersion},
            {"compiler", cost.compiler},
            {"modelled", kModelledWords},
            {"frame_counts", frame_counts_json(cost)},
            {"counts", counts},
            {"effects", decisions_json(cost.plan)},
            {"devices", devices},
            {"notices", cost.notices}};
}

Json cost_trace(const FrameCost& cost, const std::optional<MeasuredPasses>& measured) {
    Json events = Json::array();
    int id = 1;
    for (const DeviceCost& device : cost.devices) add_device(events, id++, device);
    if (measured) {
        Process process(events, id, "measured here: " + measured->device);
        process.name("thread_name", 0, "passes");
        double start_ms = 0.0;
        for (const auto& [pass, ms] : measured->pass_ms) {
            process.add(0, pass, start_ms, ms, Json::object());
            start_ms += ms;
        }
    }
    return {{"traceEvents", events},
            {"displayTimeUnit", "ms"},
            {"otherData", {{"scene", cost.scene}, {"modelled", kModelledWords}}}};
}

}  // namespace halfframe::cost
