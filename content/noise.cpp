// Value noise on a lattice that repeats.
#include "content/noise.h"

namespace halfframe::content {

float smooth_noise(float x, float y, int period, std::uint32_t seed) {
    const float floor_x = std::floor(x);
    const float floor_y = std::floor(y);
    const auto wrapped = [period](float at) {
        const int i = static_cast<int>(at) % period;
        return i < 0 ? i + period : i;
    };
    const int x0 = wrapped(floor_x);
    const int y0 = wrapped(floor_y);
    const int x1 = x0 + 1 == period ? 0 : x0 + 1;
    const int y1 = y0 + 1 == period ? 0 : y0 + 1;
    float tx = x - floor_x;
    float ty = y - floor_y;
    tx = tx * tx * (3.0f - 2.0f * tx);
    ty = ty * ty * (3.0f - 2.0f * ty);
    const float top = hash_noise(x0, y0, seed) * (1.0f - tx) + hash_noise(x1, y0, seed) * tx;
    const float bottom = hash_noise(x0, y1, seed) * (1.0f - tx) + hash_noise(x1, y1, seed) * tx;
    return top * (1.0f - ty) + bottom * ty;
}

float layered_noise(float u, float v, int cells, int octaves, std::uint32_t seed) {
    float sum = 0.0f;
    float height = 0.5f;
    float total = 0.0f;
    for (int octave = 0; octave < octaves; ++octave) {
        const auto knots = static_cast<float>(cells);
        sum += height * smooth_noise(u * knots, v * knots, cells, seed + static_cast<std::uint32_t>(octave) * 101u);
        total += height;
        height *= 0.5f;
        cells *= 2;
    }
    return sum / total;
}

Image blank(const std::string& name, int width, int height, bool srgb) {
    Image image;
    image.name = name;
    image.width = width;
    image.height = height;
    image.srgb = srgb;
    image.rgba.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4, 255);
    return image;
}

void set_texel(Image& image, int x, int y, const glm::vec3& codes, float alpha) {
    const std::size_t at =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
    for (int channel = 0; channel < 3; ++channel) {
        image.rgba[at + static_cast<std::size_t>(channel)] =
            static_cast<std::uint8_t>(std::clamp(codes[channel], 0.0f, 255.0f) + 0.5f);
    }
    image.rgba[at + 3] = static_cast<std::uint8_t>(255.0f * std::clamp(alpha, 0.0f, 1.0f) + 0.5f);
}

}  // namespace halfframe::content
