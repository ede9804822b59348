// The pictures on what the street is built of. Albedo within sRGB 32..243, metals 186..255, as the talk's charts have
// it.
#pragma once

#include <array>

#include "content/noise.h"

namespace halfframe::content::street {

// Metres that one repeat of each covers; 128 texels a metre, but where said.
constexpr float kStoneSide_m = 4.0f;    ///< 512 texels
constexpr float kBrickSide_m = 2.0f;    ///< 256
constexpr float kPlasterSide_m = 4.0f;  ///< 512
constexpr float kAsphaltSide_m = 4.0f;  ///< 512
constexpr float kCobbleSide_m = 2.0f;   ///< 256
constexpr float kPavingSide_m = 2.0f;   ///< 256
constexpr float kPanelSide_m = 2.0f;    ///< 256
constexpr float kWoodSide_m = 2.0f;     ///< 256
constexpr float kZincSide_m = 2.0f;     ///< 256

[[nodiscard]] TextureSet stone_texture(std::uint32_t seed);
[[nodiscard]] TextureSet brick_texture(std::uint32_t seed);
[[nodiscard]] TextureSet plaster_texture(std::uint32_t seed);
[[nodiscard]] TextureSet asphalt_texture(std::uint32_t seed);
[[nodiscard]] TextureSet cobble_texture(std::uint32_t seed);
[[nodiscard]] TextureSet paving_texture(std::uint32_t seed);
/// Painted panels with seams and rivets.
[[nodiscard]] TextureSet panel_texture(std::uint32_t seed);
[[nodiscard]] TextureSet wood_texture(std::uint32_t seed);
[[nodiscard]] TextureSet zinc_texture(std::uint32_t seed);

/// Wrought iron, 1 m wide and high, alpha 0 between the bars. 256 texels.
[[nodiscard]] Image railing_picture();

/// kWindowKinds squares, kWindowColumns a row: a window with its frame, its glass, and what shows behind it.
constexpr int kWindowColumns = 4;
constexpr int kWindowKinds = 16;
[[nodiscard]] TextureSet window_textures(std::uint32_t seed);
/// The first kind of each glow; each has kWindowsOfAGlow kinds.
constexpr int kWindowsOfAGlow = 4;
enum class Glow : std::uint8_t { dark, warm, amber, cool };

/// Eight shop windows, two a row, twice as wide as high: shelves and goods in the light.
constexpr int kShopColumns = 2;
constexpr int kShopKinds = 8;
[[nodiscard]] Image shop_picture(std::uint32_t seed);

/// Windows of towers far away, 32 by 32 of them.
[[nodiscard]] Image skyline_picture(std::uint32_t seed);

}  // namespace halfframe::content::street
