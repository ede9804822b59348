// A stroke font for neon: capitals, digits and a few marks as lines on a grid four wide and six high.
#pragma once

#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace halfframe::content::street {

struct Stroke {
    glm::vec2 from;
    glm::vec2 to;
};

constexpr float kLetterWidth = 4.0f;
constexpr float kLetterHeight = 6.0f;
/// From the left edge of one letter to that of the next.
constexpr float kLetterAdvance = 5.6f;

/// The strokes of a letter, x to the right 0..4, y downwards 0..6; empty for a space. A letter that is not drawn:
/// Mistake. The small letter e stands for E with an acute accent, which reaches up to y = -1.5.
[[nodiscard]] std::vector<Stroke> strokes_of(char letter);

/// The strokes of a line of text: across, or one letter under the other.
[[nodiscard]] std::vector<Stroke> strokes_across(std::string_view text);
[[nodiscard]] std::vector<Stroke> strokes_down(std::string_view text);

}  // namespace halfframe::content::street
