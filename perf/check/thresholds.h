// What `halfframe check` lets pass. The built-in values and their sources: content/check/thresholds.json.
#pragma once

#include <string>

namespace halfframe::check {

struct Range {
    double lowest = 0.0;
    double highest = 0.0;
    [[nodiscard]] bool holds(double value) const { return value >= lowest && value <= highest; }
};

struct Thresholds {
    Range albedo;                       ///< sRGB code of the luminance of what is no metal
    double metal_albedo_highest = 0.0;  ///< the same of pure metal, which has none
    Range dielectric_specular;          ///< sRGB code of the luminance at normal incidence
    Range metal_specular;               ///< the same
    Range metallic_between;             ///< what lies strictly between is neither metal nor none
    Range smoothness;                   ///< the talk's, 0 rough to 1 smooth
    double warning_share = 0.0;         ///< share of texels outside a range that warns, 0..1
    double error_share = 0.0;           ///< share that is an error, 0..1
    Range normal_length;                ///< mean length of a normal map's vectors
    double normal_inward_share = 0.0;   ///< share of a normal map that may point into the surface
    int largest_texture_side = 0;       ///< [texels]
    int least_side_with_mipmaps = 0;    ///< [texels]
    double clamped_uv = 0.0;            ///< how far a clamped texture may be left, in units of uv
    double degenerate_share = 0.0;      ///< share of triangles without area that passes, 0..1
    double unused_vertex_share = 0.0;   ///< share of vertices that no triangle names, 0..1
    double vertex_normal_length = 0.0;  ///< how far from 1 a normal's length may be
};

/// The built-in ones, where `name_or_file` is empty or "thresholds"; else a .json file. It may leave keys out, which
/// then are as built in. An unknown key or a value that means nothing: Error(input) with the nearest spelling.
[[nodiscard]] Thresholds thresholds(const std::string& name_or_file = {});

}  // namespace halfframe::check
