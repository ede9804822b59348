// Reduces, packs and compresses images.
#include "engine/frame/texture_storage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

#include "engine/error.h"

#define STB_DXT_STATIC
#define STB_DXT_IMPLEMENTATION
#include <stb/stb_dxt.h>

namespace halfframe {

namespace {

using Texel = std::array<float, 4>;

const std::array<float, 256>& linear_table() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> made{};
        for (std::size_t i = 0; i < made.size(); ++i) {
            const double s = static_cast<double>(i) / 255.0;
            made[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
        }
        return made;
    }();
    return table;
}

/// The code whose light is nearest in code space: found among the midpoints between codes.
std::uint8_t code_of_light(float light) {
    static const std::array<float, 255> borders = [] {
        std::array<float, 255> made{};
        for (std::size_t i = 0; i < made.size(); ++i) {
            const double s = (static_cast<double>(i) + 0.5) / 255.0;
            made[i] = static_cast<float>(s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4));
        }
        return made;
    }();
    return static_cast<std::uint8_t>(std::upper_bound(borders.begin(), borders.end(), light) - borders.begin());
}

std::uint8_t unorm8(float x) { return static_cast<std::uint8_t>(std::lround(std::clamp(x, 0.0f, 1.0f) * 255.0f)); }

float snorm(std::uint8_t code) { return static_cast<float>(code) * (2.0f / 255.0f) - 1.0f; }
std::uint8_t code_of_snorm(float x) { return unorm8(x * 0.5f + 0.5f); }

/// A texel as numbers that may be added up; packed_surface has five, so its z comes from x and y.
struct Sum {
    Texel texel{};
    float z = 0.0f;
};

void add(Sum& sum, const std::uint8_t* from, TexelKind kind, float weight) {
    switch (kind) {
        case TexelKind::color:
            for (std::size_t c = 0; c < 3; ++c) sum.texel[c] += weight * linear_table()[from[c]];
            sum.texel[3] += weight * static_cast<float>(from[3]);
            return;
        case TexelKind::data:
        case TexelKind::normal:
            for (std::size_t c = 0; c < 4; ++c) sum.texel[c] += weight * static_cast<float>(from[c]);
            return;
        case TexelKind::packed_surface: {
            const float x = snorm(from[0]), y = snorm(from[1]);
            sum.texel[0] += weight * x;
            sum.texel[1] += weight * y;
            sum.z += weight * std::sqrt(std::max(1.0f - x * x - y * y, 0.0f));
            for (std::size_t c = 2; c < 4; ++c) sum.texel[c] += weight * static_cast<float>(from[c]);
            return;
        }
    }
    throw Mistake("a kind of texel without a sum");
}

std::uint8_t rounded(float x) { return static_cast<std::uint8_t>(std::clamp(x + 0.5f, 0.0f, 255.0f)); }

void store(const Sum& sum, std::uint8_t* to, TexelKind kind) {
    for (std::size_t c = 0; c < 4; ++c) to[c] = rounded(sum.texel[c]);
    if (kind == TexelKind::color) {
        for (std::size_t c = 0; c < 3; ++c) to[c] = code_of_light(sum.texel[c]);
    } else if (kind == TexelKind::normal) {
        Texel n{};
        for (std::size_t c = 0; c < 3; ++c) n[c] = sum.texel[c] * (2.0f / 255.0f) - 1.0f;
        const float length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        if (length < 1e-3f) return;  // normals that cancel have no mean
        for (std::size_t c = 0; c < 3; ++c) to[c] = code_of_snorm(n[c] / length);
    } else if (kind == TexelKind::packed_surface) {
        const float x = sum.texel[0], y = sum.texel[1];
        const float length = std::max(std::sqrt(x * x + y * y + sum.z * sum.z), 1e-3f);
        to[0] = code_of_snorm(x / length);
        to[1] = code_of_snorm(y / length);
    }
}

/// Of `image` where the texel x, y of `out` is. Bilinear, repeating: a texture that does not repeat is not read past its
/// edge.
Sum sampled(const Image& image, const Image& out, int x, int y, TexelKind kind) {
    const float sx = (static_cast<float>(x) + 0.5f) * static_cast<float>(image.width) / static_cast<float>(out.width);
    const float sy = (static_cast<float>(y) + 0.5f) * static_cast<float>(image.height) / static_cast<float>(out.height);
    const float fx = std::floor(sx - 0.5f), fy = std::floor(sy - 0.5f);
    Sum sum;
    for (int corner = 0; corner < 4; ++corner) {
        const int dx = corner & 1, dy = corner >> 1;
        const float wx = sx - 0.5f - fx, wy = sy - 0.5f - fy;
        const float weight = (dx != 0 ? wx : 1.0f - wx) * (dy != 0 ? wy : 1.0f - wy);
        if (weight == 0.0f) continue;
        const int px = (static_cast<int>(fx) + dx + image.width) % image.width;
        const int py = (static_cast<int>(fy) + dy + image.height) % image.height;
        const std::size_t at = (static_cast<std::size_t>(py) * static_cast<std::size_t>(image.width) + px) * 4;
        add(sum, image.rgba.data() + at, kind, weight);
    }
    return sum;
}

/// `color` as large as the larger of the two in each direction, with what `alpha_of` makes of `other`'s texels, 0..255.
Image with_alpha_of(const Image& color, const Image& other, TexelKind kind, auto alpha_of) {
    Image out{.name = color.name + "+" + other.name,
              .width = std::max(color.width, other.width),
              .height = std::max(color.height, other.height),
              .srgb = color.srgb,
              .rgba = {}};
    out.rgba.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height) * 4);
    std::uint8_t* to = out.rgba.data();
    for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x, to += 4) {
            store(sampled(color, out, x, y, TexelKind::color), to, TexelKind::color);
            to[3] = rounded(alpha_of(sampled(other, out, x, y, kind).texel));
        }
    }
    return out;
}

/// Of a colour, the channel that tells shares of it apart best.
glm::length_t strongest_channel(const glm::vec3& color) {
    return color.r >= color.g && color.r >= color.b ? 0 : color.g >= color.b ? 1 : 2;
}

/// In 255ths, of `whole`; nothing is a share of black.
float share_of(float light, float whole) { return whole > 0.0f ? std::min(255.0f * light / whole, 255.0f) : 0.0f; }

/// At most 2 codes of 0..255 from `code`.
bool shows_as(float light, int code) {
    return light >= linear_table()[static_cast<std::size_t>(std::max(code - 2, 0))] &&
           light <= linear_table()[static_cast<std::size_t>(std::min(code + 2, 255))];
}

/// The texels of a row or column that one of a smaller one covers, and how much of each.
struct Share {
    int first = 0;
    std::vector<float> weights;
};

std::vector<Share> shares(int from, int to) {
    std::vector<Share> all(static_cast<std::size_t>(to));
    const double scale = static_cast<double>(from) / to;
    for (int i = 0; i < to; ++i) {
        const double begin = i * scale, end = (i + 1) * scale;
        Share& share = all[static_cast<std::size_t>(i)];
        share.first = static_cast<int>(begin);
        for (int k = share.first; k < from && k < end - 1e-9; ++k) {
            const double part = std::min(end, k + 1.0) - std::max(begin, static_cast<double>(k));
            share.weights.push_back(static_cast<float>(part / scale));
        }
    }
    return all;
}

/// Alpha times `scale`, rounded: what scaled_alpha() stores.
std::uint8_t scaled(std::uint8_t alpha, double scale) {
    return static_cast<std::uint8_t>(std::min(std::lround(static_cast<double>(alpha) * scale), 255l));
}

/// Scales alpha so that `coverage` of the texels pass. The share that passes grows with the scale: halving finds it.
void keep_coverage(Image& image, float cutoff, double coverage) {
    std::array<std::size_t, 256> histogram{};
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) ++histogram[image.rgba[i]];
    const auto passing = [&](double scale) {
        std::size_t count = 0;
        for (std::size_t alpha = 0; alpha < histogram.size(); ++alpha) {
            if (scaled(static_cast<std::uint8_t>(alpha), scale) >= cutoff * 255.0f) count += histogram[alpha];
        }
        return static_cast<double>(count) / (static_cast<double>(image.rgba.size()) / 4.0);
    };
    double low = 0.0, high = 8.0;  // past 8 an alpha of 1/8 would be opaque
    for (int step = 0; step < 16; ++step) {
        const double middle = 0.5 * (low + high);
        (passing(middle) < coverage ? low : high) = middle;
    }
    // Of the two sides of the step, the one that comes nearer.
    const double best = std::abs(passing(low) - coverage) < std::abs(passing(high) - coverage) ? low : high;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) image.rgba[i] = scaled(image.rgba[i], best);
}

using Block = std::array<std::uint8_t, 64>;

Block block_at(const Image& image, int x0, int y0) {
    Block block{};
    for (int i = 0; i < 16; ++i) {
        const int x = std::min(x0 + i % 4, image.width - 1), y = std::min(y0 + i / 4, image.height - 1);
        const std::size_t from = (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + x) * 4;
        std::copy_n(image.rgba.begin() + static_cast<std::ptrdiff_t>(from), 4, block.begin() + i * 4);
    }
    return block;
}

/// The four colours of a DXT block; DXT5 knows no other order of its two.
std::array<std::array<int, 3>, 4> palette_of(const std::uint8_t* from, bool four_colors_always) {
    const int first = from[0] | from[1] << 8, second = from[2] | from[3] << 8;
    const auto expanded = [](int color) {
        const int r = color >> 11, g = color >> 5 & 63, b = color & 31;
        return std::array{r << 3 | r >> 2, g << 2 | g >> 4, b << 3 | b >> 2};
    };
    std::array<std::array<int, 3>, 4> palette{expanded(first), expanded(second)};
    for (std::size_t c = 0; c < 3; ++c) {
        const int a = palette[0][c], b = palette[1][c];
        const bool four = four_colors_always || first > second;
        palette[2][c] = four ? (2 * a + b) / 3 : (a + b) / 2;
        palette[3][c] = four ? (a + 2 * b) / 3 : 0;
    }
    return palette;
}

std::array<int, 8> alphas_of(const std::uint8_t* from) {
    std::array<int, 8> alphas{from[0], from[1]};
    const bool eight = from[0] > from[1];
    for (int i = 1; i < 7; ++i) {
        const auto at = static_cast<std::size_t>(i + 1);
        if (eight) alphas[at] = ((7 - i) * from[0] + i * from[1]) / 7;
        else alphas[at] = i < 5 ? ((5 - i) * from[0] + i * from[1]) / 5 : i == 5 ? 0 : 255;
    }
    return alphas;
}

}  // namespace

const char* name(TextureCompression compression) { return compression == TextureCompression::dxt ? "dxt" : "none"; }

TextureUse base_color_use(const Material& material, bool decoded) {
    TextureUse use{.decoded = decoded, .kind = TexelKind::color};
    if (material.alpha_mode == AlphaMode::mask && material.base_color.a > 0.0f)
        use.alpha_cutoff = std::min(material.alpha_cutoff / material.base_color.a, 1.0f);
    return use;
}

std::vector<int> levels_to_drop(const Scene& scene, std::size_t limit_bytes) {
    std::vector<std::size_t> bytes(scene.images.size(), 0);
    const bool has_water = scene.wetness || scene.puddles;  // a dry scene shows no water texture
    for (const Material& m : scene.materials) {
        for (const Texture& texture :
             {has_water ? m.water_texture : Texture{}, m.base_color_texture, m.metallic_roughness_texture, m.normal_texture, m.emissive_texture,
              m.occlusion_texture, m.specular_texture, m.specular_color_texture, m.specular_smoothness_texture}) {
            if (!texture) continue;
            const Image& image = scene.images[static_cast<std::size_t>(texture.image)];
            bytes[static_cast<std::size_t>(texture.image)] =
                static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4 * 4 / 3;
        }
    }
    std::vector<int> dropped(bytes.size(), 0);
    std::size_t total = std::accumulate(bytes.begin(), bytes.end(), std::size_t{0});
    while (total > limit_bytes) {
        const auto largest = std::ranges::max_element(bytes);
        if (largest == bytes.end() || *largest <= 4 * 4 / 3) break;
        const std::size_t less = *largest / 4;
        total -= *largest - less;
        *largest = less;
        ++dropped[static_cast<std::size_t>(largest - bytes.begin())];
    }
    return dropped;
}

Image reduced(const Image& image, int width, int height, TexelKind kind) {
    expect(width <= image.width && height <= image.height, "reduced() makes nothing larger");
    Image out{.name = image.name, .width = width, .height = height, .srgb = image.srgb, .rgba = {}};
    out.rgba.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4);
    const std::vector<Share> columns = shares(image.width, width), rows = shares(image.height, height);
    for (std::size_t y = 0; y < rows.size(); ++y) {
        for (std::size_t x = 0; x < columns.size(); ++x) {
            Sum sum;
            for (std::size_t j = 0; j < rows[y].weights.size(); ++j) {
                const std::size_t line =
                    (static_cast<std::size_t>(rows[y].first) + j) * static_cast<std::size_t>(image.width);
                for (std::size_t i = 0; i < columns[x].weights.size(); ++i) {
                    const std::size_t from = (line + static_cast<std::size_t>(columns[x].first) + i) * 4;
                    add(sum, image.rgba.data() + from, kind, rows[y].weights[j] * columns[x].weights[i]);
                }
            }
            store(sum, out.rgba.data() + (y * columns.size() + x) * 4, kind);
        }
    }
    return out;
}

double alpha_coverage(const Image& image, float alpha_cutoff) {
    std::size_t passing = 0;
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) passing += image.rgba[i] >= alpha_cutoff * 255.0f ? 1 : 0;
    return static_cast<double>(passing) / (static_cast<double>(image.rgba.size()) / 4.0);
}

void for_each_level(const Image& image, TexelKind kind, std::optional<float> alpha_cutoff,
                    const std::function<void(const Image&)>& visit) {
    visit(image);
    const double coverage = alpha_cutoff ? alpha_coverage(image, *alpha_cutoff) : 0.0;
    Image level;
    for (const Image* above = &image; above->width > 1 || above->height > 1; above = &level) {
        level = reduced(*above, std::max(above->width / 2, 1), std::max(above->height / 2, 1), kind);
        if (!alpha_cutoff) {
            visit(level);
            continue;
        }
        // On a copy: the next level is the mean of true alphas, not of scaled ones.
        Image scaled = level;
        keep_coverage(scaled, *alpha_cutoff, coverage);
        visit(scaled);
    }
}

std::vector<Image> mip_chain(Image image, TexelKind kind, std::optional<float> alpha_cutoff) {
    std::vector<Image> levels;
    levels.emplace_back();  // the image, moved here when nothing reads it any more
    for_each_level(image, kind, alpha_cutoff, [&](const Image& level) {
        if (&level != &image) levels.push_back(level);
    });
    levels.front() = std::move(image);
    return levels;
}

Image packed_surface_map(const Image& normals, const Image& metallic_roughness) {
    Image out{.name = normals.name + "+" + metallic_roughness.name,
              .width = std::max(normals.width, metallic_roughness.width),
              .height = std::max(normals.height, metallic_roughness.height),
              .srgb = false,
              .rgba = {}};
    out.rgba.resize(static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height) * 4);
    for (int y = 0; y < out.height; ++y) {
        for (int x = 0; x < out.width; ++x) {
            const Texel n = sampled(normals, out, x, y, TexelKind::data).texel;
            const Texel mr = sampled(metallic_roughness, out, x, y, TexelKind::data).texel;
            Texel v{};
            for (std::size_t c = 0; c < 3; ++c) v[c] = n[c] * (2.0f / 255.0f) - 1.0f;
            v[2] = std::max(v[2], 0.01f);  // as the shader has it: no normal looks into its surface
            const float length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
            std::uint8_t* to =
                out.rgba.data() + (static_cast<std::size_t>(y) * static_cast<std::size_t>(out.width) + x) * 4;
            to[0] = code_of_snorm(v[0] / length);
            to[1] = code_of_snorm(v[1] / length);
            to[2] = rounded(mr[2]);
            to[3] = rounded(mr[1]);
        }
    }
    return out;
}

Image color_with_occlusion(const Image& color, const Image& occlusion) {
    return with_alpha_of(color, occlusion, TexelKind::data, [](const Texel& texel) { return texel[0]; });
}

std::optional<glm::vec3> emission_mask(const Image& emission) {
    // All channels grow with the share, so that the sum of codes finds the largest.
    std::array<std::uint8_t, 3> brightest{};
    int most = 0;
    for (std::size_t i = 0; i < emission.rgba.size(); i += 4) {
        const std::uint8_t* texel = emission.rgba.data() + i;
        if (const int sum = texel[0] + texel[1] + texel[2]; sum > most) {
            most = sum;
            std::copy_n(texel, 3, brightest.begin());
        }
    }
    const auto& light = linear_table();
    const glm::vec3 mask{light[brightest[0]], light[brightest[1]], light[brightest[2]]};
    const glm::length_t strongest = strongest_channel(mask);
    const std::uint8_t* fitting = nullptr;  // the last texel looked at: what is on or off repeats itself
    for (std::size_t i = 0; i < emission.rgba.size(); i += 4) {
        const std::uint8_t* texel = emission.rgba.data() + i;
        if (fitting != nullptr && std::equal(texel, texel + 3, fitting)) continue;
        const float share = static_cast<float>(rounded(share_of(light[texel[strongest]], mask[strongest]))) / 255.0f;
        for (glm::length_t c = 0; c < 3; ++c) {
            if (!shows_as(share * mask[c], texel[c])) return std::nullopt;
        }
        fitting = texel;
    }
    return mask;
}

Image color_with_emission(const Image& color, const Image& emission, const glm::vec3& mask) {
    const glm::length_t strongest = strongest_channel(mask);
    return with_alpha_of(color, emission, TexelKind::color, [&](const Texel& texel) {
        return share_of(texel[static_cast<std::size_t>(strongest)], mask[strongest]);
    });
}

int channels_needed(const Image& image) {
    for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        const std::uint8_t* texel = image.rgba.data() + i;
        if (texel[0] != texel[1] || texel[0] != texel[2] || texel[3] != 255) return 4;
    }
    return 1;
}

bool has_alpha(const Image& image) {
    for (std::size_t i = 3; i < image.rgba.size(); i += 4) {
        if (image.rgba[i] != 255) return true;
    }
    return false;
}

std::size_t compressed_bytes(int width, int height, bool with_alpha) {
    return static_cast<std::size_t>((width + 3) / 4) * static_cast<std::size_t>((height + 3) / 4) *
           (with_alpha ? 16 : 8);
}

CompressedImage compressed(const Image& image, bool with_alpha) {
    CompressedImage out{.width = image.width, .height = image.height, .has_alpha = with_alpha, .blocks = {}};
    const std::size_t bytes = out.has_alpha ? 16 : 8;
    out.blocks.resize(compressed_bytes(image.width, image.height, with_alpha));
    std::uint8_t* to = out.blocks.data();
    for (int y = 0; y < image.height; y += 4) {
        for (int x = 0; x < image.width; x += 4, to += bytes)
            stb_compress_dxt_block(to, block_at(image, x, y).data(), out.has_alpha ? 1 : 0, STB_DXT_HIGHQUAL);
    }
    return out;
}

Image decompressed(const CompressedImage& image) {
    Image out{.width = image.width, .height = image.height, .srgb = true, .rgba = {}};
    out.rgba.resize(static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) * 4);
    const std::uint8_t* from = image.blocks.data();
    for (int y0 = 0; y0 < image.height; y0 += 4) {
        for (int x0 = 0; x0 < image.width; x0 += 4, from += image.has_alpha ? 16 : 8) {
            const std::uint8_t* colors = image.has_alpha ? from + 8 : from;
            const auto palette = palette_of(colors, image.has_alpha);
            const auto alphas = alphas_of(from);
            std::uint64_t alpha_bits = 0;
            for (int i = 0; i < 6; ++i) alpha_bits |= std::uint64_t{from[2 + i]} << (8 * i);
            for (int i = 0; i < 16; ++i) {
                const int x = x0 + i % 4, y = y0 + i / 4;
                if (x >= image.width || y >= image.height) continue;
                std::uint8_t* to =
                    out.rgba.data() + (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + x) * 4;
                const auto& color = palette[colors[4 + i / 4] >> (2 * (i % 4)) & 3];
                for (std::size_t c = 0; c < 3; ++c) to[c] = static_cast<std::uint8_t>(color[c]);
                to[3] = image.has_alpha ? static_cast<std::uint8_t>(alphas[alpha_bits >> (3 * i) & 7]) : 255;
            }
        }
    }
    return out;
}

TexelError texel_error(const Image& exact, const Image& stored) {
    expect(exact.rgba.size() == stored.rgba.size() && !exact.rgba.empty(), "two pictures of one size are compared");
    TexelError error;
    double sum = 0.0;
    for (std::size_t i = 0; i < exact.rgba.size(); ++i) {
        if (i % 4 == 3) continue;
        const double apart = std::abs(static_cast<double>(exact.rgba[i]) - static_cast<double>(stored.rgba[i]));
        sum += apart * apart;
        error.worst_codes = std::max(error.worst_codes, apart);
    }
    error.rms_codes = std::sqrt(sum / (0.75 * static_cast<double>(exact.rgba.size())));
    return error;
}

}  // namespace halfframe
