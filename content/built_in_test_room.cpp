// The test room: 6 x 3 x 4 m, one of everything that the surface effect knows. Blue-grey and desaturated, with hints of
// brighter blue, purple and red, as the talk's palette has it.
#include "content/built_in.h"

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "content/plain_materials.h"
#include "content/room_textures.h"
#include "content/shapes.h"

namespace halfframe::content {
namespace {

// The room [m]: x from -3 to 3, y from 0 to 3, z from -2 to 2.
constexpr float kHalfWidth = 3.0f;
constexpr float kHeight = 3.0f;
constexpr float kHalfDepth = 2.0f;
// Walls, floor and ceiling are grids of this size [m]: the low tier lights them by vertex, and its lamps need vertices.
constexpr float kWallCell = 0.25f;
// Walls reach this far behind each other [m]: their grids do not match, and a shared edge would leak single pixels.
constexpr float kOverlap = 0.05f;
// How thick the roof and the walls towards the sun are [m].
constexpr float kThickness = 0.20f;
// They begin this far behind what is seen of them [m]: two faces in one plane would fight for every pixel, and 16 bits
// of depth tell 3 cm apart at the far end of the room when the near plane is at 2 cm.
constexpr float kBehind = 0.06f;
// The opening in the wall at +X [m]: z from -0.8 to 0.8, y from 0.9 to 2.3.
constexpr float kOpeningHalfWidth = 0.8f;
constexpr float kOpeningBottom = 0.9f;
constexpr float kOpeningTop = 2.3f;

const glm::vec3 kUp{0.0f, 1.0f, 0.0f};

Material neon(const char* name, const glm::vec3& radiance) { return shining(name, radiance, glm::vec3(0.05f)); }

glm::mat4 at(const glm::vec3& position, float yaw_rad = 0.0f) {
    return glm::rotate(glm::translate(glm::mat4(1.0f), position), yaw_rad, kUp);
}

/// Lies flat, its front upwards (facing +1) or downwards (-1).
glm::mat4 lying_at(const glm::vec3& position, float facing) {
    return glm::rotate(glm::translate(glm::mat4(1.0f), position), -facing * glm::half_pi<float>(),
                       glm::vec3(1.0f, 0.0f, 0.0f));
}

void add_floor_and_ceiling(Scene& scene, int plaster) {
    TileImages tiles = floor_tiles(256);
    Material floor = dielectric("floor tiles", glm::vec3(1.0f), 1.0f);
    floor.metallic = 1.0f;  // the texture says 0
    floor.base_color_texture.image = add_image(scene, std::move(tiles.base_color));
    floor.normal_texture.image = add_image(scene, std::move(tiles.normal));
    floor.metallic_roughness_texture.image = add_image(scene, std::move(tiles.metallic_roughness));
    const glm::vec2 size_m(2.0f * (kHalfWidth + kOverlap), 2.0f * (kHalfDepth + kOverlap));
    const int tiled = add_mesh(scene, quad(size_m, size_m, kWallCell), "floor");  // a tile is half a metre
    const int ceiling = add_mesh(scene, quad(size_m, glm::vec2(1.0f), kWallCell), "ceiling");
    add_surface(scene, "floor", tiled, add_material(scene, floor), lying_at(glm::vec3(0.0f), 1.0f));
    add_surface(scene, "ceiling", ceiling, plaster, lying_at({0.0f, kHeight, 0.0f}, -1.0f));
}

/// The wall at +X: a fine grid without the cells of its opening, whose edges lie on the grid.
Mesh wall_with_opening() {
    Mesh wall = quad({2.0f * kHalfDepth, kHeight}, glm::vec2(1.0f), 0.1f);
    std::vector<std::uint32_t> kept;
    for (std::size_t i = 0; i + 2 < wall.indices.size(); i += 3) {
        glm::vec3 centre(0.0f);
        for (std::size_t corner = 0; corner < 3; ++corner) centre += wall.positions[wall.indices[i + corner]] / 3.0f;
        const float y = centre.y + 0.5f * kHeight;
        if (std::abs(centre.x) < kOpeningHalfWidth && y > kOpeningBottom && y < kOpeningTop) continue;
        kept.insert(kept.end(), wall.indices.begin() + static_cast<std::ptrdiff_t>(i),
                    wall.indices.begin() + static_cast<std::ptrdiff_t>(i + 3));
    }
    wall.indices = std::move(kept);
    return wall;
}

void add_opening_wall(Scene& scene, int plaster) {
    const float between = kOpeningTop - kOpeningBottom;
    const float middle = 0.5f * (kOpeningTop + kOpeningBottom);
    add_surface(scene, "opening wall", add_mesh(scene, wall_with_opening(), "opening wall"), plaster,
                at({kHalfWidth, 0.5f * kHeight, 0.0f}, -glm::half_pi<float>()));
    Material glass = dielectric("glass", glm::vec3(0.35f, 0.45f, 0.60f), 0.08f);
    glass.base_color.a = 0.25f;
    glass.alpha_mode = AlphaMode::blend;
    glass.double_sided = true;
    const int pane = add_mesh(scene, quad({2.0f * kOpeningHalfWidth, between}), "pane");
    add_surface(scene, "pane", pane, add_material(scene, glass),
                at({kHalfWidth, middle, 0.0f}, -glm::half_pi<float>()));
}

/// The thickness of the roof and of the two walls that the sun stands on. A wall without one lets light past its edges:
/// the filter of a shadow map is a few texels wide, and looks round every corner that is thinner.
void add_outer_walls(Scene& scene, int plaster) {
    const glm::vec3 low(-kHalfWidth - kThickness, -kThickness, -kHalfDepth - kThickness);
    const glm::vec3 high(kHalfWidth + kThickness, kHeight + kThickness, kHalfDepth + kThickness);
    const auto block = [&](const char* name, const glm::vec3& from, const glm::vec3& to) {
        add_surface(scene, name, add_mesh(scene, box(to - from), name), plaster, at(0.5f * (from + to)));
    };
    const float x = kHalfWidth + kBehind;
    const float y = kHeight + kBehind;
    const float z = kHalfDepth + kBehind;
    block("roof", {low.x, y, low.z}, high);
    block("outer front wall", {low.x, low.y, z}, {high.x, y, high.z});
    block("sill", {x, low.y, low.z}, {high.x, kOpeningBottom, z});
    block("lintel", {x, kOpeningTop, low.z}, {high.x, y, z});
    block("jamb at the back", {x, kOpeningBottom, low.z}, {high.x, kOpeningTop, -kOpeningHalfWidth});
    block("jamb at the front", {x, kOpeningBottom, kOpeningHalfWidth}, {high.x, kOpeningTop, z});
}

void add_walls(Scene& scene, int plaster) {
    const int long_wall =
        add_mesh(scene, quad({2.0f * (kHalfWidth + kOverlap), kHeight}, glm::vec2(1.0f), kWallCell), "long wall");
    const int short_wall =
        add_mesh(scene, quad({2.0f * (kHalfDepth + kOverlap), kHeight}, glm::vec2(1.0f), kWallCell), "short wall");
    const float y = 0.5f * kHeight;
    add_surface(scene, "back wall", long_wall, plaster, at({0.0f, y, -kHalfDepth}));
    add_surface(scene, "front wall", long_wall, plaster, at({0.0f, y, kHalfDepth}, glm::pi<float>()));
    add_surface(scene, "door wall", short_wall, plaster, at({-kHalfWidth, y, 0.0f}, glm::half_pi<float>()));
    add_opening_wall(scene, plaster);
    add_outer_walls(scene, plaster);
}

void add_props(Scene& scene) {
    const int ball = add_mesh(scene, sphere(0.4f), "ball");
    const int crate = add_mesh(scene, box(glm::vec3(0.7f)), "crate");
    const int column = add_mesh(scene, cylinder(0.22f, kHeight), "column");
    const int panel = add_mesh(scene, quad({1.2f, 1.6f}, {3.0f, 4.0f}), "grille panel");
    const int tube = add_mesh(scene, box({0.05f, 0.05f, 1.6f}), "neon tube");

    // Metals have sRGB 186..255 as specular in the talk: linear 0.49..1.
    add_surface(scene, "metal ball", ball, add_material(scene, metal("steel", {0.62f, 0.61f, 0.60f}, 0.25f)),
                at({-0.3f, 0.4f, -0.6f}));
    add_surface(scene, "blue ball", ball, add_material(scene, dielectric("blue lacquer", {0.06f, 0.13f, 0.42f}, 0.30f)),
                at({0.9f, 0.4f, 0.3f}));
    scene.surfaces.back().dynamic = true;  // it could roll: the low tier gives it a shadow of its own
    add_surface(scene, "crate", crate, add_material(scene, dielectric("red tarpaulin", {0.38f, 0.05f, 0.05f}, 0.75f)),
                at({-1.7f, 0.35f, -1.2f}, 0.4f));
    add_surface(scene, "column", column, add_material(scene, dielectric("concrete", {0.24f, 0.25f, 0.28f}, 0.85f)),
                at({1.9f, 0.5f * kHeight, -1.3f}));

    Material bars = dielectric("grille", glm::vec3(1.0f), 0.55f);
    bars.base_color_texture.image = add_image(scene, grille(128, 4));
    bars.alpha_mode = AlphaMode::mask;
    bars.double_sided = true;
    add_surface(scene, "grille panel", panel, add_material(scene, bars), at({-1.2f, 0.8f, 0.9f}, 0.6f));

    add_surface(scene, "violet neon", tube, add_material(scene, neon("violet neon", {1.1f, 0.7f, 3.2f})),
                at({1.2f, 2.5f, -kHalfDepth + 0.06f}, glm::half_pi<float>()));
    add_surface(scene, "red neon", tube, add_material(scene, neon("red neon", {2.6f, 0.25f, 0.2f})),
                at({-kHalfWidth + 0.06f, 2.2f, -0.4f}));
}

void add_lights(Scene& scene) {
    Light sun;
    sun.kind = LightKind::sun;
    sun.name = "sun";
    sun.color = glm::vec3(1.10f, 1.05f, 0.98f);
    sun.direction = glm::normalize(glm::vec3(-0.80f, -0.55f, -0.22f));  // in through the opening
    scene.lights.push_back(sun);

    Light warm;
    warm.name = "warm lamp";
    warm.position = {-2.2f, 2.1f, 0.9f};
    warm.color = glm::vec3(1.70f, 1.00f, 0.55f);
    warm.range_m = 5.0f;
    scene.lights.push_back(warm);

    Light cool;
    cool.name = "violet neon";
    cool.position = {1.2f, 2.3f, -1.45f};
    cool.color = glm::vec3(0.75f, 0.66f, 1.75f);
    cool.range_m = 5.0f;
    scene.lights.push_back(cool);

    Light spot;
    spot.kind = LightKind::spot;
    spot.name = "ceiling spot";
    spot.position = {0.3f, 2.9f, 0.0f};
    spot.direction = {0.0f, -1.0f, 0.0f};
    spot.color = glm::vec3(3.0f, 3.1f, 3.4f);
    spot.range_m = 6.0f;
    spot.inner_cone_rad = 0.30f;
    spot.outer_cone_rad = 0.60f;
    scene.lights.push_back(spot);

    scene.ambient = glm::vec3(0.085f, 0.095f, 0.120f);
    scene.sky = Sky{{0.30f, 0.36f, 0.46f}, {0.58f, 0.63f, 0.70f}, {0.20f, 0.21f, 0.23f}};
}

void add_cameras(Scene& scene) {
    const Box box = world_box(scene);
    Camera door = camera_looking({-2.7f, 1.6f, 1.6f}, {0.9f, 1.0f, -0.6f}, 1.0f, box);
    door.name = "door";
    Camera corner = camera_looking({2.6f, 2.3f, 1.7f}, {-0.8f, 0.7f, -0.7f}, 1.0f, box);
    corner.name = "corner";
    for (Camera* camera : {&door, &corner}) {
        camera->near_m = 0.25f;  // nothing in view is nearer; 16-bit depth then separates 2 mm at the far wall
        scene.cameras.push_back(*camera);
    }
}

}  // namespace

Scene make_test_room() {
    Scene scene;
    scene.name = "test_room";
    const int plaster = add_material(scene, dielectric("plaster", {0.27f, 0.29f, 0.33f}, 0.9f));
    add_floor_and_ceiling(scene, plaster);
    add_walls(scene, plaster);
    add_props(scene);
    add_lights(scene);
    add_cameras(scene);
    return scene;
}

}  // namespace halfframe::content
