// Uploads textures with all their levels.
#include <algorithm>
#include <bit>

#include <fmt/format.h>

#include "engine/error.h"
#include "engine/frame/uploads.h"

namespace halfframe {

namespace {

bool is_power_of_two(int x) { return std::has_single_bit(static_cast<unsigned>(x)); }
int power_of_two_below(int x) { return static_cast<int>(std::bit_floor(static_cast<unsigned>(x))); }

GLint wrap_of(Wrap mode) {
    return mode == Wrap::repeat ? GL_REPEAT : mode == Wrap::clamp ? GL_CLAMP_TO_EDGE : GL_MIRRORED_REPEAT;
}

GLint minify_filter(const Texture& texture) {
    const Minify minify = texture.minify.value_or(Minify{.linear = texture.linear, .between = texture.linear});
    if (!texture.mipmaps) return minify.linear ? GL_LINEAR : GL_NEAREST;
    if (minify.between) return minify.linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_LINEAR;
    return minify.linear ? GL_LINEAR_MIPMAP_NEAREST : GL_NEAREST_MIPMAP_NEAREST;
}

void set_sampling(gl::EntryPoints& gl, const Texture& texture) {
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, wrap_of(texture.wrap_u));
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, wrap_of(texture.wrap_v));
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, texture.linear ? GL_LINEAR : GL_NEAREST);
    gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, minify_filter(texture));
}

}  // namespace

Image fitted(const Image& image, int max_size, bool power_of_two, TexelKind kind) {
    Image out = image;
    while (out.width > max_size || out.height > max_size)
        out = reduced(out, std::max(out.width / 2, 1), std::max(out.height / 2, 1), kind);
    if (power_of_two && (!is_power_of_two(out.width) || !is_power_of_two(out.height)))
        out = reduced(out, power_of_two_below(out.width), power_of_two_below(out.height), kind);
    return out;
}

void TextureStore::fit(const Scene& scene, std::vector<std::string>& notices) {
    if (!caps_.max_texture_bytes) return;
    dropped_levels_ = levels_to_drop(scene, *caps_.max_texture_bytes);
    const auto count = std::ranges::count_if(dropped_levels_, [](int levels) { return levels > 0; });
    if (count > 0) {
        notices.push_back(fmt::format("{} of {} images lose their largest levels: {} has room for {} bytes of textures",
                                      count, scene.images.size(), caps_.device, *caps_.max_texture_bytes));
    }
}

const Image& TextureStore::image_of(const Scene& scene, const Texture& texture) const {
    const auto index = static_cast<std::size_t>(texture.image);
    return index < scene.images.size() ? scene.images[index] : more_images_[index - scene.images.size()];
}

std::optional<glm::vec3> TextureStore::mask_of(const Scene& scene, const Texture& emission) {
    const auto [found, is_new] = masks_.try_emplace(emission.image);
    if (is_new) found->second = emission_mask(image_of(scene, emission));
    return found->second;
}

// The image of the scene itself where it is small enough, else `made`: a copy of a large one would not fit beside it.
const Image& TextureStore::fitted_image(const Scene& scene, const Texture& texture, TexelKind kind,
                                        std::vector<std::string>& notices, Image& made) const {
    auto index = static_cast<std::size_t>(texture.image);
    const Image& source = image_of(scene, texture);
    if (index >= scene.images.size())
        index = static_cast<std::size_t>(instead_of_[index - scene.images.size()]);  // -1: past every image
    const bool needs_power_of_two =
        !caps_.npot_textures && (texture.mipmaps || texture.wrap_u != Wrap::clamp || texture.wrap_v != Wrap::clamp);
    int most = caps_.max_texture_size;
    if (index < dropped_levels_.size())
        most = std::min(most, std::max(std::max(source.width, source.height) >> dropped_levels_[index], 1));
    const bool fits = source.width <= most && source.height <= most &&
                      (!needs_power_of_two || (is_power_of_two(source.width) && is_power_of_two(source.height)));
    if (fits) return source;
    made = fitted(source, most, needs_power_of_two, kind);
    notices.push_back(fmt::format("texture {} is {}x{} texels and was made {}x{} for {}", source.name, source.width,
                                  source.height, made.width, made.height, caps_.device));
    return made;
}

std::uint32_t TextureStore::get(const Scene& scene, const Texture& texture, const TextureUse& use,
                                std::vector<std::string>& notices) {
    const auto found = std::ranges::find_if(entries_, [&](const Entry& entry) {
        return entry.texture == texture && entry.packed_with < 0 && entry.use == use;
    });
    if (found != entries_.end()) return found->object.name();
    Image made;
    return upload(fitted_image(scene, texture, use.kind, notices, made), texture, use, -1);
}

std::uint32_t TextureStore::get_packed(const Scene& scene, const Texture& first, const Texture& second,
                                       const TextureUse& use, std::vector<std::string>& notices) {
    const auto found = std::ranges::find_if(entries_, [&](const Entry& entry) {
        return entry.texture == first && entry.packed_with == second.image && entry.use == use;
    });
    if (found != entries_.end()) return found->object.name();
    const bool of_surface = use.kind == TexelKind::packed_surface;
    Image made_one, made_other;
    const Image& one = fitted_image(scene, first, of_surface ? TexelKind::normal : use.kind, notices, made_one);
    const TexelKind other_kind = use.alpha_emits ? TexelKind::color : TexelKind::data;
    const Image& other = fitted_image(scene, second, other_kind, notices, made_other);
    const auto packed = [&] {
        if (of_surface) return packed_surface_map(one, other);
        if (!use.alpha_emits) return color_with_occlusion(one, other);
        const std::optional<glm::vec3> mask = mask_of(scene, second);
        expect(mask.has_value(), "an emission that is no mask fits no alpha");
        return color_with_emission(one, other, *mask);
    };
    return upload(packed(), first, use, second.image);
}

void TextureStore::upload_compressed(const Image& image, int level, bool with_alpha, bool decoded) {
    const CompressedImage blocks = compressed(image, with_alpha);
    const GLenum format =
        decoded ? (blocks.has_alpha ? GL_COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT : GL_COMPRESSED_SRGB_S3TC_DXT1_EXT)
                : (blocks.has_alpha ? GL_COMPRESSED_RGBA_S3TC_DXT5_EXT : GL_COMPRESSED_RGB_S3TC_DXT1_EXT);
    gl_.CompressedTexImage2D(GL_TEXTURE_2D, level, format, image.width, image.height, 0,
                             static_cast<GLsizei>(blocks.blocks.size()), blocks.blocks.data());
    bytes_ += blocks.blocks.size();
    compressed_.bytes += blocks.blocks.size();
    compressed_.bytes_plain += image.rgba.size();
    if (level == 0) {
        const TexelError error = texel_error(image, decompressed(blocks));
        ++compressed_.textures;
        compressed_.worst_rms_codes = std::max(compressed_.worst_rms_codes, error.rms_codes);
        compressed_.worst_codes = std::max(compressed_.worst_codes, error.worst_codes);
    }
}

std::string TextureStore::compression() const {
    if (compressed_.textures == 0) return {};
    return fmt::format(
        "{} textures are compressed from {} to {} bytes; the worst of them is {:.1f} display codes off "
        "(root mean square), {:.0f} at its worst texel",
        compressed_.textures, compressed_.bytes_plain, compressed_.bytes, compressed_.worst_rms_codes,
        compressed_.worst_codes);
}

void TextureStore::upload_level(const Image& image, int level, const TextureUse& use, bool one_channel) {
    if (!one_channel) {
        const auto format = gl::transfer_format(use.decoded ? gl::PixelFormat::srgb8_alpha8 : gl::PixelFormat::rgba8,
                                                !caps_.sized_formats);
        gl_.TexImage2D(GL_TEXTURE_2D, level, static_cast<GLint>(format.internal_format), image.width, image.height, 0,
                       format.format, format.type, image.rgba.data());
        bytes_ += image.rgba.size();
        return;
    }
    std::vector<std::uint8_t> grey(image.rgba.size() / 4);
    for (std::size_t i = 0; i < grey.size(); ++i) grey[i] = image.rgba[4 * i];
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_.TexImage2D(GL_TEXTURE_2D, level, GL_LUMINANCE, image.width, image.height, 0, GL_LUMINANCE, GL_UNSIGNED_BYTE,
                   grey.data());
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    bytes_ += grey.size();
}

std::uint32_t TextureStore::upload(const Image& image, const Texture& texture, const TextureUse& use, int packed_with) {
    Entry entry{texture, packed_with, use, gl::create<gl::Kind::texture>(gl_)};
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, entry.object.name());
    gl::label(gl_, entry.object, image.name.c_str());
    const bool compresses = compression_ == TextureCompression::dxt && use.kind == TexelKind::color &&
                            (use.decoded ? caps_.s3tc_srgb : caps_.s3tc);
    // Grey needs one channel, which shaders read as three. A core profile has no luminance, and nothing decodes it.
    const bool one_channel = !compresses && !use.decoded && !caps_.core_profile && channels_needed(image) == 1;
    // Made here and not by the driver: in linear light at every tier, with masks that keep their share.
    const bool with_alpha = has_alpha(image);
    int level = 0;
    const auto upload_next = [&](const Image& next) {
        if (compresses) upload_compressed(next, level, with_alpha, use.decoded);
        else upload_level(next, level, use, one_channel);
        ++level;
    };
    if (texture.mipmaps) for_each_level(image, use.kind, use.alpha_cutoff, upload_next);
    else upload_next(image);
    set_sampling(gl_, texture);
    entries_.push_back(std::move(entry));
    return entries_.back().object.name();
}

}  // namespace halfframe
