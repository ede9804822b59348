// The charts show what the talk's chart allows, under their own names.
#include "content/charts/charts.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "content/charts/block_letters.h"
#include "content/content.h"

namespace halfframe::tests {
namespace {

double linear(double code) {
    const double value = code / 255.0;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}
double code(double light) {
    return 255.0 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1.0 / 2.4) - 0.055);
}
/// The chart bounds brightness, not single channels: gold's blue lies below the least of its column.
double luminance_code(double r, double g, double b) { return code(0.2126 * r + 0.7152 * g + 0.0722 * b); }
double luminance_code(const content::ChartEntry& entry) {
    return luminance_code(linear(entry.srgb[0]), linear(entry.srgb[1]), linear(entry.srgb[2]));
}

TEST(Charts, every_value_lies_in_the_range_of_its_kind_and_has_a_source) {
    std::set<std::string> names;
    for (const content::ChartEntry& entry : content::chart_albedos()) {
        EXPECT_GE(luminance_code(entry), 32.0 - 1e-6) << entry.name;
        EXPECT_LE(luminance_code(entry), 243.0 + 1e-6) << entry.name;
        EXPECT_FALSE(std::string(entry.source).empty()) << entry.name;
        names.insert(entry.name);
    }
    for (const content::ChartEntry& entry : content::chart_metals()) {
        EXPECT_GE(luminance_code(entry), 186.0 - 1e-6) << entry.name;
        EXPECT_LE(luminance_code(entry), 255.0) << entry.name;
        EXPECT_FALSE(std::string(entry.source).empty()) << entry.name;
        names.insert(entry.name);
    }
    EXPECT_EQ(names.size(), content::chart_albedos().size() + content::chart_metals().size());
    EXPECT_GE(names.size(), 20u);
}

TEST(Charts, the_scene_has_the_published_values) {
    const Scene scene = content::open_scene("charts");
    std::size_t seen = 0;
    const auto compare = [&](const content::ChartEntry& entry, float metallic) {
        const auto found = std::find_if(scene.materials.begin(), scene.materials.end(),
                                        [&](const Material& material) { return material.name == entry.name; });
        ASSERT_NE(found, scene.materials.end()) << entry.name;
        EXPECT_EQ(found->metallic, metallic) << entry.name;
        for (int channel = 0; channel < 3; ++channel) {
            // 1e-3 codes: float against double in the sRGB curve
            EXPECT_NEAR(code(found->base_color[channel]), entry.srgb[static_cast<std::size_t>(channel)], 1e-3)
                << entry.name;
        }
        const double amplitude = (found->ior - 1.0) / (found->ior + 1.0);
        EXPECT_NEAR(code(amplitude * amplitude), content::kChartDielectricSpecular, 1e-3) << entry.name;
        ++seen;
    };
    for (const content::ChartEntry& entry : content::chart_albedos()) compare(entry, 0.0f);
    for (const content::ChartEntry& entry : content::chart_metals()) compare(entry, 1.0f);
    EXPECT_GE(seen, 20u);
    // Each sphere, and the labels.
    EXPECT_EQ(scene.surfaces.size(), 2 * seen + 1);
}

TEST(BlockLetters, are_as_wide_as_they_say_and_face_the_front) {
    Mesh mesh;
    const float height_m = 0.7f;
    content::add_block_letters(mesh, "HI", glm::vec3(1.0f, 2.0f, 3.0f), height_m);
    ASSERT_FALSE(mesh.positions.empty());
    const Box box = local_box(mesh);
    // H fills its five squares, I the middle three of its five: one square of 0.1 m is left at the right.
    const float width_m = content::block_letters_width("HI", height_m);
    EXPECT_NEAR(width_m, 1.1f, 1e-6f);
    EXPECT_NEAR(box.low.x, 1.0f - 0.5f * width_m, 1e-5f);
    EXPECT_NEAR(box.high.x, 1.0f + 0.5f * width_m - 0.1f, 1e-5f);
    EXPECT_NEAR(box.low.y, 2.0f - 0.5f * height_m, 1e-5f);
    EXPECT_NEAR(box.high.y, 2.0f + 0.5f * height_m, 1e-5f);
    float area_m2 = 0.0f;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const auto at = [&](std::size_t corner) { return mesh.positions[mesh.indices[i + corner]]; };
        const glm::vec3 cross = glm::cross(at(1) - at(0), at(2) - at(0));
        EXPECT_GT(cross.z, 0.0f) << i;
        area_m2 += 0.5f * cross.z;
    }
    // H has 17 squares, I has 11, of 0.01 m2 each.
    EXPECT_NEAR(area_m2, 0.28f, 1e-5f);
}

TEST(BlockLetters, every_letter_and_digit_differs_from_every_other) {
    std::set<std::string> shapes;
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    for (const char letter : letters) {
        Mesh mesh;
        content::add_block_letters(mesh, std::string(1, letter), glm::vec3(0.0f), 7.0f);
        std::string shape;
        for (const glm::vec3& position : mesh.positions) {
            shape += std::to_string(std::lround(2.0f * position.x)) + " " +
                     std::to_string(std::lround(2.0f * position.y)) + ";";
        }
        EXPECT_TRUE(shapes.insert(shape).second) << letter;
    }
    Mesh small;
    content::add_block_letters(small, "a b", glm::vec3(0.0f), 1.0f);
    Mesh large;
    content::add_block_letters(large, "A B", glm::vec3(0.0f), 1.0f);
    EXPECT_EQ(small.positions, large.positions);
}

}  // namespace
}  // namespace halfframe::tests
