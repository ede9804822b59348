// Reads what halfframe cost printed.
#include "perf/report/modelled.h"

#include <nlohmann/json.hpp>

#include "engine/frame/budget.h"

namespace halfframe::perf {
namespace {

using Json = nlohmann::ordered_json;

ModelledPass pass_from(const Json& json) {
    ModelledPass pass{.pass = json.at("pass").get<std::string>(),
                      .ms = json.at("ms").get<double>(),
                      .low_ms = json.at("low_ms").get<double>(),
                      .high_ms = json.at("high_ms").get<double>(),
                      .bound = json.at("bound").get<std::string>()};
    for (const auto& [unit, ms] : json.at("units_ms").items()) pass.units_ms.emplace_back(unit, ms.get<double>());
    pass.fixed_ms = json.at("fixed_ms").get<double>();
    pass.resolve_ms = json.at("resolve_ms").get<double>();
    pass.other_arithmetic_ms = json.at("other_arithmetic_ms").get<double>();
    return pass;
}

ModelledDevice device_from(const Json& json) {
    ModelledDevice device{.name = json.at("profile").get<std::string>(),
                          .frame_ms = json.at("frame_ms").get<double>(),
                          .low_ms = json.at("frame_low_ms").get<double>(),
                          .high_ms = json.at("frame_high_ms").get<double>(),
                          .other_arithmetic_ms = json.at("other_arithmetic_frame_ms").get<double>(),
                          .passes = {},
                          .effects = {},
                          .title = json.at("device").get<std::string>()};
    for (const Json& pass : json.at("passes")) device.passes.push_back(pass_from(pass));
    for (const Json& effect : json.at("effects")) {
        device.effects.push_back({effect.at("effect").get<std::string>(), effect.at("ms").get<double>(),
                                  effect.at("bound").get<std::string>(), effect.at("marginal_ms").get<double>()});
    }
    return device;
}

Counters counters_from(const Json& json) {
    Counters counters;
    for (const std::string_view counter : budget_counters())
        counters.emplace(counter, json.at(std::string(counter)).get<double>());
    return counters;
}

}  // namespace

const ModelledDevice* Modelled::find(std::string_view device) const {
    for (const ModelledDevice& one : devices)
        if (one.name == device) return &one;
    return nullptr;
}

Modelled modelled_from(const Json& cost) {
    Modelled modelled{.arithmetic = cost.at("arithmetic").get<std::string>(),
                      .words = cost.at("modelled").get<std::string>(),
                      .devices = {}};
    for (const Json& device : cost.at("devices")) modelled.devices.push_back(device_from(device));
    modelled.frame = counters_from(cost.at("frame_counts"));
    for (const Json& pass : cost.at("counts"))
        modelled.counts.push_back({pass.at("pass").get<std::string>(), counters_from(pass)});
    return modelled;
}

}  // namespace halfframe::perf
