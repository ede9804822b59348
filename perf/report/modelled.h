// What the cost model says of a frame, as a report shows it. Made by halfframe cost; nothing here computes.
#pragma once

#include <string>
#include <vector>

namespace halfframe::perf {

struct ModelledPass {
    std::string pass;
    double ms = 0.0;
    double low_ms = 0.0;
    double high_ms = 0.0;
    std::string bound;  ///< the unit that takes most
};

struct ModelledEffect {
    std::string effect;
    double ms = 0.0;  ///< with what it adds to others' passes
    std::string bound;
};

struct ModelledDevice {
    std::string name;  ///< "ps3", "x360", "es2_class"
    double frame_ms = 0.0;
    double low_ms = 0.0;
    double high_ms = 0.0;
    double other_arithmetic_ms = 0.0;
    std::vector<ModelledPass> passes;
    std::vector<ModelledEffect> effects;
};

struct Modelled {
    std::string arithmetic;  ///< "half": what is modelled, whatever was drawn here
    std::string words;       ///< the sentence that stands under every modelled figure
    std::vector<ModelledDevice> devices;
    [[nodiscard]] const ModelledDevice* find(const std::string& device) const;
};

/// The columns of the budget table, in order, and the devices behind them.
inline constexpr const char* kModelledColumns[] = {"ps3", "x360", "es2"};
inline constexpr const char* kModelledDevices[] = {"ps3", "x360", "es2_class"};
inline constexpr int kModelledCount = 3;

}  // namespace halfframe::perf
