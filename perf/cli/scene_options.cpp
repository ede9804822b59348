// The options that decide what a frame of a scene is.
#include "perf/cli/scene_options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "content/content.h"
#include "engine/error.h"
#include "engine/frame/effect_card.h"
#include "engine/frame/pose.h"
#include "perf/cli/cache_folder.h"
#include "perf/cli/scene_fit.h"
#include "perf/cli/scene_light.h"
#include "perf/cli/scene_settings.h"
#include "perf/cli/spelling.h"

namespace halfframe::cli {
namespace {

constexpr int kLargestSize = 8192;
constexpr float kRadiansPerDegree = 0.017453293f;
constexpr float kFramedFovYRad = 40.0f * kRadiansPerDegree;

struct Size {
    int width = 0;
    int height = 0;
};

Size parse_size(const std::string& text) {
    const std::size_t cross = text.find('x');
    Size size;
    const auto number = [](std::string_view digits, int& value) {
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        return error == std::errc() && end == digits.data() + digits.size() && value >= 1 && value <= kLargestSize;
    };
    const std::string_view view = text;
    if (cross == std::string::npos || !number(view.substr(0, cross), size.width) ||
        !number(view.substr(cross + 1), size.height)) {
        throw Error(Fault::usage,
                    fmt::format("--size {}: write WIDTHxHEIGHT in pixels, each 1 to {}", text, kLargestSize));
    }
    return size;
}

Tier parse_tier(const std::string& text) {
    const auto tier = tier_from_name(text);
    if (!tier) {
        std::vector<std::string> names;
        for (int index = 0; index < kTierCount; ++index) {
            names.emplace_back(name(static_cast<Tier>(index)));
        }
        throw Error(Fault::usage, unknown("tier", text, names));
    }
    return *tier;
}

void add_tier(const std::string& text, Wishes& wishes) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) {
        wishes.tier = parse_tier(text);
        return;
    }
    const std::string effect = text.substr(0, equals);
    if (find_effect(effect) == nullptr) {
        std::vector<std::string> names;
        for (const EffectCard* card : all_effects()) {
            names.emplace_back(card->name);
        }
        throw Error(Fault::usage, unknown("effect in --tier", effect, names));
    }
    wishes.effect_tiers.emplace_back(effect, parse_tier(text.substr(equals + 1)));
}

std::optional<Arithmetic> parse_arithmetic(const std::string& text) {
    if (text == "auto") {
        return std::nullopt;
    }
    if (text == "half" || text == "full") {
        return text == "half" ? Arithmetic::half : Arithmetic::full;
    }
    throw Error(Fault::usage, unknown("arithmetic", text, {"auto", "half", "full"}));
}

std::optional<gl::PixelFormat> parse_storage(const std::string& text) {
    const std::vector<std::pair<std::string, gl::PixelFormat>> formats{{"rgba32f", gl::PixelFormat::rgba32f},
                                                                       {"rgba16f", gl::PixelFormat::rgba16f},
                                                                       {"r11g11b10f", gl::PixelFormat::r11g11b10f},
                                                                       {"rgb10_a2", gl::PixelFormat::rgb10_a2},
                                                                       {"rgba8", gl::PixelFormat::rgba8}};
    std::vector<std::string> names{"auto"};
    for (const auto& [format_name, format] : formats) {
        if (format_name == text) {
            return format;
        }
        names.push_back(format_name);
    }
    if (text != "auto") {
        throw Error(Fault::usage, unknown("storage", text, names));
    }
    return std::nullopt;
}

VertexPrecision parse_vertices(const std::string& text) {
    if (text != "half" && text != "full") throw Error(Fault::usage, unknown("vertices", text, {"half", "full"}));
    return text == "half" ? VertexPrecision::half : VertexPrecision::full;
}

std::optional<TextureCompression> parse_textures(const std::string& text) {
    if (text == "auto") return std::nullopt;
    if (text != "none" && text != "dxt") throw Error(Fault::usage, unknown("textures", text, {"auto", "none", "dxt"}));
    return text == "dxt" ? TextureCompression::dxt : TextureCompression::none;
}

Wishes parse_wishes(const SceneOptions& options) {
    Wishes wishes;
    for (const std::string& tier : options.tiers) {
        add_tier(tier, wishes);
    }
    wishes.arithmetic = parse_arithmetic(options.arithmetic);
    wishes.storage = parse_storage(options.storage);
    wishes.vertices = parse_vertices(options.vertices);
    wishes.textures = parse_textures(options.textures);
    return wishes;
}

const Camera& camera_named(const Scene& scene, const std::string& wished) {
    std::vector<std::string> names;
    for (std::size_t index = 0; index < scene.cameras.size(); ++index) {
        const Camera& camera = scene.cameras[index];
        if (camera.name == wished || std::to_string(index) == wished) {
            return camera;
        }
        names.push_back(camera.name.empty() ? std::to_string(index) : camera.name);
    }
    if (names.empty()) {
        throw Error(Fault::usage,
                    fmt::format("--camera {}: this scene brings no camera; leave it out to frame the model, "
                                "or give --eye and --target",
                                wished));
    }
    throw Error(Fault::usage, unknown("camera", wished, names));
}

/// The animation that the options play; -1: none, the rest pose.
int chosen_animation(const Scene& scene, const SceneOptions& options) {
    if (options.animation.empty() && !options.time_s) return -1;
    if (scene.animations.empty()) {
        throw Error(Fault::usage, fmt::format("{}: this scene has no animation; leave it out",
                                              options.animation.empty() ? "--time" : "--animation"));
    }
    if (options.animation.empty()) return 0;
    std::vector<std::string> names;
    for (std::size_t index = 0; index < scene.animations.size(); ++index) {
        if (scene.animations[index].name == options.animation) return static_cast<int>(index);
        names.push_back(scene.animations[index].name);
    }
    int number = 0;
    const char* end = options.animation.data() + options.animation.size();
    const auto [stop, error] = std::from_chars(options.animation.data(), end, number);
    if (error == std::errc() && stop == end && number >= 0 && static_cast<std::size_t>(number) < names.size())
        return number;
    throw Error(Fault::usage, unknown("animation", options.animation, names));
}

/// Poses the scene as the options say and returns the box of all frames together [m].
Box posed_for(OpenedScene& opened, const SceneOptions& options, const Sequence& sequence) {
    Scene& scene = opened.scene;
    opened.animation = chosen_animation(scene, options);
    if (opened.animation < 0) return world_box(scene);
    // As many poses as tell a course from a still; between two of them nothing goes far.
    constexpr int kMostPoses = 32;
    Animator animator(scene);
    Box box;
    const int poses = std::min(sequence.frames, kMostPoses);
    for (int pose = poses - 1; pose >= 0; --pose) {
        const int frame = poses == 1 ? 0 : pose * (sequence.frames - 1) / (poses - 1);
        animator.pose(scene, opened.animation, options.time_s.value_or(0.0) + frame / sequence.fps);
        const Box here = world_box(scene);
        if (here.empty()) continue;
        box.add(here.low);
        box.add(here.high);
    }
    return box;
}

Camera choose_camera(OpenedScene& opened, const SceneOptions& options, const Size& size, const Box& box) {
    Scene& scene = opened.scene;
    const float aspect = static_cast<float>(size.width) / static_cast<float>(size.height);
    const float fov_y_rad =
        options.fov_y_deg ? static_cast<float>(*options.fov_y_deg) * kRadiansPerDegree : kFramedFovYRad;
    if (!options.eye.empty()) {
        const glm::vec3 eye = parse_triple(options.eye, "--eye");
        const glm::vec3 target = parse_triple(options.target, "--target");
        return camera_looking(eye, target, fov_y_rad, box);
    }
    if (options.camera.empty() && scene.cameras.empty()) {
        scene.notices.push_back("the scene brings no camera, so it is framed whole; --eye and --target choose a view");
        return camera_framing(box, aspect, fov_y_rad);
    }
    const Camera& chosen = options.camera.empty() ? scene.cameras.front() : camera_named(scene, options.camera);
    opened.camera = static_cast<int>(&chosen - scene.cameras.data());
    Camera camera = chosen;
    if (options.fov_y_deg) {
        camera.fov_y_rad = fov_y_rad;
    }
    return camera;
}

}  // namespace

void add_scene_options(CLI::App& command, SceneOptions& options) {
    command
        .add_option("--size", options.size,
                    "Width and height of the picture [pixels], each 1 to 8192 and within the device")
        ->type_name("WxH")
        ->capture_default_str();
    command
        .add_option("--tier", options.tiers,
                    "Quality: low, console or reference, of everything or (EFFECT=TIER) of one effect; repeatable. "
                    "Default: console where it runs, else low")
        ->type_name("TIER|EFFECT=TIER")
        ->allow_extra_args(false);
    command
        .add_option("--arithmetic", options.arithmetic,
                    "Precision of shaders: half (mediump where they allow it), full (highp), auto: full on a software "
                    "driver, half elsewhere")
        ->type_name("NAME")
        ->capture_default_str();
    command
        .add_option(
            "--storage", options.storage,
            "Format of scene_color: rgba32f, rgba16f, r11g11b10f, rgb10_a2, rgba8, or auto: the highest that the "
            "tier and the device allow; at console rgba8 where no pass needs light stored")
        ->type_name("FORMAT")
        ->capture_default_str();
    command
        .add_option("--vertices", options.vertices,
                    "Bits of vertices: half (16 and 8, where the error stays below its limit) or full (32)")
        ->type_name("NAME")
        ->capture_default_str();
    command
        .add_option("--textures", options.textures,
                    "Compression of colour textures: none, dxt (DXT1 and DXT5), or auto: what the device profile says, "
                    "else none")
        ->type_name("NAME")
        ->capture_default_str();
    command
        .add_option("--environment", options.environment,
                    "Surroundings that light the scene and show in it: studio, night_sky, an equirectangular .hdr or "
                    ".exr file, or none. Default: the scene's own")
        ->type_name("NAME|FILE");
    command
        .add_option("--cache", options.cache,
                    "Folder for program binaries and filtered environments, or none. Default: "
                    "$XDG_CACHE_HOME/halfframe or ~/.cache/halfframe")
        ->type_name("DIR|none");
    add_device_options(command, options.device);
    command
        .add_option("--gltf-scene", options.gltf_scene,
                    "Scene of a file that has several, by name, or by number from 0. Default: the file's own")
        ->type_name("NAME|N");
    command
        .add_option("--variant", options.variant,
                    "Material variant of a file that has some (KHR_materials_variants), by name, or by number from 0")
        ->type_name("NAME|N");
    CLI::Option* camera = command
                              .add_option("--camera", options.camera,
                                          "Camera of the scene by name, or by number from 0. Default: the first; "
                                          "a scene without one is framed whole")
                              ->type_name("NAME|N");
    CLI::Option* eye = command.add_option("--eye", options.eye, "Where the view is from [m], +Y up; needs --target")
                           ->type_name("X,Y,Z")
                           ->excludes(camera);
    command.add_option("--target", options.target, "What is looked at [m]; needs --eye")
        ->type_name("X,Y,Z")
        ->needs(eye);
    command
        .add_option("--time", options.time_s,
                    "Show the scene as its animation has it at this time [s], which may lie past its end: it is played "
                    "round and round. Default: the rest pose, or 0 with --animation")
        ->type_name("S");
    command
        .add_option("--animation", options.animation,
                    "The animation that is played, by name, or by number from 0 (halfframe plan lists them). Default: "
                    "the first, if --time is given")
        ->type_name("NAME|N");
    command
        .add_option("--fov-y", options.fov_y_deg,
                    "Vertical field of view [degrees], above 0 and below 180. Default: the camera's, else 40")
        ->type_name("DEG");
    command
        .add_option("--seed", options.seed,
                    "Number that a built-in scene is made from, 0 to 4294967295; an error for a scene that is not. "
                    "Default: the scene's own")
        ->type_name("N");
    command
        .add_option(
            "--set", options.settings,
            "Change the scene; repeatable. exposure=N (above 0); ambient=R,G,B (linear light); sky.zenith=R,G,B, "
            "sky.horizon=R,G,B, sky.ground=R,G,B (display values 0 to 1); bloom.strength=N (0 to 1); "
            "wet.level=N, puddles.level=N (0 to 1); wet.live=0|1 (1: not written into textures); wet.rain_ended_s=N, "
            "wet.dry_s=N (all is dry so long after the rain); "
            "EFFECT.on=0|1 (in or out, whatever the scene calls for)")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command
        .add_option(
            "--fit", options.fit,
            "Choose the best tiers whose estimate fits a frame on ps3, x360 or es2_class, in milliseconds "
            "(33.3), at most those of --tier; a notice says what was given up. halfframe plan shows the estimate")
        ->type_name("DEVICE[=MS]");
}

void check_options(const SceneOptions& options) {
    (void)parse_size(options.size);
    (void)parse_wishes(options);
    (void)context_description(options.device);
    if (!options.eye.empty()) {
        if (options.target.empty()) {
            throw Error(Fault::usage, "--eye needs --target X,Y,Z, the point that is looked at");
        }
        const float away = glm::distance(parse_triple(options.eye, "--eye"), parse_triple(options.target, "--target"));
        if (!(away > 1e-6f) || !std::isfinite(away)) {
            throw Error(Fault::usage,
                        fmt::format("--eye {} and --target {} are {}, so there is no direction to look in", options.eye,
                                    options.target, away > 1.0f ? "too far apart" : "the same point"));
        }
    }
    if (options.time_s && !std::isfinite(*options.time_s)) {
        throw Error(Fault::usage, fmt::format("--time {}: not a finite number of seconds", *options.time_s));
    }
    if (options.fov_y_deg && !(*options.fov_y_deg >= 0.1 && *options.fov_y_deg <= 179.0)) {
        throw Error(Fault::usage, fmt::format("--fov-y {}: degrees from 0.1 to 179", *options.fov_y_deg));
    }
    if (!options.fit.empty()) (void)parse_fit(options.fit, Arithmetic::half);
    Scene scene;
    View view;
    Wishes wishes;
    for (const std::string& setting : options.settings) {
        apply(parse_setting(setting), scene, view, wishes);
    }
}

OpenedScene open_with_options(const std::string& scene, const SceneOptions& options, const gl::Caps& caps,
                              const std::function<void(const std::string&)>& between, const Sequence& sequence) {
    check_options(options);
    const Size size = parse_size(options.size);
    const int largest = std::min(caps.max_texture_size, caps.max_renderbuffer_size);
    if (std::max(size.width, size.height) > largest) {
        throw Error(Fault::usage, fmt::format("--size {}: the device {} draws at most {}x{}", options.size, caps.device,
                                              largest, largest));
    }
    OpenedScene opened;
    opened.scene =
        content::open_scene(scene, {.scene = options.gltf_scene, .variant = options.variant, .seed = options.seed});
    const bool is_file = scene.ends_with(".gltf") || scene.ends_with(".glb");
    opened.label = is_file ? std::filesystem::path(scene).filename().string() : scene;
    opened.wishes = parse_wishes(options);
    opened.wishes.fixed_view = sequence.frames <= 1;
    light(opened.scene, options.environment, cache_folder(options.cache), between);
    const Box box = posed_for(opened, options, sequence);
    const Camera camera = tightened(choose_camera(opened, options, size, box), box);
    opened.view = view_of(camera, size.width, size.height);
    for (const std::string& setting : options.settings) {
        apply(parse_setting(setting), opened.scene, opened.view, opened.wishes);
    }
    fit_to_budget(opened, options, caps);
    return opened;
}

std::vector<std::string> camera_names(const Scene& scene) {
    std::vector<std::string> names;
    for (std::size_t index = 0; index < scene.cameras.size(); ++index)
        names.push_back(scene.cameras[index].name.empty() ? std::to_string(index) : scene.cameras[index].name);
    return names;
}

std::string camera_name(const OpenedScene& opened) {
    return opened.camera < 0 ? std::string() : camera_names(opened.scene).at(static_cast<std::size_t>(opened.camera));
}

void wish(OpenedScene& opened, const SceneOptions& options) {
    opened.wishes = parse_wishes(options);
    for (const std::string& setting : options.settings)
        apply(parse_setting(setting), opened.scene, opened.view, opened.wishes);
}

void look_through(OpenedScene& opened, const SceneOptions& options, const std::string& camera) {
    SceneOptions chosen = options;
    chosen.camera = camera;
    const Size size = parse_size(options.size);
    const Box box = world_box(opened.scene);
    const Camera seen = tightened(choose_camera(opened, chosen, size, box), box);
    opened.view = view_of(seen, size.width, size.height);
    for (const std::string& setting : options.settings)
        apply(parse_setting(setting), opened.scene, opened.view, opened.wishes);
}

View moved_view(const OpenedScene& opened) {
    if (opened.camera < 0) return opened.view;
    const Camera& camera = opened.scene.cameras[static_cast<std::size_t>(opened.camera)];
    if (camera.node < 0) return opened.view;
    View view = opened.view;
    view.view_from_world = glm::inverse(camera.world_from_view);
    view.eye = glm::vec3(camera.world_from_view[3]);
    return view;
}

std::pair<int, int> parsed_size(const SceneOptions& options) {
    const Size size = parse_size(options.size);
    return {size.width, size.height};
}

std::string shell_quoted(const std::string& word) {
    constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=.,/:@%";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
        return word;
    }
    std::string quoted = "'";
    for (const char character : word) {
        quoted += character == '\'' ? std::string("'\\''") : std::string(1, character);
    }
    return quoted + "'";
}

std::vector<std::string> option_words(const SceneOptions& options) {
    const SceneOptions defaults;
    std::vector<std::string> words;
    const auto add = [&](const char* option, const std::string& value, const std::string& standard) {
        if (value != standard) {
            words.insert(words.end(), {option, value});
        }
    };
    add("--size", options.size, defaults.size);
    for (const std::string& tier : options.tiers) {
        add("--tier", tier, "");
    }
    add("--arithmetic", options.arithmetic, defaults.arithmetic);
    add("--storage", options.storage, defaults.storage);
    add("--vertices", options.vertices, defaults.vertices);
    add("--textures", options.textures, defaults.textures);
    add("--environment", options.environment, "");
    add("--device", options.device.device, defaults.device.device);
    add("--context", options.device.context, defaults.device.context);
    add("--gltf-scene", options.gltf_scene, "");
    add("--variant", options.variant, "");
    add("--camera", options.camera, "");
    add("--eye", options.eye, "");
    add("--target", options.target, "");
    if (options.fov_y_deg) {
        add("--fov-y", fmt::format("{}", *options.fov_y_deg), "");
    }
    if (options.time_s) {
        add("--time", fmt::format("{}", *options.time_s), "");
    }
    add("--animation", options.animation, "");
    if (options.seed) {
        add("--seed", fmt::format("{}", *options.seed), "");
    }
    for (const std::string& setting : options.settings) {
        add("--set", setting, "");
    }
    add("--fit", options.fit, "");
    return words;
}

std::string options_text(const SceneOptions& options) {
    std::string text;
    for (const std::string& word : option_words(options)) {
        text += " " + shell_quoted(word);
    }
    return text;
}

}  // namespace halfframe::cli
