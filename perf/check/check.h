// `halfframe check` as a function: a scene against the artists' chart and the budget of its storage.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/frame/scene.h"
#include "perf/check/places.h"
#include "perf/check/rules.h"
#include "perf/check/thresholds.h"

namespace halfframe::check {

/// 5 %, half and 95 % of the texels lie at or below these.
struct Percentiles {
    double p5 = 0.0;
    double p50 = 0.0;
    double p95 = 0.0;
};

/// One material over the texels of its textures' finest level that some triangle reaches.
struct MaterialFigures {
    std::string name;
    std::string place;
    std::size_t texels = 0;
    bool unlit = false;    ///< then nothing of it is judged
    Percentiles albedo;    ///< sRGB code of the luminance; of metal texels 0
    Percentiles specular;  ///< the same
    Percentiles metallic;
    Percentiles smoothness;                        ///< the talk's
    std::array<double, kTexelRuleCount> broken{};  ///< share of the texels that break each rule, 0..1
};

struct MeshFigures {
    std::string name;
    std::string place;
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::size_t degenerate = 0;
    std::size_t unused_vertices = 0;
};

/// The largest error, and the mesh or image that has it. 0 and no name: there is none.
struct Worst {
    double error = 0.0;
    std::string where;
};

/// What the device's storage spares and loses (engine/frame/vertex_storage.h, texture_storage.h): vertices in 16 and 8
/// bits, colour textures in DXT blocks. Other textures keep their 8 bits a channel.
struct StorageFigures {
    std::size_t vertex_bytes_before = 0;  ///< 32-bit floats
    std::size_t vertex_bytes_after = 0;
    std::size_t full_positions = 0;  ///< meshes that keep 32-bit positions
    std::string why_full_positions;  ///< of the worst of them; empty: their vertices move
    Worst positions_mm;              ///< in the world
    Worst normals_degrees;
    Worst tangents_degrees;
    Worst coordinates_texels;  ///< of the largest texture that is read there
    Worst colors_codes;        ///< display codes of 0..255
    std::size_t color_images = 0;
    std::size_t smaller_images = 0;        ///< which the device takes only smaller
    std::size_t texture_bytes_before = 0;  ///< 8 bits a channel with mip levels
    std::size_t texture_bytes_after = 0;   ///< DXT1, or DXT5 with alpha, with mip levels, as large as the device takes
    Worst texture_rms_codes;               ///< root of the mean square over an image
    Worst texture_worst_codes;             ///< of one texel
};

struct Report {
    std::string scene;  ///< as the user named it
    std::string device = "native";
    std::vector<MaterialFigures> materials;  ///< those that something is drawn with, in their order
    std::vector<MeshFigures> meshes;
    StorageFigures storage;
    std::vector<Finding> findings;  ///< errors first
    [[nodiscard]] std::size_t count(Level level) const;
};

struct Request {
    std::filesystem::path file;  ///< empty: the scene is built in
    Thresholds thresholds;
    std::string device = "native";
    std::optional<int> largest_texture;             ///< that the device takes [texels]; none: not known
    std::optional<std::size_t> most_texture_bytes;  ///< of all textures together; none: no limit
};

/// All rules over the whole scene. A file is read once more for what the loader repairs.
[[nodiscard]] Report check_scene(const Scene& scene, const Request& request);

// The parts of it.
void check_materials(const Scene& scene, const Request& request, const Places& places, Report& report);
void check_textures(const Scene& scene, const Request& request, const Places& places, Report& report);
void check_meshes(const Scene& scene, const Request& request, const Places& places, Report& report);
void check_storage(const Scene& scene, const Request& request, Report& report);
/// NORMAL accessors as the file has them; quantized ones too, sparse and compressed ones not.
void check_file_normals(const Request& request, Report& report);

}  // namespace halfframe::check
