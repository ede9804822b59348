// --set KEY=VALUE.
#include "perf/cli/scene_settings.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "engine/error.h"
#include "engine/frame/effect_card.h"
#include "perf/cli/spelling.h"

namespace halfframe::cli {
namespace {

std::vector<std::string> setting_keys() {
    std::vector<std::string> keys{"exposure", "ambient", "sky.zenith", "sky.horizon", "sky.ground", "bloom.strength",
                                  "wet.level",  "wet.live",  "wet.rain_ended_s", "wet.dry_s", "puddles.level"};
    for (const EffectCard* card : all_effects()) {
        keys.push_back(std::string(card->name) + ".on");
    }
    return keys;
}

glm::vec3 parse_color(const Setting& setting) {
    const glm::vec3 color = parse_triple(setting.value, "--set " + setting.key);
    if (std::min({color.r, color.g, color.b}) < 0.0f) {
        throw Error(Fault::usage, fmt::format("--set {}={}: light is never negative", setting.key, setting.value));
    }
    return color;
}

}  // namespace

float parse_number(const std::string& text, const std::string& what) {
    float value = 0.0f;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
        throw Error(Fault::usage, fmt::format("{}: '{}' is not a finite number", what, text));
    }
    return value;
}

glm::vec3 parse_triple(const std::string& text, const std::string& what) {
    const std::size_t first = text.find(',');
    const std::size_t second = first == std::string::npos ? first : text.find(',', first + 1);
    if (second == std::string::npos || text.find(',', second + 1) != std::string::npos) {
        throw Error(Fault::usage, fmt::format("{}: '{}' is not three numbers X,Y,Z", what, text));
    }
    return {parse_number(text.substr(0, first), what), parse_number(text.substr(first + 1, second - first - 1), what),
            parse_number(text.substr(second + 1), what)};
}

Setting parse_setting(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
        throw Error(Fault::usage, fmt::format("--set {}: write KEY=VALUE, for example exposure=0.5", text));
    }
    Setting setting{.key = text.substr(0, equals), .value = text.substr(equals + 1)};
    const std::vector<std::string> keys = setting_keys();
    if (std::find(keys.begin(), keys.end(), setting.key) == keys.end()) {
        throw Error(Fault::usage, unknown("--set key", setting.key, keys));
    }
    return setting;
}

namespace {

float parse_share(const Setting& setting) {
    const float share = parse_number(setting.value, "--set " + setting.key);
    if (share < 0.0f || share > 1.0f)
        throw Error(Fault::usage, fmt::format("--set {}={}: it is 0 to 1", setting.key, setting.value));
    return share;
}

void apply_wetness(const Setting& setting, Scene& scene) {
    Wetness wetness = scene.wetness.value_or(Wetness{.level = 0.0f});
    if (setting.key == "wet.level") {
        wetness.level = parse_share(setting);
    } else if (setting.key == "wet.live") {
        if (setting.value != "0" && setting.value != "1")
            throw Error(Fault::usage, fmt::format("--set {}={}: write 0 or 1", setting.key, setting.value));
        wetness.is_static = setting.value == "0";
    } else {
        const float seconds = parse_number(setting.value, "--set " + setting.key);
        const bool is_drying = setting.key == "wet.dry_s";
        if (seconds < 0.0f || (is_drying && seconds < 0.1f)) {
            throw Error(Fault::usage, fmt::format("--set {}={}: it must be at least {}", setting.key, setting.value,
                                                  is_drying ? "0.1" : "0"));
        }
        if (is_drying) wetness.dry_s = seconds;
        else wetness.since_s = seconds;
    }
    scene.wetness = wetness;
}

}  // namespace

void apply(const Setting& setting, Scene& scene, View& view, Wishes& wishes) {
    if (setting.key == "exposure") {
        view.exposure = parse_number(setting.value, "--set exposure");
        if (view.exposure <= 0.0f) {
            throw Error(Fault::usage, fmt::format("--set exposure={}: it must be above 0", setting.value));
        }
    } else if (setting.key == "ambient") {
        scene.ambient = parse_color(setting);
    } else if (setting.key == "bloom.strength") {
        const float strength = parse_number(setting.value, "--set bloom.strength");
        if (strength < 0.0f || strength > 1.0f)
            throw Error(Fault::usage, fmt::format("--set bloom.strength={}: it is 0 to 1", setting.value));
        scene.bloom = Bloom{.strength = strength};
    } else if (setting.key == "puddles.level") {
        scene.puddles = Puddles{.level = parse_share(setting)};
    } else if (setting.key.starts_with("wet.")) {
        apply_wetness(setting, scene);
    } else if (setting.key.starts_with("sky.") && setting.key != "sky.on") {
        const glm::vec3 color = parse_color(setting);
        if (glm::any(glm::greaterThan(color, glm::vec3(1.0f)))) {
            throw Error(Fault::usage,
                        fmt::format("--set {}={}: display values are 0 to 1", setting.key, setting.value));
        }
        Sky sky = scene.sky.value_or(Sky{});
        (setting.key == "sky.zenith" ? sky.zenith : setting.key == "sky.horizon" ? sky.horizon : sky.ground) = color;
        scene.sky = sky;
    } else {
        const std::string effect = setting.key.substr(0, setting.key.size() - 3);
        if (setting.value != "0" && setting.value != "1") {
            throw Error(Fault::usage, fmt::format("--set {}={}: write 0 or 1", setting.key, setting.value));
        }
        wishes.effect_switches.emplace_back(effect, setting.value == "1");
    }
}

}  // namespace halfframe::cli
