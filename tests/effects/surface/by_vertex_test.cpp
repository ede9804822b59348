// The low tier's light by vertex: which surfaces it is for, from where on, and how far it is from light by fragment.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "content/content.h"
#include "content/shapes.h"
#include "engine/effects/surface/surface_by_vertex.h"
#include "engine/effects/surface/surface_model_reference.h"
#include "engine/effects/surface/surface_reference.h"
#include "engine/frame/cube_face.h"
#include "perf/measure/planted_effect.h"
#include "tests/effects/lit_square.h"

namespace halfframe::tests {
namespace {

Mesh with_normals(Primitive primitive, std::vector<glm::vec3> positions, std::vector<glm::vec3> normals) {
    Mesh mesh;
    mesh.primitive = primitive;
    mesh.positions = std::move(positions);
    mesh.normals = std::move(normals);
    return mesh;
}

/// Unit, `degrees` from +z.
glm::vec3 leaning(double degrees) {
    const double angle = degrees * std::acos(-1.0) / 180.0;
    return {static_cast<float>(std::sin(angle)), 0.0f, static_cast<float>(std::cos(angle))};
}

TEST(TurnsGently, SpheresOfFineSegmentsAndNotOfCoarseOnes) {
    EXPECT_TRUE(turns_gently(content::sphere(1.0f)));
    EXPECT_TRUE(turns_gently(content::sphere(5.0f, 24, 12)));
    EXPECT_FALSE(turns_gently(content::sphere(1.0f, 8, 4)));
}

TEST(TurnsGently, ADegreeMoreOrLessThanThirty) {
    const std::vector<glm::vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    for (const Primitive primitive : {Primitive::triangles, Primitive::triangle_strip, Primitive::triangle_fan}) {
        for (std::size_t which = 0; which < 3; ++which) {
            std::vector<glm::vec3> normals(3, leaning(0.0));
            normals[which] = leaning(29.0);
            EXPECT_TRUE(turns_gently(with_normals(primitive, corners, normals))) << which;
            normals[which] = leaning(31.0);
            EXPECT_FALSE(turns_gently(with_normals(primitive, corners, normals))) << which;
        }
    }
}

TEST(TurnsGently, ATwentiethOfTheAreaMayBeSteep) {
    // A flat square of side 1, and beside it a steep fillet of `width`.
    for (const auto& [width, gentle] : {std::pair{0.05f, true}, std::pair{0.06f, false}}) {
        Mesh mesh = with_normals(Primitive::triangles,
                                 {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {1 + width, 0, 0}, {1 + width, 1, 0}},
                                 {leaning(0), leaning(0), leaning(0), leaning(0), leaning(60), leaning(60)});
        mesh.indices = {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2};
        EXPECT_EQ(turns_gently(mesh), gentle) << width;
    }
}

TEST(TurnsGently, NothingWithoutTrianglesOrNormals) {
    Mesh mesh = content::sphere(1.0f);
    for (const Primitive primitive : {Primitive::points, Primitive::lines, Primitive::line_loop}) {
        mesh.primitive = primitive;
        EXPECT_FALSE(turns_gently(mesh));
    }
    mesh.primitive = Primitive::triangles;
    mesh.normals.clear();
    EXPECT_FALSE(turns_gently(mesh));
}

FramePlan plan_with(std::vector<gl::Insertion> insertions) {
    FramePlan plan;
    plan.effects.push_back({.effect = "other", .in = true, .why = "here", .insertions = std::move(insertions)});
    return plan;
}

TEST(VerticesCarry, WhatIsBehindTheLightOrServesThemToo) {
    const gl::Insertion color{"surface.color", nullptr, ""}, material{"surface.material", nullptr, ""};
    const gl::Insertion sun{"surface.sun", nullptr, ""}, vertex{"surface.vertex", nullptr, ""};
    const gl::Insertion water{"surface.water", nullptr, "", "WATER"}, served{"surface.vertex_light", nullptr, ""};
    const gl::Insertion mirrored{"surface.mirrored", nullptr, ""}, elsewhere{"bloom.color", nullptr, ""};
    const std::vector<std::string_view> none, wet{"WATER"}, smooth{"CONSTANT_SMOOTHNESS"};
    EXPECT_TRUE(vertices_carry_insertions(plan_with({}), none));
    EXPECT_TRUE(vertices_carry_insertions(plan_with({color, elsewhere}), none));
    EXPECT_FALSE(vertices_carry_insertions(plan_with({color, material}), none));
    EXPECT_FALSE(vertices_carry_insertions(plan_with({vertex, sun}), none));
    EXPECT_TRUE(vertices_carry_insertions(plan_with({water}), none)) << "only in programs with WATER";
    EXPECT_FALSE(vertices_carry_insertions(plan_with({water}), wet));
    EXPECT_TRUE(vertices_carry_insertions(plan_with({vertex, served, mirrored}), smooth));
    EXPECT_FALSE(vertices_carry_insertions(plan_with({vertex, served, mirrored}), none)) << "needs a level by pixel";
    const std::vector<std::string_view> rough{"CONSTANT_SMOOTHNESS", "MIRROR_BY_VERTEX"};
    const gl::Insertion vertex_mirrored{"surface.vertex_mirrored", nullptr, ""};
    EXPECT_FALSE(vertices_carry_insertions(plan_with({vertex, served, mirrored}), rough));
    EXPECT_TRUE(vertices_carry_insertions(plan_with({vertex, served, mirrored, vertex_mirrored}), rough));
}

TEST(VertexLit, IsTheMaterialOfTheFragmentStage) {
    for (const float metallic : {0.0f, 0.3f, 1.0f}) {
        for (const float roughness : {0.0f, 0.4f, 1.0f}) {
            Material material;
            material.base_color = {0.9f, 0.5f, 0.1f, 1.0f};
            material.metallic = metallic;
            material.roughness = roughness;
            const VertexLitMaterial lit = vertex_lit(material);
            const double power = reference::power_from_roughness(roughness);
            EXPECT_NEAR(lit.specular.w, power, 1e-3 * power);
            EXPECT_NEAR(lit.albedo.w, reference::smoothness_from_power(power), 1e-4);
            for (int i = 0; i < 3; ++i) {
                const double base = material.base_color[i];
                EXPECT_NEAR(lit.albedo[i], reference::mapped_albedo(base, metallic), 1e-6);
                EXPECT_NEAR(lit.specular[i] + lit.metal[i], reference::mapped_specular(base, metallic), 4e-5)
                    << "0.0437 is 0.043735, rounded";
            }
        }
    }
    Material glossy{.model = MaterialModel::specular_glossiness};
    glossy.base_color = glm::vec4(0.8f, 0.6f, 0.4f, 1.0f);
    glossy.specular = {0.5f, 0.25f, 0.0f};
    glossy.smoothness = 0.7f;
    const VertexLitMaterial lit = vertex_lit(glossy);
    EXPECT_NEAR(lit.albedo.r, 0.4f, 1e-6f);
    EXPECT_NEAR(lit.albedo.b, 0.2f, 1e-6f);
    EXPECT_EQ(glm::vec3(lit.specular), glossy.specular);
    EXPECT_EQ(glm::vec3(lit.metal), glm::vec3(0.0f));
    EXPECT_NEAR(lit.specular.w, reference::power_from_roughness(0.3), 1.0);
}

// Changes nothing, and at a point that no vertex serves: what it is added to is lit by fragment.
constexpr gl::Insertion kUnchanged[] = {{"surface.material", nullptr, "albedo = albedo;"}};
const EffectCard kByFragment =
    perf::planted_effect([](const PlanContext&) { return std::span<const gl::Insertion>(kUnchanged); });

constexpr int kSide = 160;

/// Light of three wide lamps of different colours, as a lobe as wide as that of roughness 1 sees it.
glm::vec3 wide_light(const glm::vec3& toward) {
    constexpr std::array<std::array<glm::vec3, 2>, 3> kLamps{{{{{0.80f, 0.36f, 0.48f}, {0.5f, 0.3f, 0.1f}}},
                                                              {{{-0.48f, 0.60f, 0.64f}, {0.1f, 0.2f, 0.4f}}},
                                                              {{{0.36f, -0.48f, 0.80f}, {0.2f, 0.3f, 0.1f}}}}};
    glm::vec3 sum(0.2f);
    for (const auto& [lamp, color] : kLamps)
        sum += color * std::pow(std::max(glm::dot(glm::normalize(toward), lamp), 0.0f), 1.4f);
    return sum;
}

/// A lit ball of radius 1 with vertex colours, a sun, a lamp, and a sky of three lamps.
Scene ball(float metallic, float roughness) {
    Scene scene;
    scene.name = "ball";
    scene.meshes.push_back(content::sphere(1.0f));
    for (const glm::vec3& at : scene.meshes[0].positions)
        scene.meshes[0].colors.emplace_back(0.75f + 0.25f * at.x, 0.75f + 0.25f * at.y, 0.8f, 1.0f);
    Material material;
    material.base_color = {0.8f, 0.6f, 0.4f, 1.0f};
    material.metallic = metallic;
    material.roughness = roughness;
    scene.materials = {material};
    scene.surfaces = {Surface{.name = "ball"}};
    scene.ambient = glm::vec3(0.05f);
    Light sun{.kind = LightKind::sun, .name = "sun", .color = glm::vec3(1.5f), .direction = {-0.5f, -0.6f, -0.7f}};
    Light lamp{.kind = LightKind::point, .name = "lamp", .color = glm::vec3(4.0f, 2.0f, 1.0f)};
    lamp.position = {-2.5f, 1.0f, 2.0f};
    lamp.range_m = 20.0f;
    scene.lights = {sun, lamp};
    EnvironmentMap map{.name = "three lamps", .size = 16, .levels = {}, .roughest_level = 2, .powers = {}};
    for (int level = 0; level <= 2; ++level) {
        const int size = 16 >> level;
        std::vector<glm::vec3>& texels = map.levels.emplace_back();
        for (int i = 0; i < 6 * size * size; ++i) {
            const double u = (2.0 * (i % size) + 1.0) / size - 1.0, v = (2.0 * (i / size % size) + 1.0) / size - 1.0;
            texels.push_back(wide_light(glm::vec3(face_direction(i / size / size, u, v))));
        }
    }
    map.irradiance[0] = glm::vec3(0.3f);
    map.irradiance[3] = glm::vec3(0.2f);
    scene.environment = map;
    return scene;
}

/// The ball fills the picture, seen from `distance_m`.
View ball_view(float distance_m) {
    Camera camera;
    camera.world_from_view[3] = {0.0f, 0.0f, distance_m, 1.0f};
    camera.fov_y_rad = 2.0f * std::asin(1.05f / distance_m);
    camera.near_m = distance_m - 1.5f;
    camera.far_m = distance_m + 1.5f;
    return view_of(camera, kSide, kSide);
}

const float kDiagonal_m = std::sqrt(12.0f);

class LitByVertex : public harness::GlFixture {
protected:
    struct Drawn {
        Picture picture;
        bool has_program = false;  ///< that lights vertices
        bool mirrors = false;      ///< there too
    };
    Drawn draw(const Scene& scene, const View& view, bool by_fragment, Tier tier = Tier::low,
               Arithmetic arithmetic = Arithmetic::full) {
        std::vector<const EffectCard*> cards(all_effects().begin(), all_effects().end());
        if (by_fragment) cards.push_back(&kByFragment);
        const Wishes wishes{.tier = tier, .arithmetic = arithmetic};
        Renderer renderer(gl(), caps(), {.program_cache_folder = {}, .effects = cards});
        renderer.prepare(scene, plan_frame(scene, view, wishes, caps(), cards));
        renderer.draw(view);
        EXPECT_EQ(renderer.first_gl_error(), "");
        const auto has = [uses = renderer.program_uses()](std::string_view define) {
            return std::ranges::any_of(
                uses, [&](const ProgramUse& use) { return use.defines.find(define) != std::string::npos; });
        };
        return {renderer.read_display(), has("LIT_BY_VERTEX"), has("MIRROR_BY_VERTEX")};
    }
    struct Distance {
        double mean = 0.0;  ///< [codes] over the pixels of the ball
        int worst = 0;
    };
    static Distance between(const Picture& a, const Picture& b) {
        Distance distance;
        double sum = 0.0;
        std::size_t count = 0;
        for (std::size_t i = 0; i < a.rgba.size(); ++i) {
            const int codes = std::abs(int(a.rgba[i]) - int(b.rgba[i]));
            distance.worst = std::max(distance.worst, codes);
            sum += codes;
            count += a.rgba[i] != 0 ? 1 : 0;
        }
        distance.mean = sum / static_cast<double>(std::max<std::size_t>(count, 1));
        return distance;
    }
};

TEST_F(LitByVertex, FromTwoDiagonalsOnAndNotNearer) {
    const Scene scene = ball(0.0f, 0.4f);
    const View near_by = ball_view(1.95f * kDiagonal_m), far = ball_view(2.05f * kDiagonal_m);
    EXPECT_EQ(draw(scene, near_by, false).picture.rgba, draw(scene, near_by, true).picture.rgba);
    EXPECT_NE(draw(scene, far, false).picture.rgba, draw(scene, far, true).picture.rgba);
}

TEST_F(LitByVertex, IsNearWhatFragmentsMakeOfIt) {
    const View view = ball_view(3.0f * kDiagonal_m);
    for (const Arithmetic arithmetic : {Arithmetic::full, Arithmetic::half}) {
        for (const float metallic : {0.0f, 1.0f}) {
            for (const float roughness : {0.2f, 0.35f, 0.6f, 1.0f}) {
                const Scene scene = ball(metallic, roughness);
                const Drawn by_vertex = draw(scene, view, false, Tier::low, arithmetic);
                const Drawn by_fragment = draw(scene, view, true, Tier::low, arithmetic);
                EXPECT_TRUE(by_vertex.has_program);
                EXPECT_FALSE(by_fragment.has_program);
                const Distance distance = between(by_vertex.picture, by_fragment.picture);
                const std::string words = std::string(name(arithmetic)) + " " + std::to_string(metallic) + " " +
                                          std::to_string(roughness) + ": mean " + std::to_string(distance.mean) +
                                          ", worst " + std::to_string(distance.worst);
                // 1.43 was seen: the wide lobe of rough metal, which is round here where Blinn's is not.
                EXPECT_LT(distance.mean, 1.8) << words;
                // 54 was seen: the rim of a small highlight.
                EXPECT_LT(distance.worst, 75) << words;
            }
        }
    }
}

TEST_F(LitByVertex, RoughOnesMirrorByVertexTooAndNearlyTheSame) {
    EXPECT_TRUE(mirrors_by_vertex({.metallic = 0.0f, .roughness = 0.76f}));
    EXPECT_FALSE(mirrors_by_vertex({.metallic = 0.0f, .roughness = 0.74f}));
    EXPECT_TRUE(mirrors_by_vertex({.metallic = 1.0f, .roughness = 1.0f}));
    const View view = ball_view(3.0f * kDiagonal_m);
    for (const float roughness : {0.74f, 0.76f, 1.0f}) {
        Scene scene = ball(0.0f, roughness);
        scene.lights.clear();
        scene.ambient = glm::vec3(0.0f);
        const Drawn by_vertex = draw(scene, view, false);
        EXPECT_EQ(by_vertex.mirrors, roughness > 0.75f);
        const Distance distance = between(by_vertex.picture, draw(scene, view, true).picture);
        EXPECT_LT(distance.mean, 0.8) << roughness;
        EXPECT_LT(distance.worst, 12) << roughness;
        scene.environment.reset();  // and nothing where there is nothing to mirror
        const Picture alone = draw(scene, view, false).picture;
        EXPECT_EQ(alone.rgba[4 * (kSide / 2 * kSide + kSide / 2)], 0);
    }
}

TEST_F(LitByVertex, TheDarkSideOfARoughMetalStaysAsDarkAsItIs) {
    const View view = ball_view(3.0f * kDiagonal_m);
    Scene scene = ball(1.0f, 1.0f);
    scene.lights.clear();
    scene.ambient = glm::vec3(0.0f);
    scene.environment = content::environment("studio", {.size = 32}).map;  // soft boxes far brighter than the floor
    const Drawn by_vertex = draw(scene, view, false);
    EXPECT_TRUE(by_vertex.mirrors);
    const Picture by_fragment = draw(scene, view, true).picture;
    int least_by_vertex = 255, least_by_fragment = 255;
    for (std::size_t i = 1; i < by_fragment.rgba.size(); i += 4) {
        if (by_fragment.rgba[i] == 0) continue;  // beside the ball
        least_by_vertex = std::min(least_by_vertex, int(by_vertex.picture.rgba[i]));
        least_by_fragment = std::min(least_by_fragment, int(by_fragment.rgba[i]));
    }
    EXPECT_GT(least_by_fragment, 10);
    EXPECT_NEAR(least_by_vertex, least_by_fragment, 6);  // 18 and 15; 0 where rings of the light itself go down to black
    EXPECT_LT(between(by_vertex.picture, by_fragment).mean, 3.0);
}

TEST_F(LitByVertex, AMaterialOfTheSameCubeTakesNoReflectionAway) {
    const View view = ball_view(3.0f * kDiagonal_m);
    const Scene alone = ball(0.0f, 0.751f);
    Scene both = alone;
    Material smoother = alone.materials[0];
    smoother.roughness = 0.749f;  // mirrors by fragment, from the same cube
    both.materials.push_back(smoother);
    Surface behind{.name = "smoother", .mesh = 0, .material = 1};
    behind.world_from_local[3] = {0.0f, 0.0f, -100.0f, 1.0f};  // behind the far plane
    both.surfaces.insert(both.surfaces.begin(), behind);
    EXPECT_EQ(draw(both, view, false).picture.rgba, draw(alone, view, false).picture.rgba);
}

TEST_F(LitByVertex, ARoughMaterialThatBecomesSmoothIsLitByFragment) {
    const View view = ball_view(3.0f * kDiagonal_m);
    Scene scene = ball(0.0f, 1.0f), smooth = ball(0.0f, 0.2f);
    Renderer renderer(gl(), caps(), {.program_cache_folder = {}, .effects = all_effects()});
    renderer.prepare(scene, plan_frame(scene, view, {.tier = Tier::low}, caps(), all_effects()));
    scene.materials[0].roughness = 0.2f;
    renderer.draw(view);
    const Picture changed = renderer.read_display();
    EXPECT_LT(between(changed, draw(smooth, view, true).picture).mean, 1.0) << "its cube alone stays that of roughness 1";
}

TEST_F(LitByVertex, IsOfTheLowTierAndOfPlainMaterials) {
    const View view = ball_view(3.0f * kDiagonal_m);
    const auto has = [&](const Scene& scene, Tier tier = Tier::low) { return draw(scene, view, false, tier).has_program; };
    const Scene plain = ball(0.0f, 0.5f);
    EXPECT_TRUE(has(plain));
    EXPECT_FALSE(has(plain, Tier::console));
    EXPECT_FALSE(has(plain, Tier::reference));
    Scene other = plain;
    other.materials[0].double_sided = true;
    EXPECT_FALSE(has(other));
    other = plain;
    other.materials[0].alpha_mode = AlphaMode::mask;
    EXPECT_FALSE(has(other));
    other = plain;
    other.materials[0].alpha_mode = AlphaMode::blend;
    EXPECT_FALSE(has(other));
    other = plain;
    other.images.push_back({.name = "ones", .width = 1, .height = 1, .srgb = true, .rgba = {255, 255, 255, 255}});
    other.materials[0].base_color_texture.image = 0;
    EXPECT_FALSE(has(other));
    other = plain;
    other.meshes[0] = content::sphere(1.0f, 8, 4);
    EXPECT_FALSE(has(other));
    other = plain;
    other.materials[0].model = MaterialModel::unlit;
    EXPECT_FALSE(has(other));
}

TEST_F(LitByVertex, NeedsNeitherSunNorLampNorEnvironment) {
    const View view = ball_view(3.0f * kDiagonal_m);
    for (int left_out = 0; left_out < 3; ++left_out) {
        Scene scene = ball(0.5f, 0.5f);
        if (left_out == 0) scene.lights.erase(scene.lights.begin());
        if (left_out == 1) scene.lights.pop_back();
        if (left_out == 2) scene.environment.reset();
        const Drawn by_vertex = draw(scene, view, false);
        EXPECT_TRUE(by_vertex.has_program) << left_out;
        const Distance distance = between(by_vertex.picture, draw(scene, view, true).picture);
        EXPECT_GT(distance.worst, 0) << left_out;
        EXPECT_LT(distance.mean, 1.0) << left_out;
    }
}

TEST_F(LitByVertex, AnOrthographicViewMirrorsOneDirection) {
    View view = ball_view(3.0f * kDiagonal_m);
    Camera camera;
    camera.world_from_view[3] = {0.0f, 0.0f, 3.0f * kDiagonal_m, 1.0f};
    camera.orthographic = true;
    camera.half_height_m = 1.05f;
    view = view_of(camera, kSide, kSide);
    const Scene scene = ball(0.0f, 0.35f);
    const Drawn by_vertex = draw(scene, view, false);
    EXPECT_TRUE(by_vertex.has_program);
    const Distance distance = between(by_vertex.picture, draw(scene, view, true).picture);
    EXPECT_GT(distance.worst, 0);
    EXPECT_LT(distance.mean, 1.0);
    EXPECT_LT(distance.worst, 60);
}

}  // namespace
}  // namespace halfframe::tests
