// The three axes of quality: tier, arithmetic, storage. They cross; none is folded into another.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "engine/gl/pixel_format.h"
#include "engine/gl/program.h"

namespace halfframe {

/// An ordered promise.
/// low: plain ES 2.0: 8 attributes, 8 samplers, 16 fragment uniform vectors, no need of fragment highp, no float
/// targets, no 3D textures, no explicit LOD. console: ES 3.0, the talk's technique at PS3 cost. reference: highp, float
/// targets, as slow as it must be.
enum class Tier : std::uint8_t { low, console, reference };
inline constexpr int kTierCount = 3;

[[nodiscard]] const char* name(Tier tier);
[[nodiscard]] std::optional<Tier> tier_from_name(std::string_view text);

/// half: mediump where the shader allows it; full: highp everywhere. `automatic` is full on a software driver, half
/// elsewhere, and half where the device has no fragment highp.
using gl::Arithmetic;
[[nodiscard]] const char* name(Arithmetic arithmetic);

/// Default limit on the bytes a pixel of all targets of a frame together, by tier. Ours: low is RGBA8 + 16-bit depth
/// (6 B) with one more such target to spare; console is RGBA16F + depth + display with an auxiliary RGBA8; reference is
/// RGBA32F + depth with 4 samples each, resolved colour, display.
[[nodiscard]] double bytes_per_pixel_limit(Tier tier);

}  // namespace halfframe
