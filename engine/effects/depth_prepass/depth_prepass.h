// START HERE: depth_prepass writes the depth of opaque surfaces first, so that each pixel is shaded once.
#pragma once

#include "engine/frame/effect_card.h"

namespace halfframe {

extern const EffectCard kDepthPrepass;

/// How many times the screen boxes of the opaque surfaces cover the picture together (0: nothing in view). An upper
/// estimate of overdraw that needs no drawing; depends on scene and view alone.
[[nodiscard]] double opaque_cover(const Scene& scene, const View& view);

/// From this cover on a prepass is called for. Shading a pixel twice costs a PS3-class surface shader about 20 cycles;
/// its depth alone costs one, but over every vertex again: the break-even is near three layers.
inline constexpr double kPrepassCover = 3.0;

}  // namespace halfframe
