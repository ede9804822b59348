// An environment by name or file: read or drawn, filtered, kept.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "content/content.h"
#include "content/environment/built_in_environments.h"
#include "content/environment/environment_cache.h"
#include "content/environment/equirectangular.h"
#include "content/environment/irradiance.h"
#include "content/environment/light_taps.h"
#include "content/environment/prefilter.h"
#include "content/json_place.h"
#include "content/nearest.h"
#include "engine/error.h"

namespace halfframe::content {
namespace {

bool is_picture(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return ending == ".hdr" || ending == ".exr";
}

const BuiltInEnvironment* built_in(const std::string& name) {
    for (const BuiltInEnvironment& environment : built_in_environments()) {
        if (environment.name == name) return &environment;
    }
    return nullptr;
}

void check_options(const EnvironmentOptions& options) {
    const int size = options.size;
    // 16: two levels have a lobe. 512: 24 times the work of 128, for lobes that 128 draws with 9 texels.
    if (size < 16 || size > 512 || (size & (size - 1)) != 0) {
        throw Error(Fault::usage,
                    fmt::format("an environment of {} texels a side: use 16, 32, 64, 128, 256 or 512", size));
    }
    if (options.threads < 0 || options.threads > 1024) {
        throw Error(Fault::usage, fmt::format("{} threads for an environment: use 1 to 1024, or 0 for as many as the "
                                              "machine has",
                                              options.threads));
    }
}

int thread_count(const EnvironmentOptions& options) {
    if (options.threads > 0) return options.threads;
    return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

StoredEnvironment filtered(const Equirectangular& picture, const EnvironmentOptions& options) {
    const Light light{light_taps(picture, kFineTaps), light_taps(picture, kCoarseTaps)};
    StoredEnvironment result;
    result.map.size = options.size;
    prefilter(light, thread_count(options), options.progress, result.map);
    const Irradiance diffuse = irradiance(light.fine);
    for (std::size_t i = 0; i < 9; ++i) result.map.irradiance[i] = glm::vec3(diffuse.terms[i]);
    if (diffuse.window > 0.0) {
        result.notices.push_back(fmt::format(
            "its light comes so much from one side that nine terms of its diffuse part would darken the other too "
            "much; it was softened (window {:.4f}, first band x {:.3f}, second x {:.3f})",
            diffuse.window, 1.0 / (1.0 + 4.0 * diffuse.window), 1.0 / (1.0 + 36.0 * diffuse.window)));
    }
    return result;
}

std::string_view bytes_of(const Equirectangular& picture) {
    return {reinterpret_cast<const char*>(picture.pixels.data()), picture.pixels.size() * sizeof(glm::vec3)};
}

/// The map as what was asked for by `asked_for`, the subject of its notices.
LoadedEnvironment named(StoredEnvironment stored, std::string name, const std::string& asked_for, bool from_cache) {
    stored.map.name = std::move(name);
    for (std::string& notice : stored.notices) notice = asked_for + ": " + notice;
    return {std::move(stored.map), std::move(stored.notices), from_cache};
}

/// What `source` (the bytes that decide the result) gives: from the cache, or made by `make`, then kept.
template <typename Make>
LoadedEnvironment kept(std::string_view source, const std::string& name, const std::string& asked_for,
                       const EnvironmentOptions& options, const Make& make) {
    if (options.cache_folder.empty()) return named(make(), name, asked_for, false);
    const std::filesystem::path file = cache_file(options.cache_folder, source, options.size);
    if (std::optional<StoredEnvironment> stored = read_cache(file, options.size))
        return named(std::move(*stored), name, asked_for, true);
    StoredEnvironment made = make();
    const std::optional<std::string> failure = write_cache(file, made);
    LoadedEnvironment result = named(std::move(made), name, asked_for, false);
    if (failure) result.notices.push_back(*failure);
    return result;
}

}  // namespace

std::vector<std::string> environment_names() {
    std::vector<std::string> names;
    for (const BuiltInEnvironment& environment : built_in_environments()) names.emplace_back(environment.name);
    return names;
}

LoadedEnvironment environment(const std::string& name_or_file, const EnvironmentOptions& options) {
    check_options(options);
    if (const BuiltInEnvironment* drawn_one = built_in(name_or_file)) {
        const Equirectangular picture = drawn(*drawn_one);
        return kept(bytes_of(picture), name_or_file, name_or_file, options, [&] { return filtered(picture, options); });
    }
    const std::filesystem::path file(name_or_file);
    if (!is_picture(file)) {
        const std::vector<std::string> names = environment_names();
        throw Error(Fault::input, fmt::format("{}: not an environment{}; there are {}, or give the path of a .hdr or "
                                              ".exr file",
                                              name_or_file, did_you_mean(name_or_file, names), fmt::join(names, ", ")));
    }
    const std::string bytes(std::string_view(read_regular_file(file, kMostPictureBytes, name_or_file)));
    // The ending says how the bytes are decoded.
    return kept(file.extension().string() + '\0' + bytes, file.stem().string(), name_or_file, options, [&] {
        std::vector<std::string> notices;
        const Equirectangular picture = decode_equirectangular(bytes, file, notices);
        StoredEnvironment result = filtered(picture, options);
        result.notices.insert(result.notices.begin(), notices.begin(), notices.end());
        return result;
    });
}

}  // namespace halfframe::content
