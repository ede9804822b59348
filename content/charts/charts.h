// The reference spheres of the artists' charts: names and published values.
#pragma once

#include <array>
#include <span>

#include "engine/frame/scene.h"

namespace halfframe::content {

/// A row of the charts: what artists pick and what a checker must let pass. sRGB codes 0..255.
struct ChartEntry {
    const char* name;
    std::array<int, 3> srgb;
    const char* source;
};
/// Albedo of what is no metal, from dark to bright.
[[nodiscard]] std::span<const ChartEntry> chart_albedos();
/// Specular of pure metals; their albedo is black.
[[nodiscard]] std::span<const ChartEntry> chart_metals();

/// Code 59: the specular of what is no metal, where nothing better is known. The talk, "Specular".
inline constexpr int kChartDielectricSpecular = 59;

[[nodiscard]] Scene make_charts();

}  // namespace halfframe::content
