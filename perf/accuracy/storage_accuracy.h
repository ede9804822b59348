// What storing light in scene_color does to the picture: each format of the ladder, on a real context.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "engine/gl/pixel_format.h"
#include "perf/accuracy/function_list.h"

namespace halfframe::accuracy {

/// Where the stored values come from.
enum class StoredSource : std::uint8_t {
    light,  ///< light 0..8, as surfaces leave it: half of it even in what the display shows, half in its logarithm
    display_codes,  ///< the 256 display values of an LDR sky, through the inverse tone curve
    panes,          ///< three translucent layers before a fourth light, each 0..8, blended as the device blends
};
inline constexpr std::array kStoredSources{StoredSource::light, StoredSource::display_codes, StoredSource::panes};
[[nodiscard]] const char* name(StoredSource source);

struct StorageAccuracy {
    gl::PixelFormat format = gl::PixelFormat::rgba16f;
    StoredSource source = StoredSource::light;
    std::string missing;  ///< why nothing was measured; empty: it was
    std::size_t lanes = 0;
    /// [display codes], against the tone curve's reference of the unrounded light, like p99. Of panes: of what they
    /// blend to as the format holds light; what that itself is off by is a model (blended_as).
    double largest = 0.0;
    double p99 = 0.0;   ///< 99 of 100 errors are at most this
    double mean = 0.0;  ///< signed: below 0 where storing darkens
    double worst_light = 0.0;
    int worst_channel = 0;       ///< 0 red, 1 green, 2 blue
    std::size_t not_finite = 0;  ///< in no other figure
    Bound bound;
    std::vector<std::string> violations;  ///< a sentence for every bound that does not hold
};

/// How far light may be off behind a format, whether it rounds to nearest or towards zero.
[[nodiscard]] Bound storage_bound(gl::PixelFormat format, StoredSource source);

/// A light of every lane, red, green and blue, and its alpha.
struct LightLayer {
    shader_ir::Columns light;
    std::vector<double> alpha;
};

/// Stores layers one over the other in a target of `format`, as surface and transparent do: RGBA of every lane as it is
/// held. The first layer is opaque.
[[nodiscard]] std::vector<float> layers_held(gl::EntryPoints& gl, const gl::Caps& caps, gl::PixelFormat format,
                                             std::span<const LightLayer> layers);

/// Writes the sources to a target of each format as surfaces and sky do, and reads them back through tone_map.frag in
/// highp; an RGBA8 target holds display values and is read as it is. `missing` says why a format has no figures.
[[nodiscard]] std::vector<StorageAccuracy> measure_storage(gl::EntryPoints& gl, const gl::Caps& caps,
                                                           std::span<const StoredSource> sources = kStoredSources);

}  // namespace halfframe::accuracy
