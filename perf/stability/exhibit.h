// Listings as talks and articles print them, half everywhere, beside the forms that hold: what each breaks.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/frame/image.h"
#include "perf/stability/search.h"

namespace halfframe::stability {

/// The texts of perf/stability/exhibit, each "exhibit/NAME.glsl".
[[nodiscard]] std::span<const gl::ShaderFile> exhibit_files();

/// One listing. Its file holds `printed()` and `picture_printed()`, and `picture_mended()`, which draws the same with
/// the form that holds.
struct ExhibitEntry {
    const char* name;     ///< of the planted fault, "dot and pow lobe"
    const char* file;     ///< "exhibit/lobe.glsl"
    const char* printed;  ///< the function as printed
    const char* mended_file;
    const char* mended;   ///< the function that holds
    const char* breaks;   ///< in words: which inputs, and why
    const char* shipped;  ///< where halfframe has the form that holds, or why it has none yet
    shader_ir::Model pictured = shader_ir::Model::half;  ///< the arithmetic of the pictures
};

/// Modelled: one call at each pixel of 1280x720, mediump as half. No mediump hardware was measured.
struct FixCost {
    std::string profile;  ///< ps3, x360, es2_class
    double printed_ms = 0.0;
    double mended_ms = 0.0;
};

struct ExhibitResult {
    ExhibitEntry entry;
    FunctionStability printed;
    FunctionStability mended;
    std::vector<FixCost> costs;
    bool found = false;       ///< the printed form is refused, with its file and line; the mended one is not
    Picture picture_printed;
    Picture picture_mended;
    Picture picture_difference;  ///< black where both agree, white from a quarter of the range on
};

[[nodiscard]] std::vector<ExhibitEntry> exhibit_list();
[[nodiscard]] ExhibitResult measure(const ExhibitEntry& entry, const Effort& effort, const Drawing* drawing);

/// The files of shaders_es and the exhibit's.
[[nodiscard]] std::vector<gl::ShaderFile> files_with_exhibit();

}  // namespace halfframe::stability
