// What the street's signs say, and the pictures of it.
#pragma once

#include <array>
#include <string_view>

#include "engine/frame/scene.h"

namespace halfframe::content::street {

enum class SignStyle : std::uint8_t {
    neon,  ///< bent tubes before a dark board
    box,   ///< a lit pane with dark letters
};

struct SignText {
    std::string_view text;
    SignStyle style;
    glm::vec3 tint;  ///< linear, the strongest channel 1
};

/// Across: kAcrossColumns a row, four times as wide as high. Down: side by side, eight times as high as wide.
constexpr int kAcrossColumns = 2;
constexpr int kAcrossRows = 8;
constexpr int kDownColumns = 8;
extern const std::array<SignText, kAcrossColumns * kAcrossRows> kSignsAcross;
extern const std::array<SignText, kDownColumns> kSignsDown;

[[nodiscard]] Image signs_across_picture();
[[nodiscard]] Image signs_down_picture();
/// The part of the picture that a sign takes: upper left and lower right.
[[nodiscard]] std::array<glm::vec2, 2> across_uv(int sign);
[[nodiscard]] std::array<glm::vec2, 2> down_uv(int sign);

/// What floats in the air: four pictures, two a row, with alpha: a portrait of lines, a turning ring of text, a price
/// with a frame, and a map.
[[nodiscard]] Image hologram_picture(std::uint32_t seed);
[[nodiscard]] std::array<glm::vec2, 2> hologram_uv(int picture);

}  // namespace halfframe::content::street
