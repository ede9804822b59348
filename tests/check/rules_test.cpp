// Every rule finds the fault planted for it, and nothing else; a clean scene has none.
#include <functional>
#include <set>

#include <gtest/gtest.h>

#include "content/charts/charts.h"
#include "content/content.h"
#include "perf/check/texels.h"
#include "tests/check/planted.h"

namespace halfframe::check {
namespace {

struct Planted {
    RuleId rule;
    const char* expected;  ///< as findings_of() has it
    std::function<void(Scene&)> plant;
};

Material& material(Scene& scene) { return scene.materials[0]; }

const std::vector<Planted>& planted() {
    static const std::vector<Planted> kPlanted{
        {RuleId::albedo_dark, "error albedo-dark",
         [](Scene& s) {
             paint(s, kBaseImage, {20, 20, 20, 255});
         }},
        {RuleId::albedo_bright, "error albedo-bright",
         [](Scene& s) {
             paint(s, kBaseImage, {250, 250, 250, 255});
         }},
        {RuleId::metal_albedo, "error metal-albedo",
         [](Scene& s) {
             material(s).model = MaterialModel::specular_glossiness;
             material(s).specular = glm::vec3(0.8f);
             material(s).smoothness = 0.5f;
         }},
        {RuleId::dielectric_specular, "error dielectric-specular", [](Scene& s) { material(s).ior = 1.2f; }},
        {RuleId::metal_specular, "error metal-specular",
         [](Scene& s) {
             paint(s, kMetalImage, {255, 102, 255, 255});
         }},
        {RuleId::specular_gap, "error specular-gap",
         [](Scene& s) {
             material(s).model = MaterialModel::specular_glossiness;
             material(s).specular = glm::vec3(0.2f);
             material(s).smoothness = 0.5f;
         }},
        {RuleId::metallic_between, "error metallic-between",
         [](Scene& s) {
             paint(s, kMetalImage, {255, 102, 128, 255});
         }},
        {RuleId::smoothness_ends, "note smoothness-ends",
         [](Scene& s) {
             paint(s, kMetalImage, {255, 255, 0, 255});
         }},
        {RuleId::texture_power_of_two, "warning texture-power-of-two",
         [](Scene& s) {
             s.images[kBaseImage] = plain_image("base", 48, {128, 128, 128, 255}, true);
         }},
        {RuleId::texture_size, "warning texture-size",
         [](Scene& s) {
             s.images[kNormalImage] = plain_image("normal", 4096, {128, 128, 255, 255}, false);
         }},
        {RuleId::texture_mipmaps, "warning texture-mipmaps",
         [](Scene& s) { material(s).base_color_texture.mipmaps = false; }},
        {RuleId::texture_wrap, "warning texture-wrap",
         [](Scene& s) {
             material(s).base_color_texture.wrap_u = Wrap::clamp;
             for (glm::vec2& uv : s.meshes[0].uv) uv.x *= 1.5f;
         }},
        {RuleId::images_duplicate, "warning images-duplicate",
         [](Scene& s) {
             material(s).emissive_texture.image =
                 content::add_image(s, plain_image("copy", 64, {128, 128, 128, 255}, true));
         }},
        {RuleId::alpha_unused, "warning alpha-unused", [](Scene& s) { material(s).alpha_mode = AlphaMode::blend; }},
        {RuleId::normal_map_length, "warning normal-map-length",
         [](Scene& s) {
             paint(s, kNormalImage, {128, 128, 200, 255});
         }},
        {RuleId::normal_map_inward, "error normal-map-inward",
         [](Scene& s) { s.images[kNormalImage].rgba[4 * 17 + 2] = 40; }},
        {RuleId::mesh_degenerate, "warning mesh-degenerate",
         [](Scene& s) {
             s.meshes[0].indices.insert(s.meshes[0].indices.end(), {0u, 1u, 1u});
         }},
        {RuleId::mesh_unused_vertices, "warning mesh-unused-vertices",
         [](Scene& s) {
             Mesh& mesh = s.meshes[0];
             mesh.positions.push_back(mesh.positions[0]);
             mesh.normals.push_back(mesh.normals[0]);
             mesh.tangents.push_back(mesh.tangents[0]);
             mesh.uv.push_back(mesh.uv[0]);
         }},
        {RuleId::mesh_normals, "warning mesh-normals", [](Scene& s) { s.meshes[0].normals[0] *= 1.1f; }},
    };
    return kPlanted;
}

TEST(Rules, stand_in_order_and_say_what_who_and_what_to_do) {
    ASSERT_EQ(rules().size(), static_cast<std::size_t>(kRuleCount));
    std::set<std::string> names;
    for (const Rule& each : rules()) {
        EXPECT_EQ(&rule(each.id), &each);
        EXPECT_TRUE(names.insert(each.name).second) << each.name;
        for (const char* words : {each.sentence, each.source, each.remedy}) {
            EXPECT_FALSE(std::string(words).empty()) << each.name;
        }
        EXPECT_EQ(std::string(each.sentence).back(), '.') << each.name;
    }
}

TEST(Rules, a_clean_scene_breaks_none) { EXPECT_EQ(findings_of(check_of(clean_scene())), ""); }

TEST(Rules, each_finds_its_planted_fault_and_nothing_else) {
    std::set<RuleId> seen;
    for (const Planted& each : planted()) {
        Scene scene = clean_scene();
        each.plant(scene);
        EXPECT_EQ(findings_of(check_of(scene)), each.expected) << rule(each.rule).name;
        seen.insert(each.rule);
    }
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(kRuleCount));
}

TEST(Rules, a_zero_normal_is_an_error_and_a_texture_too_large_for_the_device_is_one) {
    Scene scene = clean_scene();
    scene.meshes[0].normals[0] = glm::vec3(0.0f);
    EXPECT_EQ(findings_of(check_of(scene)), "error mesh-normals");
    const Request small{.file = {}, .thresholds = thresholds(), .device = "small", .largest_texture = 32};
    EXPECT_EQ(findings_of(check_scene(clean_scene(), small)),
              "error texture-size; error texture-size; error texture-size");
}

TEST(Rules, alpha_that_an_opaque_material_does_not_use_is_a_note) {
    Scene scene = clean_scene();
    paint(scene, kBaseImage, {128, 128, 128, 100});
    EXPECT_EQ(findings_of(check_of(scene)), "note alpha-unused");
    // Cut out and blended it is used.
    scene.materials[0].alpha_mode = AlphaMode::blend;
    EXPECT_EQ(findings_of(check_of(scene)), "");
}

TEST(Rules, what_shines_may_be_black_and_what_is_unlit_is_not_judged) {
    Scene scene = clean_scene();
    paint(scene, kBaseImage, {0, 0, 0, 255});
    EXPECT_EQ(findings_of(check_of(scene)), "error albedo-dark");
    scene.materials[0].emissive = glm::vec3(1.0f);
    EXPECT_EQ(findings_of(check_of(scene)), "");
    scene.materials[0].emissive = glm::vec3(0.0f);
    scene.materials[0].model = MaterialModel::unlit;
    EXPECT_EQ(findings_of(check_of(scene)), "");
}

TEST(Shares, decide_between_nothing_a_warning_and_an_error) {
    const Thresholds limits = thresholds();
    for (const auto& [rows, expected] : std::vector<std::pair<int, std::string>>{
             {0, ""}, {3, ""}, {4, "warning albedo-dark"}, {31, "warning albedo-dark"}, {32, "error albedo-dark"}}) {
        Scene scene = clean_scene();  // 64 rows: 3 are 4.7 %, 4 are 6.3 %, 31 are 48 %, 32 are 50 %
        for (int texel = 0; texel < rows * 64; ++texel) {
            for (int channel = 0; channel < 3; ++channel) {
                scene.images[kBaseImage].rgba[static_cast<std::size_t>(4 * texel + channel)] = 10;
            }
        }
        const Report report = check_of(scene);
        EXPECT_EQ(findings_of(report), expected) << rows << " rows";
        EXPECT_NEAR(report.materials.at(0).broken[0], rows / 64.0, 1e-12);
    }
    EXPECT_EQ(limits.warning_share, 0.05);
}

TEST(Figures, are_the_percentiles_of_what_was_painted) {
    Scene scene = clean_scene();
    for (int texel = 0; texel < 64 * 64; ++texel) {  // 1 in 10 is 60, the rest but 1 in 10 is 100, the last 200
        const int code = texel % 10 == 0 ? 60 : texel % 10 == 9 ? 200 : 100;
        for (int channel = 0; channel < 3; ++channel) {
            scene.images[kBaseImage].rgba[static_cast<std::size_t>(4 * texel + channel)] =
                static_cast<std::uint8_t>(code);
        }
    }
    const Report report = check_of(scene);
    const MaterialFigures& figures = report.materials.at(0);
    EXPECT_EQ(figures.texels, 64u * 64u);
    // 0.06: half a bin of a tenth of a code, and rounding
    EXPECT_NEAR(figures.albedo.p5, 60.0, 0.06);
    EXPECT_NEAR(figures.albedo.p50, 100.0, 0.06);
    EXPECT_NEAR(figures.albedo.p95, 200.0, 0.06);
    // ior 1.5 reflects 4 %, code 56.
    EXPECT_NEAR(figures.specular.p50, 56.3, 0.1);
    // Roughness 0.4: power 2 / 0.0256 - 2 = 76.1, smoothness (log2(76.1) - 1) / 10.
    EXPECT_NEAR(figures.smoothness.p50, 0.525, 1e-3);
    EXPECT_EQ(figures.metallic.p95, 0.0);
}

TEST(Texels, that_no_triangle_reaches_do_not_count) {
    Scene scene = clean_scene();
    // The left half of the picture is black, and the square is mapped to the right quarter of it.
    for (std::size_t texel = 0; texel < 64 * 64; ++texel) {
        if (texel % 64 < 32)
            std::fill_n(scene.images[kBaseImage].rgba.begin() + static_cast<std::ptrdiff_t>(4 * texel), 3,
                        std::uint8_t{0});
    }
    EXPECT_EQ(findings_of(check_of(scene)), "error albedo-dark");
    for (glm::vec2& uv : scene.meshes[0].uv) uv.x = 0.75f + 0.25f * uv.x;
    const Report report = check_of(scene);
    EXPECT_EQ(findings_of(report), "");
    EXPECT_EQ(report.materials.at(0).texels, 16u * 64u);
    // A triangle whose corners share one texel, as palettes are used, reaches that one.
    Scene point = clean_scene();
    for (glm::vec2& uv : point.meshes[0].uv) uv = glm::vec2(0.5f, 1.0f);
    EXPECT_EQ(check_of(point).materials.at(0).texels, 1u);
    // Coordinates that repeat reach everything.
    for (glm::vec2& uv : scene.meshes[0].uv) uv *= 3.0f;
    EXPECT_EQ(check_of(scene).materials.at(0).texels, 64u * 64u);
}

TEST(Texels, are_mapped_as_the_transform_extension_says) {
    // KHR_texture_transform's own matrix: translation * rotation * scale with (cos, sin; -sin, cos).
    const UvMapping mapping{.offset = {0.1f, 0.2f}, .scale = {2.0f, 3.0f}, .rotation_rad = 0.5f};
    const glm::vec2 uv = mapped({0.3f, 0.7f}, mapping);
    EXPECT_NEAR(uv.x, std::cos(0.5) * 0.6 + std::sin(0.5) * 2.1 + 0.1, 1e-6);
    EXPECT_NEAR(uv.y, -std::sin(0.5) * 0.6 + std::cos(0.5) * 2.1 + 0.2, 1e-6);
}

TEST(Charts, keep_every_rule_but_the_ends_of_smoothness) {
    const Report report = check_of(content::open_scene("charts"));
    EXPECT_GE(report.materials.size(), 40u);
    for (const Finding& finding : report.findings) {
        const bool expected = finding.rule == RuleId::smoothness_ends || finding.rule == RuleId::mesh_degenerate;
        EXPECT_TRUE(expected) << rule(finding.rule).name << " " << finding.thing << " " << finding.words;
    }
    EXPECT_EQ(report.count(Level::error), 0u);
}

TEST(Street, has_no_errors_and_no_warnings) {
    const Report report = check_of(content::open_scene("street"));
    EXPECT_GE(report.materials.size(), 40u);
    for (const Finding& finding : report.findings)
        EXPECT_EQ(finding.level, Level::note) << rule(finding.rule).name << " " << finding.thing << " " << finding.words;
}

}  // namespace
}  // namespace halfframe::check
