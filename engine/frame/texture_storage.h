// How textures are stored on the device: mip levels made in linear light, maps packed together, colours compressed.
// Pure: no GL.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "engine/frame/scene.h"

namespace halfframe {

/// none: 8 bits a channel. dxt: DXT1 and DXT5 for colours, where the device has EXT_texture_compression_s3tc.
enum class TextureCompression : std::uint8_t { none, dxt };
[[nodiscard]] const char* name(TextureCompression compression);

/// What the texels of an image are: how a mean of them is made.
enum class TexelKind : std::uint8_t {
    color,           ///< sRGB colour and linear alpha: the mean is one of light
    data,            ///< each channel by itself
    normal,          ///< rgb: a unit vector as n * 0.5 + 0.5, mean and unit again
    packed_surface,  ///< rg: x and y of a unit vector with z > 0, as normal; b metallic, a roughness
};

/// How a shader reads an image.
struct TextureUse {
    bool decoded = false;  ///< sRGB is decoded on fetch (ES 3.0); else the shader gets the bytes as they are
    TexelKind kind = TexelKind::data;
    std::optional<float> alpha_cutoff;  ///< of a mask: levels keep the share that passes
    bool alpha_emits = false;           ///< alpha is the share of color_with_emission()
    bool operator==(const TextureUse&) const = default;
};
/// Of a material's base colour: surface and shadow have to ask alike, so that the device holds it once.
[[nodiscard]] TextureUse base_color_use(const Material& material, bool decoded);

/// For every image of the scene, how many of its largest levels to leave out so that all that materials use takes at
/// most `limit_bytes` of RGBA8 with mip levels: the largest image gives first, none below one texel.
[[nodiscard]] std::vector<int> levels_to_drop(const Scene& scene, std::size_t limit_bytes);

/// `width` x `height` from `image`, at most its size: each texel is the mean over its share of the larger picture.
[[nodiscard]] Image reduced(const Image& image, int width, int height, TexelKind kind);

/// Level 0 and all smaller ones down to one texel. `alpha_cutoff`: alpha of every level is scaled until as much of it
/// passes the cutoff as of level 0, so that leaves do not thin out with distance (I. Castano, "Computing Alpha
/// Mipmaps", 2010).
[[nodiscard]] std::vector<Image> mip_chain(Image image, TexelKind kind, std::optional<float> alpha_cutoff);
/// The same levels one after the other, the first `image` itself, so that no more than two more are held at a time.
void for_each_level(const Image& image, TexelKind kind, std::optional<float> alpha_cutoff,
                    const std::function<void(const Image&)>& visit);
/// Share of texels whose alpha passes.
[[nodiscard]] double alpha_coverage(const Image& image, float alpha_cutoff);

/// The normals of one map and the metallic-roughness of another in one image of kind packed_surface, as large as the
/// larger of the two in each direction; the smaller one is filtered. Spares a fetch.
[[nodiscard]] Image packed_surface_map(const Image& normals, const Image& metallic_roughness);

/// The colours of one image with the occlusion (red) of another as their alpha, as large as the larger of the two in
/// each direction; the smaller one is filtered, colours in linear light. Spares a fetch where alpha means nothing.
[[nodiscard]] Image color_with_occlusion(const Image& color, const Image& occlusion);

/// The one light that every texel of an emission is a share of (lamps that are on or off): linear 0..1, that of the
/// brightest texel. None where a texel is more than 2 display codes, in any channel, from its share as alpha holds it,
/// in steps of 1/255 of that light. That is strict, because up to a share of 1/50 these steps are several codes each,
/// and a dark gradient would show bands. Black is its own mask.
[[nodiscard]] std::optional<glm::vec3> emission_mask(const Image& emission);

/// The colours of one image with the shares of an emission, of which `mask` is the emission_mask(), as their alpha; as
/// large as color_with_occlusion() makes it, all filtered in linear light.
[[nodiscard]] Image color_with_emission(const Image& color, const Image& emission, const glm::vec3& mask);

/// Least channels that hold an image of data: 1 when r = g = b and alpha is 255, 4 otherwise.
[[nodiscard]] int channels_needed(const Image& image);

/// True when an alpha is not 255.
[[nodiscard]] bool has_alpha(const Image& image);

/// DXT1 blocks of an image, or DXT5 ones with its alpha. Rows and columns past the edge repeat it.
struct CompressedImage {
    int width = 0;
    int height = 0;
    bool has_alpha = false;  ///< DXT5, 16 bytes a block of 4x4 texels; else DXT1, 8 bytes
    std::vector<std::uint8_t> blocks;
};
[[nodiscard]] CompressedImage compressed(const Image& image, bool with_alpha);
/// What its blocks take [bytes].
[[nodiscard]] std::size_t compressed_bytes(int width, int height, bool with_alpha);
[[nodiscard]] Image decompressed(const CompressedImage& image);
/// Of the colours, in display codes of 0..255: root of the mean square, and the worst.
struct TexelError {
    double rms_codes = 0.0;
    double worst_codes = 0.0;
};
[[nodiscard]] TexelError texel_error(const Image& exact, const Image& stored);

}  // namespace halfframe
