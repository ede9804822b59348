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

Json counts_json(const PassWork& pass) {
    DrawWork sum;
    Temporaries most;
    for (const DrawWork& draw : pass.draws) {
        sum.vertices += draw.vertices;
        sum.triangles += draw.triangles;
        sum.fragments_shaded += draw.fragments_shaded;
        sum.fragments_written += draw.fragments_written;
        if (draw.temporaries.weighted() > most.weighted()) most = draw.temporaries;
    }
    return {{"pass", pass.name},
            {"draws", pass.draws.size()},
            {"vertices", sum.vertices},
            {"triangles", sum.triangles},
            {"fragments_shaded", sum.fragments_shaded},
            {"samples_written", sum.fragments_written},
            {"texture_bytes", pass.texture_bytes},
            {"full_temporaries", most.full},
            {"half_temporaries", most.half},
            {"switches_target", pass.switches_target},
            {"resolves", (pass.color && pass.color->resolved ? 1 : 0) + (pass.depth && pass.depth->resolved ? 1 : 0)}};
}

Json device_json(const DeviceCost& device) {
    Json passes = Json::array();
    for (std::size_t i = 0; i < device.passes.size(); ++i)
        passes.push_back(pass_json(device.passes[i], device.other_passes[i].ms));
    Json effects = Json::array();
    for (const EffectCost& effect : device.effects) {
        effects.push_back({{"effect", effect.effect},
                           {"ms", effect.ms},
                           {"marginal_ms", effect.marginal_ms},
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
    double start_ms = 0.0;
    for (const PassCost& pass : device.passes) {
        process.add(0, pass.name, start_ms, pass.ms,
                    {{"bound", pass.bound},
                     {"low_ms", pass.low_ms},
                     {"high_ms", pass.high_ms},
                     {"memory_bytes", pass.memory_bytes}});
        int thread = 1;
        for (const UnitTime& unit : pass.units) {
            process.name("thread_name", thread, unit.unit);
            if (unit.ms > 0.0) process.add(thread, pass.name, start_ms, unit.ms, {{"unit", unit.unit}});
            ++thread;
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
            {"width", cost.plan.width},
            {"height", cost.plan.height},
            {"tier", halfframe::name(cost.plan.tier)},
            {"arithmetic", halfframe::name(cost.arithmetic)},
            {"storage", gl::name(cost.plan.storage)},
            {"model_version", kModelVersion},
            {"compiler", cost.compiler},
            {"modelled", kModelledWords},
            {"counts", counts},
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
