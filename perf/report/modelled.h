// What the cost model says of a frame, as a report shows it. Made by halfframe cost; nothing here computes.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace halfframe::perf {

struct ModelledPass {
    std::string pass;
    double ms = 0.0;
    double low_ms = 0.0;
    double high_ms = 0.0;
    std::string bound;  ///< the unit that takes most
    std::vector<std::pair<std::string, double>> units_ms = {};
    double fixed_ms = 0.0;    ///< target switch and draws
    double resolve_ms = 0.0;  ///< from memory on the chip
    double other_arithmetic_ms = 0.0;
};

struct ModelledEffect {
    std::string effect;
    double ms = 0.0;  ///< with what it adds to others' passes
    std::string bound;
    double marginal_ms = 0.0;  ///< of `ms`, in others' passes
};

struct ModelledDevice {
    std::string name;  ///< "ps3", "x360", "es2_class"
    double frame_ms = 0.0;
    double low_ms = 0.0;
    double high_ms = 0.0;
    double other_arithmetic_ms = 0.0;
    std::vector<ModelledPass> passes;
    std::vector<ModelledEffect> effects;
    std::string title = {};  ///< "PlayStation 3, RSX"
};

/// What was counted, by the words of budget_counters(); of a pass or of the frame.
using Counters = std::map<std::string, double, std::less<>>;

struct CountedPass {
    std::string pass;
    Counters counters;
};

struct Modelled {
    std::string arithmetic;  ///< "half": what is modelled, whatever was drawn here
    std::string words;       ///< the sentence that stands under every modelled figure
    std::vector<ModelledDevice> devices;
    Counters frame = {};
    std::vector<CountedPass> counts = {};
    [[nodiscard]] const ModelledDevice* find(std::string_view device) const;
};

/// Of the JSON that halfframe cost SCENE --json prints.
[[nodiscard]] Modelled modelled_from(const nlohmann::ordered_json& cost);

/// The columns of the budget table, in order, and the devices behind them.
inline constexpr const char* kModelledColumns[] = {"ps3", "x360", "es2"};
inline constexpr const char* kModelledDevices[] = {"ps3", "x360", "es2_class"};
inline constexpr int kModelledCount = 3;

}  // namespace halfframe::perf
