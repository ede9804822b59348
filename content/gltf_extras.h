// What halfframe has and glTF has not, as `extras`: flat keys hf_*, so that custom properties of modelling programs
// work. content/extras_schema.json describes them; one row of the table in gltf_extras.cpp is one key.
#pragma once

#include <string>

#include "content/gltf_document.h"
#include "engine/frame/scene.h"

namespace halfframe::content {

/// The object of a glTF file that an `extras` belongs to.
enum class ExtrasOwner { scene, node, mesh, camera, light, material };

/// The environment that a file asks for: a built-in one, made when all is read.
struct Surroundings {
    std::string name;
    int size = 128;
    float strength = 1.0f;
};

/// What a row writes to; the one that fits its owner is set.
struct ExtrasTarget {
    Scene* scene = nullptr;
    Surroundings* surroundings = nullptr;  ///< with `scene`
    Surface* surface = nullptr;
    Camera* camera = nullptr;
    Light* light = nullptr;
    Material* material = nullptr;
    int* water_texture = nullptr;  ///< with `material`: index in the file's textures
};

/// Every key hf_* of the document is known where it stands, and its value is in range. Else Error(input) with the
/// nearest spelling, or with the range. Other keys are not ours.
void check_gltf_extras(const GltfDocument& document);

/// Writes what `object`'s extras say to the target. The document was checked.
void apply_extras(const JsonPlace& object, ExtrasOwner owner, const ExtrasTarget& target);

/// content/extras_schema.json, made of the table.
[[nodiscard]] std::string extras_schema();

}  // namespace halfframe::content
