// Makes the materials and their textures.
#include "content/street/materials.h"

#include "content/noise.h"
#include "content/plain_materials.h"
#include "content/street/sign_textures.h"
#include "content/street/street.h"
#include "content/street/textures.h"

namespace halfframe::content::street {

namespace {

/// Black but for what it sends out.
Material shining(const char* name, const glm::vec3& radiance) {
    return content::shining(name, radiance, glm::vec3(0.0f));
}

/// Light in the air: no lamp shines on it.
Material blended(const char* name, const glm::vec3& radiance, float alpha) {
    Material material = content::blended(shining(name, radiance), alpha);
    material.roughness = 1.0f;
    return material;
}

Material textured(Builder& builder, const char* name, TextureSet set, float normal_scale = 1.0f) {
    Material material = dielectric(name, glm::vec3(1.0f), 1.0f);
    material.metallic = 1.0f;  // the texture says where
    material.normal_scale = normal_scale;
    material.base_color_texture.image = builder.add_image(std::move(set.base_color));
    material.normal_texture.image = builder.add_image(std::move(set.normal));
    material.metallic_roughness_texture.image = builder.add_image(std::move(set.metallic_roughness));
    if (!set.emissive.rgba.empty()) material.emissive_texture.image = builder.add_image(std::move(set.emissive));
    return material;
}

/// Rain soaks all of it. Never under a vertex colour: the plan can write it into textures.
Material rained_on(Material material) {
    material.water = WaterMask::everywhere;
    return material;
}

/// Walls stand in the rain's way edge on: they soak unevenly, in runs, to some half. A texture of its own for the
/// water, which leaves no crack to fill.
Image wall_water(std::uint32_t seed) {
    constexpr int kTexels = 256;
    Image image = blank("wall water", kTexels, kTexels, false);
    for (int y = 0; y < kTexels; ++y) {
        for (int x = 0; x < kTexels; ++x) {
            const float u = static_cast<float>(x) / kTexels, v = static_cast<float>(y) / kTexels;
            const float patches = layered_noise(u, v, 4, 3, seed);
            const float runs = smooth_noise(u * 24.0f, 0.0f, 24, seed + 1u);
            set_texel(image, x, y, {255.0f * (0.22f + 0.38f * patches + 0.18f * runs), 255.0f, 0.0f});
        }
    }
    return image;
}

/// Shelter and puddles are painted on its vertices.
Material ground(Material material) {
    material.water = WaterMask::vertex_color;
    material.deepest_puddle_m = kDeepestPuddle_m;
    return material;
}

void add_walls_and_ground(Builder& builder, Materials& of, std::uint32_t seed) {
    const int wall_mask = builder.add_image(wall_water(mixed(seed, 14)));
    const auto wall = [&](Material material) {
        material.water = WaterMask::texture;
        material.water_texture.image = wall_mask;
        return material;
    };
    const Material stone = textured(builder, "stone", stone_texture(mixed(seed, 1)));
    of.stone = builder.add_material(wall(stone), {.side_m = kStoneSide_m, .wall = true});
    Material trim = stone;
    trim.name = "trim";
    trim.base_color = glm::vec4(1.0f);
    of.trim = builder.add_material(wall(trim), {.side_m = kStoneSide_m, .wall = true});
    const auto sheltered = [&](Material material) {
        material.name = "sheltered " + material.name;
        return builder.add_material(std::move(material), {.side_m = kStoneSide_m, .wall = true});
    };
    of.sheltered_stone = sheltered(stone);
    of.sheltered_trim = sheltered(trim);
    of.brick = builder.add_material(wall(textured(builder, "brick", brick_texture(mixed(seed, 2)))),
                                    {.side_m = kBrickSide_m, .wall = true});
    of.plaster = builder.add_material(wall(textured(builder, "plaster", plaster_texture(mixed(seed, 3)))),
                                      {.side_m = kPlasterSide_m, .wall = true});
    of.panels = builder.add_material(wall(textured(builder, "panels", panel_texture(mixed(seed, 4)))),
                                     {.side_m = kPanelSide_m, .wall = true});
    of.zinc = builder.add_material(textured(builder, "zinc", zinc_texture(mixed(seed, 5))), {kZincSide_m});
    of.wood = builder.add_material(rained_on(textured(builder, "boards", wood_texture(mixed(seed, 6)))), {kWoodSide_m});
    of.asphalt = builder.add_material(ground(textured(builder, "asphalt", asphalt_texture(mixed(seed, 7)))),
                                      {.side_m = kAsphaltSide_m, .colors = true});
    of.cobbles = builder.add_material(ground(textured(builder, "cobbles", cobble_texture(mixed(seed, 8)))),
                                      {.side_m = kCobbleSide_m, .colors = true});
    of.paving = builder.add_material(ground(textured(builder, "paving", paving_texture(mixed(seed, 9)))),
                                     {.side_m = kPavingSide_m, .colors = true});
    of.kerb = builder.add_material(rained_on(dielectric("kerb", {0.16f, 0.165f, 0.17f}, 0.55f)), {});
    of.paint = builder.add_material(rained_on(dielectric("road paint", {0.42f, 0.43f, 0.44f}, 0.45f)), {});
}

void add_openings(Builder& builder, Materials& of, std::uint32_t seed) {
    Material window = textured(builder, "windows", window_textures(mixed(seed, 10)), 0.5f);
    window.emissive = glm::vec3(5.6f);
    of.window = builder.add_material(window, {.wall = true});
    Material shop = dielectric("shop windows", glm::vec3(0.02f), 0.12f);
    shop.emissive = glm::vec3(5.4f);
    shop.emissive_texture.image = builder.add_image(shop_picture(mixed(seed, 11)));
    of.shop_window = builder.add_material(shop, {});
    Material glass = dielectric("glass", {0.05f, 0.07f, 0.09f}, 0.08f);
    glass.base_color.a = 0.30f;
    glass.alpha_mode = AlphaMode::blend;
    glass.double_sided = true;
    of.glass = builder.add_material(glass, {});
    Material railing = dielectric("railing", glm::vec3(1.0f), 0.5f);
    railing.base_color_texture.image = builder.add_image(railing_picture());
    railing.alpha_mode = AlphaMode::mask;
    railing.alpha_cutoff = 0.35f;  // its mips grow thin: kept a little wider than half
    railing.double_sided = true;
    of.railing = builder.add_material(railing, {});
    const int boards = builder.scene().materials[static_cast<std::size_t>(of.wood)].base_color_texture.image;
    Material shutter = builder.scene().materials[static_cast<std::size_t>(of.wood)];
    shutter.name = "blue shutters";
    shutter.base_color_texture.image = boards;
    shutter.base_color = glm::vec4(0.42f, 0.62f, 0.95f, 1.0f);
    of.shutter_blue = builder.add_material(shutter, {kWoodSide_m});
    shutter.name = "grey shutters";
    shutter.base_color = glm::vec4(0.80f, 0.92f, 1.0f, 1.0f);
    of.shutter_grey = builder.add_material(shutter, {kWoodSide_m});
    of.door = builder.add_material(dielectric("door", {0.030f, 0.052f, 0.075f}, 0.35f), {});
}

void add_things(Builder& builder, Materials& of) {
    of.iron = builder.add_material(dielectric("iron", {0.030f, 0.033f, 0.038f}, 0.45f), {});
    of.steel = builder.add_material(metal("steel", {0.62f, 0.61f, 0.60f}, 0.34f), {});
    of.copper = builder.add_material(metal("copper", {0.93f, 0.54f, 0.50f}, 0.42f), {});
    of.rubber = builder.add_material(dielectric("rubber", {0.016f, 0.016f, 0.017f}, 0.7f), {});
    of.leaves = builder.add_material(dielectric("leaves", {0.045f, 0.085f, 0.050f}, 0.6f), {});
    of.soil = builder.add_material(dielectric("soil", {0.045f, 0.035f, 0.028f}, 0.9f), {});
    of.cloth_red = builder.add_material(dielectric("red cloth", {0.30f, 0.045f, 0.045f}, 0.85f), {});
    of.cloth_blue = builder.add_material(dielectric("blue cloth", {0.050f, 0.10f, 0.24f}, 0.85f), {});
    of.cloth_purple = builder.add_material(dielectric("purple cloth", {0.15f, 0.06f, 0.22f}, 0.85f), {});
    of.lacquer_red = builder.add_material(dielectric("red lacquer", {0.26f, 0.025f, 0.025f}, 0.22f), {});
    of.lacquer_blue = builder.add_material(dielectric("blue lacquer", {0.028f, 0.055f, 0.12f}, 0.20f), {});
    of.lacquer_pale = builder.add_material(dielectric("pale lacquer", {0.30f, 0.32f, 0.35f}, 0.24f), {});
}

void add_lights_and_air(Builder& builder, Materials& of, std::uint32_t seed) {
    // Boards are dark where they do not shine, and not black: sRGB 36, as halfframe check asks of all that lamps reach.
    constexpr glm::vec3 kDark(0.0176f);
    Material signs = content::shining("signs across", glm::vec3(7.0f), kDark);
    signs.emissive_texture.image = builder.add_image(signs_across_picture());
    of.signs_across = builder.add_material(signs, {.unlit = true});
    signs.name = "signs down";
    signs.emissive_texture.image = builder.add_image(signs_down_picture());
    of.signs_down = builder.add_material(signs, {.unlit = true});
    Material skyline = content::shining("skyline", glm::vec3(0.55f), kDark);
    skyline.emissive_texture.image = builder.add_image(skyline_picture(mixed(seed, 12)));
    of.skyline = builder.add_material(skyline, {.side_m = 26.0f, .unlit = true});
    of.lamp_warm = builder.add_material(shining("warm lamp", {7.0f, 4.6f, 2.5f}), {.unlit = true});
    of.lamp_cool = builder.add_material(shining("cool lamp", {3.6f, 5.2f, 7.0f}), {.unlit = true});
    of.glow_red = builder.add_material(shining("red glow", {4.2f, 0.40f, 0.30f}), {.unlit = true});
    of.glow_blue = builder.add_material(shining("blue glow", {0.35f, 1.5f, 4.6f}), {.unlit = true});
    of.glow_purple = builder.add_material(shining("purple glow", {2.2f, 0.7f, 4.4f}), {.unlit = true});
    of.glow_cyan = builder.add_material(shining("cyan glow", {0.9f, 3.6f, 4.4f}), {.unlit = true});
    const int pictures = builder.add_image(hologram_picture(mixed(seed, 13)));
    // Pure colours, and more of them: where display values are blended (at low), light past white leaves only grey.
    const auto hologram = [&](const char* name, const glm::vec3& radiance) {
        Material material = blended(name, radiance, 0.85f);
        material.base_color_texture.image = pictures;
        return builder.add_material(material, {});
    };
    of.hologram_cyan = hologram("cyan hologram", {0.15f, 2.1f, 2.7f});
    of.hologram_red = hologram("red hologram", {3.0f, 0.20f, 0.15f});
    of.hologram_purple = hologram("purple hologram", {1.5f, 0.15f, 3.0f});
    of.haze = builder.add_material(blended("haze", {0.060f, 0.075f, 0.100f}, 1.0f), {.colors = true});
    of.warm_beam = builder.add_material(blended("warm beam", {0.85f, 0.56f, 0.30f}, 1.0f), {.colors = true});
    of.cool_beam = builder.add_material(blended("cool beam", {0.40f, 0.58f, 0.85f}, 1.0f), {.colors = true});
}

}  // namespace

Materials add_materials(Builder& builder, std::uint32_t seed) {
    Materials of;
    add_walls_and_ground(builder, of, seed);
    add_openings(builder, of, seed);
    add_things(builder, of);
    add_lights_and_air(builder, of, seed);
    return of;
}

}  // namespace halfframe::content::street
