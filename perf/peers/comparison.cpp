// Medians, interleaving, refusals.
#include "perf/peers/comparison.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "engine/error.h"

namespace halfframe::peers {
namespace {

double quantile(const std::vector<double>& sorted, double share) {
    const double place = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(place);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (place - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

Spread spread(std::vector<double> values) {
    expect(!values.empty(), "a spread of no values");
    std::ranges::sort(values);
    return {.median = quantile(values, 0.5), .low = quantile(values, 0.25), .high = quantile(values, 0.75)};
}

Spread ratio(const std::vector<double>& a, const std::vector<double>& b) {
    expect(a.size() == b.size(), "rounds of two peers differ in number");
    std::vector<double> ratios;
    for (std::size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
    return spread(std::move(ratios));
}

std::vector<int> order_of_round(int count, int round) {
    std::vector<int> order;
    for (int i = 0; i < count; ++i) order.push_back((i + round / 2) % count);
    if (round % 2 == 1) std::ranges::reverse(order);
    return order;
}

int frames_for(double frame_ms, double batch_ms) {
    return std::clamp(static_cast<int>(std::ceil(batch_ms / std::max(frame_ms, 1e-3))), 2, 400);
}

std::optional<std::string> refused_driver(std::string_view peer, std::string_view driver) {
    if (driver.find("llvmpipe") != std::string_view::npos) return std::nullopt;
    const bool is_swiftshader = driver.find("SwiftShader") != std::string_view::npos;
    return fmt::format("{} draws with \"{}\" and not with Mesa's llvmpipe, so its times say nothing here{}", peer,
                       driver,
                       is_swiftshader ? "; SwiftShader is Chromium's own software driver: it takes over when Mesa's "
                                        "EGL does not start (is libegl-mesa0 installed?)"
                                      : "; is LIBGL_ALWAYS_SOFTWARE=1 respected, and libgl1-mesa-dri installed?");
}

std::vector<bool> cover(const Picture& picture, const glm::vec3& background) {
    // 2/255: the background is stored and encoded differently by each peer (half floats, tone curves), exact at 0 and 1
    // up to one step of rounding.
    constexpr int kRounding = 2;
    std::vector<bool> mask(picture.rgba.size() / 4);
    for (std::size_t i = 0; i < mask.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            const int stored = picture.rgba[4 * i + static_cast<std::size_t>(channel)];
            if (std::abs(stored - static_cast<int>(std::lround(background[channel] * 255.0f))) > kRounding) {
                mask[i] = true;
            }
        }
    }
    return mask;
}

double fraction(const std::vector<bool>& mask) {
    return mask.empty() ? 0.0 : static_cast<double>(std::ranges::count(mask, true)) / static_cast<double>(mask.size());
}

double overlap(const std::vector<bool>& a, const std::vector<bool>& b) {
    expect(a.size() == b.size(), "pictures of two sizes");
    std::size_t both = 0, either = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        both += a[i] && b[i] ? 1 : 0;
        either += a[i] || b[i] ? 1 : 0;
    }
    return either == 0 ? 0.0 : static_cast<double>(both) / static_cast<double>(either);
}

double mean_brightness(const Picture& picture, const std::vector<bool>& mask) {
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < mask.size(); ++i) {
        if (!mask[i]) continue;
        sum += picture.rgba[4 * i] + picture.rgba[4 * i + 1] + picture.rgba[4 * i + 2];
        ++count;
    }
    return count == 0 ? 0.0 : sum / (3.0 * 255.0 * static_cast<double>(count));
}

Target target(double peer_ms, double share, double floor_ms) {
    const double from_peer = share * peer_ms;
    const double from_floor = 1.5 * floor_ms;
    return {.ms = std::max(from_peer, from_floor), .by_floor = from_floor > from_peer};
}

void encode_srgb(Picture& picture) {
    for (std::size_t i = 0; i < picture.rgba.size(); ++i) {
        if (i % 4 == 3) continue;
        const double linear = picture.rgba[i] / 255.0;
        const double encoded = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
        picture.rgba[i] = static_cast<std::uint8_t>(std::lround(encoded * 255.0));
    }
}

void flip(Picture& picture) {
    const std::size_t row = 4 * static_cast<std::size_t>(picture.width);
    for (int y = 0; y < picture.height / 2; ++y) {
        const auto top = picture.rgba.begin() + static_cast<std::ptrdiff_t>(row) * y;
        const auto bottom = picture.rgba.begin() + static_cast<std::ptrdiff_t>(row) * (picture.height - 1 - y);
        std::swap_ranges(top, top + static_cast<std::ptrdiff_t>(row), bottom);
    }
}

}  // namespace halfframe::peers
