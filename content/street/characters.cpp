// Two people who walk: bodies lofted over bones, a skin each, one walk.
#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

#include "content/built_in.h"
#include "content/street/bones.h"
#include "content/street/site.h"

namespace halfframe::content::street {

namespace {

/// One material's share of a body while it is made.
struct Cloth {
    const char* name;
    glm::vec3 albedo;
    glm::vec3 emissive;
    float roughness;
    Mesh mesh;
};

/// A ring of a loft: where, how wide and deep, and how the two bones share it.
struct Ring {
    glm::vec3 centre;
    float half_width;
    float half_depth;
    Bone bone;
    Bone other;
    float of_other = 0.0f;  ///< 0..1
};

constexpr int kAround = 12;

glm::vec3 ring_point(const Ring& ring, int i) {
    const double angle = glm::two_pi<double>() * (i % kAround) / kAround;
    return ring.centre + glm::vec3(ring.half_width * static_cast<float>(std::sin(angle)), 0.0f,
                                   ring.half_depth * static_cast<float>(std::cos(angle)));
}

void add_vertex(Mesh& mesh, const Ring& ring, const glm::vec3& position, const glm::vec3& normal,
                const glm::vec3& tangent, const glm::vec2& uv) {
    mesh.positions.push_back(position);
    mesh.normals.push_back(normal);
    mesh.tangents.emplace_back(glm::normalize(tangent - normal * glm::dot(normal, tangent)), 1.0f);
    mesh.uv.push_back(uv);
    mesh.joints.emplace_back(static_cast<int>(ring.bone), static_cast<int>(ring.other), 0, 0);
    mesh.weights.emplace_back(1.0f - ring.of_other, ring.of_other, 0.0f, 0.0f);
}

/// A closed skin over rings from the top down.
void loft(Mesh& mesh, std::span<const Ring> rings) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (std::size_t row = 0; row < rings.size(); ++row) {
        const Ring& above = rings[row == 0 ? 0 : row - 1];
        const Ring& below = rings[std::min(row + 1, rings.size() - 1)];
        for (int i = 0; i <= kAround; ++i) {
            const glm::vec3 around = ring_point(rings[row], i + 1) - ring_point(rings[row], i + kAround - 1);
            const glm::vec3 up = ring_point(above, i) - ring_point(below, i);
            add_vertex(mesh, rings[row], ring_point(rings[row], i), glm::normalize(glm::cross(around, up)), around,
                       {static_cast<float>(i) / kAround, static_cast<float>(row)});
        }
    }
    for (std::uint32_t row = 0; row + 1 < rings.size(); ++row) {
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const std::uint32_t above = first + row * (kAround + 1) + i;
            const std::uint32_t below = above + kAround + 1;
            for (const std::uint32_t index : {below, below + 1, above + 1, below, above + 1, above})
                mesh.indices.push_back(index);
        }
    }
    for (const bool top : {true, false}) {
        const Ring& ring = top ? rings.front() : rings.back();
        const glm::vec3 normal(0.0f, top ? 1.0f : -1.0f, 0.0f);
        const auto middle = static_cast<std::uint32_t>(mesh.positions.size());
        add_vertex(mesh, ring, ring.centre, normal, {1.0f, 0.0f, 0.0f}, glm::vec2(0.5f));
        for (int i = 0; i < kAround; ++i)
            add_vertex(mesh, ring, ring_point(ring, i), normal, {1.0f, 0.0f, 0.0f}, glm::vec2(0.5f));
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const std::uint32_t here = middle + 1 + i;
            const std::uint32_t next = middle + 1 + (i + 1) % kAround;
            mesh.indices.push_back(middle);
            mesh.indices.push_back(top ? here : next);
            mesh.indices.push_back(top ? next : here);
        }
    }
}

void add_limbs(Mesh& trousers, Mesh& coat, Mesh& skin, Mesh& boots) {
    for (const bool left : {true, false}) {
        const float side = left ? 1.0f : -1.0f;
        const Bone thigh = left ? Bone::left_thigh : Bone::right_thigh;
        const Bone shin = left ? Bone::left_shin : Bone::right_shin;
        const Bone foot = left ? Bone::left_foot : Bone::right_foot;
        const float x = side * 0.095f;
        const std::array<Ring, 8> leg{{{{x, 0.96f, 0.0f}, 0.085f, 0.095f, thigh, Bone::hips, 0.5f},
                                       {{x, 0.84f, 0.0f}, 0.085f, 0.092f, thigh, Bone::hips, 0.1f},
                                       {{x, 0.66f, 0.005f}, 0.070f, 0.078f, thigh, shin, 0.0f},
                                       {{x, 0.53f, 0.008f}, 0.058f, 0.064f, thigh, shin, 0.35f},
                                       {{x, 0.46f, 0.004f}, 0.056f, 0.062f, thigh, shin, 0.75f},
                                       {{x, 0.34f, -0.012f}, 0.054f, 0.062f, shin, foot, 0.0f},
                                       {{x, 0.18f, -0.008f}, 0.044f, 0.050f, shin, foot, 0.0f},
                                       {{x, 0.10f, 0.0f}, 0.042f, 0.048f, shin, foot, 0.3f}}};
        loft(trousers, leg);
        const std::array<Ring, 5> boot{{{{x, 0.24f, -0.006f}, 0.056f, 0.060f, shin, foot, 0.0f},
                                        {{x, 0.155f, 0.0f}, 0.054f, 0.060f, shin, foot, 0.3f},
                                        {{x, 0.085f, 0.035f}, 0.050f, 0.100f, foot, shin, 0.0f},
                                        {{x, 0.045f, 0.055f}, 0.052f, 0.135f, foot, shin, 0.0f},
                                        {{x, 0.004f, 0.055f}, 0.050f, 0.138f, foot, shin, 0.0f}}};
        loft(boots, boot);
        const Bone upper = left ? Bone::left_upper_arm : Bone::right_upper_arm;
        const Bone fore = left ? Bone::left_forearm : Bone::right_forearm;
        const Bone hand = left ? Bone::left_hand : Bone::right_hand;
        const float ax = side * 0.205f;
        const std::array<Ring, 7> arm{{{{side * 0.165f, 1.455f, -0.01f}, 0.055f, 0.060f, upper, Bone::chest, 0.6f},
                                       {{ax, 1.40f, -0.01f}, 0.062f, 0.068f, upper, Bone::chest, 0.25f},
                                       {{ax + side * 0.01f, 1.28f, -0.01f}, 0.052f, 0.058f, upper, fore, 0.0f},
                                       {{ax + side * 0.015f, 1.16f, -0.01f}, 0.046f, 0.052f, upper, fore, 0.35f},
                                       {{ax + side * 0.018f, 1.10f, -0.005f}, 0.046f, 0.052f, upper, fore, 0.75f},
                                       {{ax + side * 0.022f, 0.98f, 0.0f}, 0.043f, 0.046f, fore, hand, 0.0f},
                                       {{ax + side * 0.025f, 0.87f, 0.005f}, 0.040f, 0.043f, fore, hand, 0.2f}}};
        loft(coat, arm);
        const std::array<Ring, 4> palm{{{{ax + side * 0.025f, 0.875f, 0.005f}, 0.026f, 0.030f, fore, hand, 0.5f},
                                        {{ax + side * 0.024f, 0.81f, 0.008f}, 0.024f, 0.042f, hand, fore, 0.0f},
                                        {{ax + side * 0.022f, 0.74f, 0.014f}, 0.020f, 0.038f, hand, fore, 0.0f},
                                        {{ax + side * 0.020f, 0.68f, 0.020f}, 0.014f, 0.022f, hand, fore, 0.0f}}};
        loft(skin, palm);
    }
}

void add_trunk(Mesh& coat, Mesh& skin, Mesh& hair, bool hood, float hem_m) {
    const std::array<Ring, 8> body{{{{0.0f, 1.51f, -0.01f}, 0.075f, 0.070f, Bone::chest, Bone::neck, 0.4f},
                                    {{0.0f, 1.47f, -0.01f}, 0.150f, 0.095f, Bone::chest, Bone::neck, 0.0f},
                                    {{0.0f, 1.38f, 0.0f}, 0.185f, 0.125f, Bone::chest, Bone::spine, 0.0f},
                                    {{0.0f, 1.25f, 0.005f}, 0.168f, 0.125f, Bone::chest, Bone::spine, 0.3f},
                                    {{0.0f, 1.10f, 0.0f}, 0.148f, 0.108f, Bone::spine, Bone::hips, 0.2f},
                                    {{0.0f, 1.00f, 0.0f}, 0.165f, 0.118f, Bone::hips, Bone::spine, 0.2f},
                                    {{0.0f, 0.90f, 0.0f}, 0.188f, 0.135f, Bone::hips, Bone::spine, 0.0f},
                                    {{0.0f, 0.84f, 0.0f}, 0.192f, 0.140f, Bone::hips, Bone::spine, 0.0f}}};
    loft(coat, body);
    // Skirts of the coat: front and back halves would part; one bell that follows the hips, a little the thighs.
    const std::array<Ring, 3> skirt{
        {{{0.0f, 0.86f, 0.0f}, 0.192f, 0.141f, Bone::hips, Bone::hips, 0.0f},
         {{0.0f, 0.5f * (0.86f + hem_m), -0.01f}, 0.215f, 0.185f, Bone::hips, Bone::hips, 0.0f},
         {{0.0f, hem_m, -0.02f}, 0.240f, 0.235f, Bone::hips, Bone::hips, 0.0f}}};
    loft(coat, skirt);
    const std::array<Ring, 7> head{{{{0.0f, 1.745f, 0.0f}, 0.020f, 0.024f, Bone::head, Bone::neck, 0.0f},
                                    {{0.0f, 1.725f, 0.0f}, 0.058f, 0.072f, Bone::head, Bone::neck, 0.0f},
                                    {{0.0f, 1.67f, 0.005f}, 0.076f, 0.095f, Bone::head, Bone::neck, 0.0f},
                                    {{0.0f, 1.61f, 0.012f}, 0.074f, 0.094f, Bone::head, Bone::neck, 0.0f},
                                    {{0.0f, 1.56f, 0.020f}, 0.060f, 0.078f, Bone::head, Bone::neck, 0.0f},
                                    {{0.0f, 1.535f, 0.010f}, 0.046f, 0.052f, Bone::neck, Bone::head, 0.5f},
                                    {{0.0f, 1.47f, -0.01f}, 0.054f, 0.056f, Bone::neck, Bone::chest, 0.4f}}};
    loft(skin, head);
    const float low = hood ? 1.50f : 1.60f;
    const float wide = hood ? 1.22f : 1.10f;
    const std::array<Ring, 5> cap{{{{0.0f, 1.765f, -0.012f}, 0.022f, 0.026f, Bone::head, Bone::neck, 0.0f},
                                   {{0.0f, 1.74f, -0.014f}, 0.062f * wide, 0.078f, Bone::head, Bone::neck, 0.0f},
                                   {{0.0f, 1.68f, -0.024f}, 0.080f * wide, 0.090f, Bone::head, Bone::neck, 0.0f},
                                   {{0.0f, 1.62f, -0.036f}, 0.078f * wide, 0.084f, Bone::head, Bone::neck, 0.0f},
                                   {{0.0f, low, -0.05f},
                                    hood ? 0.105f : 0.055f,
                                    0.058f,
                                    hood ? Bone::neck : Bone::head,
                                    Bone::chest,
                                    hood ? 0.4f : 0.0f}}};
    loft(hair, cap);
}

void add_implant(Mesh& glow) {
    // A line of light behind the ear, and one round the wrist: what everybody in this city wears.
    const std::array<Ring, 2> neck{{{{0.0f, 1.500f, -0.012f}, 0.079f, 0.073f, Bone::neck, Bone::chest, 0.5f},
                                    {{0.0f, 1.488f, -0.012f}, 0.081f, 0.075f, Bone::neck, Bone::chest, 0.5f}}};
    loft(glow, neck);
    const std::array<Ring, 2> wrist{
        {{{0.230f, 0.900f, 0.004f}, 0.043f, 0.046f, Bone::left_forearm, Bone::left_hand, 0.0f},
         {{0.230f, 0.884f, 0.004f}, 0.043f, 0.046f, Bone::left_forearm, Bone::left_hand, 0.0f}}};
    loft(glow, wrist);
}

struct Person {
    const char* name;
    glm::vec3 start;
    float heading_rad;  ///< about y; 0 walks towards +z
    glm::vec3 coat, hair, glow;
    bool hood;
    float hem_m;
    float phase;  ///< 0..1 of a stride, where the walk begins
    float speed_m_s;
};

void add_person(Scene& scene, const Person& person) {
    const Walk walk{person.start, person.heading_rad, person.phase, person.speed_m_s};
    const int first_node = add_bones(scene, person.name, walk);
    scene.animations.push_back(walk_animation(person.name, first_node, walk));
    const int skin = static_cast<int>(scene.skins.size());
    scene.skins.push_back(body_skin(person.name, first_node, walk));
    std::array<Cloth, 6> parts{{{"coat", person.coat, {}, 0.78f, {}},
                                {"trousers", {0.030f, 0.032f, 0.040f}, {}, 0.8f, {}},
                                {"skin", {0.36f, 0.24f, 0.19f}, {}, 0.5f, {}},
                                {"boots", {0.018f, 0.018f, 0.020f}, {}, 0.35f, {}},
                                {"hair", person.hair, {}, 0.6f, {}},
                                {"implant", glm::vec3(0.02f), person.glow, 0.5f, {}}}};
    add_limbs(parts[1].mesh, parts[0].mesh, parts[2].mesh, parts[3].mesh);
    add_trunk(parts[0].mesh, parts[2].mesh, parts[4].mesh, person.hood, person.hem_m);
    add_implant(parts[5].mesh);
    for (Cloth& part : parts) {
        Material material;
        material.name = std::string(person.name) + " " + part.name;
        material.base_color = glm::vec4(part.albedo, 1.0f);
        material.metallic = 0.0f;
        material.roughness = part.roughness;
        material.emissive = part.emissive;
        bake_first_step(part.mesh, walk);
        const std::string name = material.name;
        const int index = content::add_material(scene, std::move(material));
        add_surface(scene, name, add_mesh(scene, std::move(part.mesh), name), index, root_place(walk));
        scene.surfaces.back().dynamic = true;
        scene.surfaces.back().skin = skin;
    }
}

}  // namespace

void add_characters(Site& site) {
    Scene& scene = site.street.scene;
    add_person(scene, {"walker",
                       {-0.75f, road_height_m(-0.75f), -5.4f},
                       glm::pi<float>(),
                       {0.10f, 0.115f, 0.14f},
                       {0.10f, 0.115f, 0.14f},
                       {0.9f, 3.2f, 4.2f},
                       true,
                       0.52f,
                       0.06f,
                       1.25f});
    add_person(scene, {"stroller",
                       {8.55f, kPavement_m, -19.0f},
                       0.0f,
                       {0.21f, 0.05f, 0.05f},
                       {0.16f, 0.045f, 0.03f},
                       {4.2f, 1.8f, 0.8f},
                       false,
                       0.60f,
                       0.30f,
                       1.10f});
}

}  // namespace halfframe::content::street
