// Lamps with their light and their lit air; signs with theirs.
#include <array>
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "content/street/sign_textures.h"
#include "content/street/site.h"

namespace halfframe::content::street {

glm::mat4 facing(const glm::vec3& origin, const glm::vec3& outward) {
    const glm::vec3 up(0.0f, 1.0f, 0.0f);
    return {glm::vec4(glm::cross(up, outward), 0.0f), glm::vec4(up, 0.0f), glm::vec4(outward, 0.0f),
            glm::vec4(origin, 1.0f)};
}

void add_lamp(Site& site, const char* name, const glm::vec3& here, const glm::vec3& color, float range_m,
              float radius_m) {
    Light light;
    light.kind = LightKind::point;
    light.name = name;
    light.position = site.builder.world(here);
    light.color = color;
    light.range_m = range_m;
    light.radius_m = radius_m;
    site.builder.scene().lights.push_back(light);
}

void add_down_light(Site& site, const char* name, const glm::vec3& here, const glm::vec3& color, float range_m,
                    float half_angle_rad) {
    Light light;
    light.kind = LightKind::spot;
    light.name = name;
    light.position = site.builder.world(here);
    light.direction = {0.0f, -1.0f, 0.0f};
    light.color = color;
    light.range_m = range_m;
    light.radius_m = 0.12f;
    light.inner_cone_rad = 0.55f * half_angle_rad;
    light.outer_cone_rad = half_angle_rad;
    site.builder.scene().lights.push_back(light);
}

void add_beam(Site& site, int material, const glm::vec3& top, float height_m, float top_radius_m, float foot_radius_m,
              float strength) {
    constexpr int kSlices = 12;
    const auto at = [&](int i, float radius, float down) {
        const double angle = glm::two_pi<double>() * (i % kSlices) / kSlices;
        return top + glm::vec3(radius * static_cast<float>(std::sin(angle)), -down,
                               radius * static_cast<float>(std::cos(angle)));
    };
    for (int i = 0; i < kSlices; ++i) {
        const glm::vec4 bright(1.0f, 1.0f, 1.0f, strength);
        const glm::vec4 middle(1.0f, 1.0f, 1.0f, 0.30f * strength);
        const glm::vec4 gone(1.0f, 1.0f, 1.0f, 0.0f);
        const float half = 0.5f * (top_radius_m + foot_radius_m);
        site.builder.colored_patch(material,
                                   {at(i, half, 0.5f * height_m), at(i + 1, half, 0.5f * height_m),
                                    at(i + 1, top_radius_m, 0.0f), at(i, top_radius_m, 0.0f)},
                                   {middle, middle, bright, bright});
        site.builder.colored_patch(material,
                                   {at(i, foot_radius_m, height_m), at(i + 1, foot_radius_m, height_m),
                                    at(i + 1, half, 0.5f * height_m), at(i, half, 0.5f * height_m)},
                                   {gone, gone, middle, middle});
    }
}

void add_sign_across(Site& site, int index, const glm::vec3& centre, float width_m) {
    Builder& builder = site.builder;
    const float height = 0.25f * width_m;
    const glm::vec3 right(width_m, 0.0f, 0.0f);
    const glm::vec3 up(0.0f, height, 0.0f);
    const auto [low, high] = across_uv(index);
    const glm::vec3 corner = centre - 0.5f * (right + up);
    builder.box(site.of.iron, corner - glm::vec3(0.04f, 0.04f, 0.06f),
                corner + right + up + glm::vec3(0.04f, 0.04f, -0.006f));
    builder.picture(site.of.signs_across, corner, right, up, low, high);
    site.street.signs.push_back({kSignsAcross[static_cast<std::size_t>(index)].text,
                                 builder.world(centre),
                                 glm::mat3(builder.placed()) * glm::vec3(0.0f, 0.0f, 1.0f),
                                 {width_m, height},
                                 false});
}

void add_sign_down(Site& site, int index, const glm::vec3& foot, float height_m, bool lamp) {
    Builder& builder = site.builder;
    const float width = height_m / 8.0f;
    const float thick = 0.09f;
    const glm::vec3 up(0.0f, height_m, 0.0f);
    const auto [low, high] = down_uv(index);
    const glm::vec3 out(0.0f, 0.0f, width);
    builder.box(site.of.iron, foot + glm::vec3(-thick + 0.01f, -0.06f, -0.05f),
                foot + glm::vec3(thick - 0.01f, height_m + 0.06f, width + 0.05f));
    builder.picture(site.of.signs_down, foot + glm::vec3(thick, 0.0f, width), -out, up, low, high);
    builder.picture(site.of.signs_down, foot + glm::vec3(-thick, 0.0f, 0.0f), out, up, low, high);
    for (const float y : {0.15f, 0.85f}) {
        const glm::vec3 at = foot + glm::vec3(0.0f, y * height_m, 0.0f);
        builder.bar(site.of.iron, at, {at.x, at.y, 0.0f}, 0.03f, 5);
    }
    const SignText& sign = kSignsDown[static_cast<std::size_t>(index)];
    const glm::vec3 centre = foot + 0.5f * up + 0.5f * out;
    site.street.signs.push_back({sign.text,
                                 builder.world(centre),
                                 glm::mat3(builder.placed()) * glm::vec3(1.0f, 0.0f, 0.0f),
                                 {width, height_m},
                                 true});
    if (lamp)
        add_lamp(site, "sign", foot + glm::vec3(0.0f, 0.3f * height_m, width + 0.7f), sign.tint * 2.6f + 0.15f, 6.5f,
                 0.3f);
}

void add_street_lamps(Site& site) {
    Builder& builder = site.builder;
    const Materials& of = site.of;
    const auto lamp = [&](float x, float z, float toward, bool light) {
        builder.place(facing({x, kPavement_m, z}, {0.0f, 0.0f, 1.0f}));
        constexpr std::array<glm::vec2, 6> kFoot{
            {{0.055f, 1.05f}, {0.10f, 0.95f}, {0.10f, 0.30f}, {0.17f, 0.22f}, {0.17f, 0.0f}, {0.0f, 0.0f}}};
        builder.lathe(of.iron, glm::vec3(0.0f), kFoot, 10);
        builder.bar(of.iron, {0.0f, 1.0f, 0.0f}, {0.0f, 4.9f, 0.0f}, 0.055f, 8);
        builder.bar(of.iron, {0.0f, 4.85f, 0.0f}, {0.9f * toward, 5.15f, 0.0f}, 0.04f, 6, true);
        builder.bar(of.iron, {0.0f, 4.2f, 0.0f}, {0.5f * toward, 4.98f, 0.0f}, 0.02f, 5);
        builder.box(of.glow_cyan, {-0.075f, 1.5f, -0.075f}, {0.075f, 1.53f, 0.075f});
        const glm::vec3 head(0.95f * toward, 4.86f, 0.0f);
        constexpr std::array<glm::vec2, 4> kShade{{{0.0f, 0.34f}, {0.10f, 0.30f}, {0.28f, 0.06f}, {0.28f, 0.0f}}};
        builder.lathe(of.iron, head, kShade, 12);
        constexpr std::array<glm::vec2, 4> kGlobe{{{0.22f, 0.03f}, {0.19f, -0.12f}, {0.10f, -0.19f}, {0.0f, -0.21f}}};
        builder.lathe(of.lamp_warm, head, kGlobe, 12, true);
        if (!light) return;
        add_lamp(site, "street lamp", head - glm::vec3(0.0f, 0.45f, 0.0f), {15.0f, 10.4f, 6.2f}, 11.5f, 0.2f);
        add_beam(site, of.warm_beam, head - glm::vec3(0.0f, 0.15f, 0.0f), 2.7f, 0.24f, 1.05f, 0.10f);
    };
    for (const float z : {13.0f, -1.0f, -15.0f, -32.0f}) lamp(-4.6f, z, 1.0f, true);
    for (const float z : {6.0f, -8.0f, -24.5f, -37.0f}) lamp(4.6f, z, -1.0f, true);
    for (const float z : {-53.0f, -72.0f, -90.0f}) lamp(-4.6f, z, 1.0f, z > -60.0f);
    for (const float z : {-62.0f, -81.0f}) lamp(4.6f, z, -1.0f, z > -70.0f);
    for (const float x : {-14.0f, -27.0f, 14.0f, 27.0f}) lamp(x, kCrossFar + 1.1f, 0.1f, std::abs(x) < 20.0f);
}

void add_big_signs(Site& site) {
    Builder& builder = site.builder;
    const Materials& of = site.of;
    // Boards over the pavement: side, place along, picture, foot, height.
    struct Board {
        float side, z;
        int sign;
        float foot_m, height_m;
    };
    constexpr std::array<Board, 12> kBoards{{{-1, 4.0f, 0, 5.0f, 5.6f},
                                             {1, 8.5f, 6, 4.9f, 5.2f},
                                             {-1, -7.5f, 1, 4.8f, 6.4f},
                                             {1, -6.5f, 2, 5.8f, 4.2f},
                                             {-1, -18.6f, 5, 5.2f, 6.0f},
                                             {1, -19.5f, 3, 6.2f, 6.4f},
                                             {-1, -29.0f, 7, 4.9f, 5.0f},
                                             {1, -33.0f, 4, 6.2f, 5.0f},
                                             {-1, -54.0f, 2, 5.0f, 6.0f},
                                             {1, -57.0f, 1, 5.0f, 6.8f},
                                             {-1, -68.0f, 6, 5.4f, 6.0f},
                                             {1, -71.0f, 0, 5.0f, 6.4f}}};
    for (const Board& board : kBoards) {
        builder.place(facing({board.side * kFacadeX, 0.0f, board.z}, {-board.side, 0.0f, 0.0f}));
        add_sign_down(site, board.sign, {0.0f, board.foot_m, 0.75f}, board.height_m, board.z > -50.0f);
    }
    // The alley is hung with them.
    constexpr std::array<Board, 6> kAlley{{{1, -9.5f, 3, 3.2f, 4.0f},
                                           {-1, -11.5f, 0, 3.4f, 4.8f},
                                           {1, -14.5f, 6, 3.0f, 4.4f},
                                           {-1, -17.0f, 1, 3.3f, 4.6f},
                                           {1, -20.0f, 7, 3.1f, 4.0f},
                                           {-1, -23.5f, 5, 3.3f, 4.8f}}};
    for (const Board& board : kAlley) {
        const float z = board.side > 0.0f ? kAlleyNear : kAlleyFar;
        builder.place(facing({board.z, 0.0f, z}, {0.0f, 0.0f, -board.side}));
        add_sign_down(site, board.sign, {0.0f, board.foot_m, 0.35f}, board.height_m, false);
    }
    builder.place(facing({kAlleyEnd, 0.0f, 0.5f * (kAlleyNear + kAlleyFar)}, {1.0f, 0.0f, 0.0f}));
    add_sign_across(site, 7, {0.0f, 4.6f, 0.30f}, 3.3f);
    add_lamp(site, "end of the alley", {0.0f, 3.4f, 1.4f}, {0.9f, 2.6f, 3.1f}, 8.0f, 0.3f);
    // On the roofs, on scaffolds.
    struct Roof {
        glm::vec3 foot, outward;
        int sign;
        float width_m;
    };
    const std::array<Roof, 4> kRoofs{{{{-8.6f, 18.6f, -29.5f}, {0.45f, 0.0f, 0.893029f}, 11, 7.0f},
                                      {{8.6f, 18.6f, -72.0f}, {-0.4f, 0.0f, 0.916515f}, 9, 9.0f},
                                      {{-8.8f, 22.0f, -53.0f}, {0.4f, 0.0f, 0.916515f}, 15, 8.0f},
                                      {{0.0f, 10.5f, -97.0f}, {0.0f, 0.0f, 1.0f}, 1, 9.0f}}};
    for (const Roof& roof : kRoofs) {
        builder.place(facing(roof.foot, roof.outward));
        add_sign_across(site, roof.sign, {0.0f, 2.6f, 0.0f}, roof.width_m);
        for (float x = -0.45f; x < 0.5f; x += 0.225f) {
            const float at = x * roof.width_m;
            builder.bar(of.iron, {at, -2.0f, -0.12f}, {at, 3.7f, -0.12f}, 0.05f, 5);
            builder.bar(of.iron, {at, -1.6f, -1.7f}, {at, 3.0f, -0.12f}, 0.04f, 5);
        }
    }
    // Screens on walls and roofs, for those who look up: a lit pane each.
    const glm::vec3 to_near(0.0f, 0.0f, 1.0f);
    const std::array<Roof, 6> kScreens{{{{-kFacadeX + 1.0f, 14.2f, -13.0f}, {1.0f, 0.0f, 0.0f}, 12, 9.6f},
                                        {{-9.6f, 26.0f, -19.0f}, {0.50f, 0.0f, 0.866025f}, 0, 8.0f},
                                        {{kFacadeX - 3.3f, 14.4f, -58.0f}, to_near, 6, 5.6f},
                                        {{-kFacadeX + 3.2f, 12.6f, -66.0f}, to_near, 4, 5.4f},
                                        {{13.4f, 10.2f, kCrossFar + 1.0f}, to_near, 14, 7.6f},
                                        {{-13.0f, 10.4f, kCrossFar + 1.0f}, to_near, 10, 7.6f}}};
    for (const Roof& screen : kScreens) {
        builder.place(facing(screen.foot, screen.outward));
        add_sign_across(site, screen.sign, glm::vec3(0.0f), screen.width_m);
        const bool beside = std::abs(screen.foot.x) < 0.9f * kFacadeX && screen.outward.z > 0.9f;
        for (const float at : {-0.4f, 0.4f}) {
            if (beside) {  // it stands out from the wall like a flag
                const float wall = std::copysign(kFacadeX - std::abs(screen.foot.x) + 0.1f, screen.foot.x);
                builder.bar(of.iron, {0.0f, at, -0.09f}, {wall, at, -0.09f}, 0.07f, 5);
            } else {
                builder.bar(of.iron, {at * screen.width_m, -0.3f, -0.05f}, {at * screen.width_m, -0.9f, -1.6f}, 0.06f,
                            5);
                builder.bar(of.iron, {at * screen.width_m, 0.5f, -0.05f}, {at * screen.width_m, -0.9f, -1.6f}, 0.06f,
                            5);
            }
        }
        add_lamp(site, "screen", {0.0f, -1.0f, 1.8f}, kSignsAcross[static_cast<std::size_t>(screen.sign)].tint * 4.0f,
                 8.0f, 0.8f);
    }
    builder.place(glm::mat4(1.0f));
    add_lamp(site, "alley", {-9.6f, 2.5f, -21.8f}, {2.6f, 1.9f, 1.4f}, 6.0f, 0.3f);
    add_lamp(site, "alley", {-14.6f, 2.6f, -21.8f}, {2.3f, 0.7f, 2.6f}, 6.0f, 0.3f);
    add_lamp(site, "alley", {-20.5f, 2.6f, -21.8f}, {0.7f, 1.9f, 2.4f}, 6.5f, 0.3f);
    // The mouth of the metro.
    builder.place(facing({-4.9f, 0.0f, -35.0f}, {0.0f, 0.0f, 1.0f}));
    for (const float x : {-1.1f, 1.1f}) builder.bar(of.copper, {x, kPavement_m, 0.0f}, {x, 3.1f, 0.0f}, 0.06f, 8);
    add_sign_across(site, 8, {0.0f, 2.95f, 0.05f}, 2.2f);
}

}  // namespace halfframe::content::street
