// A scene that keeps every rule of `halfframe check`, to plant faults in.
#pragma once

#include <string>
#include <vector>

#include "content/built_in.h"
#include "content/shapes.h"
#include "engine/frame/scene.h"
#include "perf/check/check.h"

namespace halfframe::check {

/// `side` x `side` texels of one colour.
inline Image plain_image(const std::string& name, int side, const glm::u8vec4& color, bool srgb) {
    Image image{.name = name, .width = side, .height = side, .srgb = srgb, .rgba = {}};
    for (int texel = 0; texel < side * side; ++texel) {
        for (int channel = 0; channel < 4; ++channel) image.rgba.push_back(color[channel]);
    }
    return image;
}

/// Images of a clean scene, by index.
enum CleanImage : int { kBaseImage, kMetalImage, kNormalImage };

/// A square with a base colour of code 128, no metal, a smoothness of about one half and a flat normal map.
inline Scene clean_scene() {
    Scene scene;
    scene.name = "clean";
    content::add_image(scene, plain_image("base", 64, {128, 128, 128, 255}, true));
    content::add_image(scene, plain_image("metal", 64, {255, 102, 0, 255}, false));
    content::add_image(scene, plain_image("normal", 64, {128, 128, 255, 255}, false));
    Material material;
    material.name = "paint";
    material.base_color_texture.image = kBaseImage;
    material.metallic_roughness_texture.image = kMetalImage;
    material.normal_texture.image = kNormalImage;
    const int square = content::add_mesh(scene, content::quad({1.0f, 1.0f}), "square");
    content::add_surface(scene, "square", square, content::add_material(scene, material), glm::mat4(1.0f));
    return scene;
}

inline void paint(Scene& scene, CleanImage image, const glm::u8vec4& color) {
    Image& target = scene.images[static_cast<std::size_t>(image)];
    target = plain_image(target.name, target.width, color, target.srgb);
}

inline Report check_of(const Scene& scene) { return check_scene(scene, {.file = {}, .thresholds = thresholds()}); }

/// "error albedo-dark; warning texture-size", in order: what a test compares and prints.
inline std::string findings_of(const Report& report) {
    std::string text;
    for (const Finding& finding : report.findings) {
        text += (text.empty() ? "" : "; ") + std::string(name(finding.level)) + " " + rule(finding.rule).name;
    }
    return text;
}

}  // namespace halfframe::check
