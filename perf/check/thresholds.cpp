// Reads thresholds.
#include "perf/check/thresholds.h"

#include "content/data_lookup.h"

namespace halfframe::check {
namespace {

constexpr const char* kBuiltIn = "thresholds";
constexpr const char* kAdvice = "content/check/thresholds.json shows every key";

void read(const content::JsonPlace& root, const char* key, Range& range, double highest) {
    if (!root.has(key)) return;
    const content::JsonPlace place = root.at(key);
    place.expect_numbers(2, 0.0, highest);
    range = {place.at(0).number(), place.at(1).number()};
    if (range.lowest > range.highest) place.fail("the lower end is above the upper one");
}

void read(const content::JsonPlace& root, const char* key, double& value, double highest) {
    if (root.has(key)) value = root.at(key).number(0.0, highest);
}

void read(const content::JsonPlace& root, const char* key, int& value) {
    if (root.has(key)) value = static_cast<int>(root.at(key).whole(1, 65536));
}

void read_all(const content::JsonPlace& root, Thresholds& result) {
    root.expect_only({"name", "source", "albedo", "metal_albedo_highest", "dielectric_specular", "metal_specular",
                      "metallic_between", "smoothness", "warning_share", "error_share", "normal_length",
                      "normal_inward_share", "largest_texture_side", "least_side_with_mipmaps", "clamped_uv",
                      "degenerate_share", "unused_vertex_share", "vertex_normal_length"});
    constexpr double kLargestCode = 255.0;
    read(root, "albedo", result.albedo, kLargestCode);
    read(root, "metal_albedo_highest", result.metal_albedo_highest, kLargestCode);
    read(root, "dielectric_specular", result.dielectric_specular, kLargestCode);
    read(root, "metal_specular", result.metal_specular, kLargestCode);
    read(root, "metallic_between", result.metallic_between, 1.0);
    read(root, "smoothness", result.smoothness, 1.0);
    read(root, "warning_share", result.warning_share, 1.0);
    read(root, "error_share", result.error_share, 1.0);
    read(root, "normal_length", result.normal_length, 2.0);
    read(root, "normal_inward_share", result.normal_inward_share, 1.0);
    read(root, "largest_texture_side", result.largest_texture_side);
    read(root, "least_side_with_mipmaps", result.least_side_with_mipmaps);
    read(root, "clamped_uv", result.clamped_uv, 1e6);
    read(root, "degenerate_share", result.degenerate_share, 1.0);
    read(root, "unused_vertex_share", result.unused_vertex_share, 1.0);
    read(root, "vertex_normal_length", result.vertex_normal_length, 1.0);
    if (result.warning_share > result.error_share) root.fail("warning_share is above error_share");
    if (result.dielectric_specular.highest >= result.metal_specular.lowest) {
        root.fail("dielectric_specular reaches into metal_specular");
    }
}

}  // namespace

Thresholds thresholds(const std::string& name_or_file) {
    Thresholds result;
    const content::DataDocument built_in = content::open_data("check", kBuiltIn, {}, kAdvice);
    read_all({built_in.json, built_in.source}, result);
    if (!name_or_file.empty() && name_or_file != kBuiltIn) {
        const content::DataDocument own = content::open_data("check", name_or_file, {}, kAdvice);
        read_all({own.json, own.source}, result);
    }
    return result;
}

}  // namespace halfframe::check
