// Draws one model with every contestant in turn, looks at what they drew, and times them interleaved.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "perf/peers/contestants.h"
#include "perf/peers/models.h"

namespace halfframe::peers {

struct CompareRequest {
    int width = 1280;
    int height = 720;
    int rounds = 9;
    double batch_ms = 700.0;  ///< what one contestant draws at a stretch
    std::filesystem::path environment;
    std::filesystem::path folder;  ///< pictures, logs and what peers need
    std::function<void(const std::string& step)> say = [](const std::string&) {};
};

/// One contestant on one model. Vectors hold one value for each round.
struct Result {
    Contestant contestant;
    std::string driver;
    std::string version;
    std::string lit_by;                  ///< "environment"
    std::vector<std::string> notices;    ///< its own words
    std::optional<std::string> refused;  ///< why it has no times
    std::vector<double> ms;              ///< wall clock of a frame
    std::vector<double> processor_ms;    ///< processor time of all its processes for a frame
    int frames = 0;                      ///< in a round
    double covered = 0.0;                ///< share of the picture that is not background
    double overlap = 0.0;                ///< with what console+full covers
    double brightness = 0.0;             ///< mean display value where covered
    std::filesystem::path picture;
};

struct Comparison {
    Model model;
    std::size_t triangles = 0;
    std::size_t surfaces = 0;
    std::vector<Result> results;  ///< in the order of the contestants
    /// Busiest others of any batch: processor time of processes that were not drawing, as a share of all processors.
    std::vector<double> others_share;
};

[[nodiscard]] Comparison compare(const Model& model, const std::vector<Contestant>& contestants,
                                 const CompareRequest& request);

}  // namespace halfframe::peers
