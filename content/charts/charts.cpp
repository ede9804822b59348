// The charts as a scene: albedos, metals, and two ramps of smoothness, with their names and values under them.
#include "content/charts/charts.h"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "content/built_in.h"
#include "content/charts/block_letters.h"
#include "content/content.h"
#include "content/shapes.h"

namespace halfframe::content {
namespace {

constexpr const char* kTalk = "S. Lagarde and L. Harduin, GDC Europe 2013, \"Reference chart\"";
constexpr const char* kFilament = "Filament, \"Material Properties\" chart, 2018";
constexpr const char* kAllegorithmic = "W. McDermott, \"The PBR Guide\", Allegorithmic 2018, table of metals";

// The talk names only the ends, charcoal and fresh snow. (The greys of Filament's coal and rubber lie between.)
constexpr std::array kAlbedos = {
    ChartEntry{"charcoal", {32, 32, 32}, kTalk},        ChartEntry{"coal", {50, 50, 50}, kFilament},
    ChartEntry{"rubber", {53, 53, 53}, kFilament},      ChartEntry{"mud", {85, 61, 49}, kFilament},
    ChartEntry{"wood", {135, 92, 60}, kFilament},       ChartEntry{"vegetation", {123, 130, 78}, kFilament},
    ChartEntry{"brick", {148, 125, 117}, kFilament},    ChartEntry{"sand", {177, 168, 132}, kFilament},
    ChartEntry{"concrete", {192, 191, 187}, kFilament}, ChartEntry{"snow", {243, 243, 243}, kTalk}};

// Published sRGB codes; where two sources differ (silver 250 249 245 elsewhere) they do so by 3 codes at most, but for
// copper (251 216 184), gold (255 220 157), iron (192 189 186) and titanium (206 200 194) in Filament's chart.
constexpr std::array kMetals = {
    ChartEntry{"titanium", {193, 186, 177}, kAllegorithmic},  ChartEntry{"chromium", {196, 197, 197}, kAllegorithmic},
    ChartEntry{"iron", {196, 199, 199}, kAllegorithmic},      ChartEntry{"nickel", {211, 203, 190}, kAllegorithmic},
    ChartEntry{"cobalt", {211, 210, 207}, kAllegorithmic},    ChartEntry{"platinum", {213, 208, 200}, kAllegorithmic},
    ChartEntry{"copper", {250, 208, 192}, kAllegorithmic},    ChartEntry{"gold", {255, 226, 155}, kAllegorithmic},
    ChartEntry{"aluminium", {245, 246, 246}, kAllegorithmic}, ChartEntry{"silver", {252, 250, 245}, kAllegorithmic}};

constexpr int kColumns = 10;
constexpr float kRadius_m = 0.46f;
constexpr float kStepX_m = 1.12f;
constexpr float kStepY_m = 1.52f;
constexpr float kLetters_m = 0.105f;
/// Ours, like the grey of the ramps: smooth enough for metal to show a world, rough enough for albedo to show itself.
constexpr float kMetalRoughness = 0.45f;
constexpr float kAlbedoRoughness = 0.8f;
constexpr ChartEntry kRampGrey{"neutral 5", {122, 122, 121}, kTalk};
constexpr ChartEntry kRampMetal{"chromium", {196, 197, 197}, kAllegorithmic};

/// IEC 61966-2-1.
float linear(int code) {
    const float value = static_cast<float>(code) / 255.0f;
    return value <= 0.04045f ? value / 12.92f : std::pow((value + 0.055f) / 1.055f, 2.4f);
}

/// The glTF roughness of the talk's smoothness: power = 2^(10 smoothness + 1), and the surface's power is
/// 2 / roughness^4 - 2 (engine/effects/surface). The ends are roughness 0.84 and 0.18: beyond, nothing changes.
float roughness_of(float smoothness) {
    const float power = std::exp2(10.0f * smoothness + 1.0f);
    return std::pow(2.0f / (power + 2.0f), 0.25f);
}

Material material_of(const ChartEntry& entry, bool metal, float roughness) {
    Material material;
    material.name = entry.name;
    material.base_color = {linear(entry.srgb[0]), linear(entry.srgb[1]), linear(entry.srgb[2]), 1.0f};
    material.metallic = metal ? 1.0f : 0.0f;
    material.roughness = roughness;
    const float amplitude = std::sqrt(linear(kChartDielectricSpecular));
    material.ior = (1.0f + amplitude) / (1.0f - amplitude);
    return material;
}

/// Spheres on a grid of ten columns, and all labels as one mesh.
class Charts {
public:
    explicit Charts(Scene& scene) : scene_(scene), ball_(add_mesh(scene, sphere(kRadius_m, 64, 32), "sphere")) {}

    void add(int row, int column, Material material, const std::string& label, const std::string& value) {
        const glm::vec3 at((static_cast<float>(column) - 0.5f * (kColumns - 1)) * kStepX_m,
                           (1.5f - static_cast<float>(row)) * kStepY_m, 0.0f);
        const std::string name = material.name;
        add_surface(scene_, name, ball_, add_material(scene_, std::move(material)),
                    glm::translate(glm::mat4(1.0f), at));
        const glm::vec3 under = at - glm::vec3(0.0f, kRadius_m + 1.4f * kLetters_m, 0.0f);
        add_block_letters(labels_, label, under, kLetters_m);
        add_block_letters(labels_, value, under - glm::vec3(0.0f, 1.6f * kLetters_m, 0.0f), kLetters_m);
    }

    void finish() {
        Material ink;
        ink.name = "labels";
        ink.base_color = glm::vec4(0.0f, 0.0f, 0.0f, 1.0f);
        ink.metallic = 1.0f;             // black metal reflects nothing
        ink.emissive = glm::vec3(0.3f);  // a light grey after the tone curve, below what glows
        add_surface(scene_, "labels", add_mesh(scene_, std::move(labels_), "labels"), add_material(scene_, ink),
                    glm::mat4(1.0f));
    }

private:
    Scene& scene_;
    int ball_;
    Mesh labels_;
};

std::string value_text(const ChartEntry& entry) {
    return fmt::format("{} {} {}", entry.srgb[0], entry.srgb[1], entry.srgb[2]);
}

}  // namespace

std::span<const ChartEntry> chart_albedos() { return kAlbedos; }
std::span<const ChartEntry> chart_metals() { return kMetals; }

Scene make_charts() {
    static_assert(kAlbedos.size() == kColumns && kMetals.size() == kColumns);
    Scene scene;
    scene.name = "charts";
    Charts charts(scene);
    for (int column = 0; column < kColumns; ++column) {
        const ChartEntry& albedo = kAlbedos[static_cast<std::size_t>(column)];
        charts.add(0, column, material_of(albedo, false, kAlbedoRoughness), albedo.name, value_text(albedo));
        const ChartEntry& metal = kMetals[static_cast<std::size_t>(column)];
        charts.add(1, column, material_of(metal, true, kMetalRoughness), metal.name, value_text(metal));
        // The chart's smoothness is grey, 0 rough to 1 smooth; its power is 2 to 2048.
        const float smoothness = static_cast<float>(column) / (kColumns - 1);
        for (const bool is_metal : {false, true}) {
            Material material = material_of(is_metal ? kRampMetal : kRampGrey, is_metal, roughness_of(smoothness));
            material.name = fmt::format("{} {:.2f}", material.name, smoothness);
            charts.add(is_metal ? 3 : 2, column, material, fmt::format("smooth {:.2f}", smoothness),
                       is_metal ? "metal" : "no metal");
        }
    }
    charts.finish();
    scene.environment = environment("studio", {.size = 64}).map;
    scene.background = glm::vec3(0.16f, 0.165f, 0.175f);
    Camera camera = camera_looking({0.0f, -0.12f, 20.0f}, {0.0f, -0.12f, 0.0f}, 0.315f, world_box(scene));
    camera.name = "front";
    scene.cameras.push_back(camera);
    return scene;
}

}  // namespace halfframe::content
