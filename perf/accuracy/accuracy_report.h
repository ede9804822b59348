// Accuracy figures as a table for a terminal and as JSON.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "perf/accuracy/depth_accuracy.h"
#include "perf/accuracy/frame_accuracy.h"
#include "perf/accuracy/measure.h"
#include "perf/accuracy/model_list.h"
#include "perf/accuracy/storage_accuracy.h"

namespace halfframe::accuracy {

/// The context behind the figures that are not evaluated on the CPU.
struct Here {
    std::string driver;   ///< renderer, version, and what mediump is there
    std::string missing;  ///< why there are no such figures; empty: there are
};

struct AccuracyReport {
    Here here;
    std::vector<FunctionAccuracy> functions = {};
    std::vector<ModelAccuracy> models = {};
    std::vector<StorageAccuracy> storage = {};
    std::vector<DepthAccuracy> depth = {};
    std::vector<FrameAccuracy> frames = {};
    [[nodiscard]] std::vector<std::string> violations() const;
};

/// A table for each part that the report has, the inputs of the largest errors, the bounds with their reasons, and what
/// is exceeded.
[[nodiscard]] std::string accuracy_text(const AccuracyReport& report);

/// The same facts. Errors are in the unit named beside them; a worst input holds every argument by its name.
[[nodiscard]] nlohmann::ordered_json accuracy_json(const AccuracyReport& report);

// The parts, in model_report.cpp and context_report.cpp. Models: what each loses, what it gains, where it is worst.
[[nodiscard]] std::string models_text(const std::vector<ModelAccuracy>& models);
[[nodiscard]] nlohmann::ordered_json models_json(const std::vector<ModelAccuracy>& models);
[[nodiscard]] std::string storage_text(const std::vector<StorageAccuracy>& storage);
[[nodiscard]] nlohmann::ordered_json storage_json(const std::vector<StorageAccuracy>& storage);
[[nodiscard]] std::string depth_text(const std::vector<DepthAccuracy>& depth);
[[nodiscard]] nlohmann::ordered_json depth_json(const std::vector<DepthAccuracy>& depth);
[[nodiscard]] std::string frames_text(const std::vector<FrameAccuracy>& frames);
[[nodiscard]] nlohmann::ordered_json frames_json(const std::vector<FrameAccuracy>& frames);

}  // namespace halfframe::accuracy
