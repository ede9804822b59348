// Letters made of rectangles, for labels inside a scene: no font file, no texture, the same on every machine.
#pragma once

#include <string_view>

#include "engine/frame/scene.h"

namespace halfframe::content {

/// Appends one line of text to `mesh`, in the XY plane facing +Z: centred on `centre.x`, `height_m` high around
/// `centre.y`. Small letters are drawn as capitals; what has no letter here (other than A-Z, 0-9, . , - / +) is a
/// blank.
void add_block_letters(Mesh& mesh, std::string_view text, const glm::vec3& centre, float height_m);

/// Width of a line of that height [m], without the blank after its last letter.
[[nodiscard]] float block_letters_width(std::string_view text, float height_m);

}  // namespace halfframe::content
