// The options that decide what a frame of a scene is, shared by render, report and plan.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/frame/frame_plan.h"
#include "engine/frame/scene.h"
#include "perf/cli/graphics_device.h"

namespace CLI {
class App;
}

namespace halfframe::cli {

struct SceneOptions {
    DeviceOptions device;
    std::string size = "1280x720";
    std::vector<std::string> tiers;
    std::string arithmetic = "auto";
    std::string storage = "auto";
    std::string vertices = "half";
    std::string textures = "auto";
    std::string environment;  ///< empty: the scene's own
    std::string cache;        ///< empty: the user's cache folder
    std::string gltf_scene;
    std::string variant;
    std::string camera;
    std::string eye;
    std::string target;
    std::optional<double> fov_y_deg;
    std::optional<double> time_s;       ///< empty and no animation: the rest pose
    std::string animation;              ///< name or number; empty: the first, if a time is given
    std::optional<std::uint32_t> seed;  ///< empty: the scene's own, if it is made from one
    std::vector<std::string> settings;
    std::string fit;  ///< "ps3=33.3": tiers that fit; empty: as wished
};

/// Adds the options to a subcommand; `options` outlives it.
void add_scene_options(CLI::App& command, SceneOptions& options);

/// A scene with a camera and lights, and how it is to be drawn.
struct OpenedScene {
    std::string label;  ///< file name or built-in name, for people
    Scene scene;
    View view;
    Wishes wishes;
    int animation = -1;  ///< of the scene, posed at the time of the options; -1: the rest pose
    int camera = -1;     ///< of the scene; -1: the view was made for its box
};

/// A row of pictures: each this much later than the one before it.
struct Sequence {
    int frames = 1;
    double fps = 30.0;
};

/// Checks every option before the scene is opened: Error(usage) with the nearest spelling. Loads the scene, frames it
/// when it brings no camera, lights it with the studio rig when it brings no lights; both leave a notice in the scene.
/// The view holds the scene in every frame of `sequence`. A size above what `caps` allows is Error(usage). `between`
/// hears a word for the user from time to time and throws to stop.
[[nodiscard]] OpenedScene open_with_options(const std::string& scene, const SceneOptions& options, const gl::Caps& caps,
                                            const std::function<void(const std::string&)>& between,
                                            const Sequence& sequence = {});

/// The name of the camera that the view is of; its number where it has none; empty where it is not the scene's.
[[nodiscard]] std::string camera_name(const OpenedScene& opened);

/// Every camera of the scene by name, or by number.
[[nodiscard]] std::vector<std::string> camera_names(const Scene& scene);

/// Wishes anew what the options wish: their tiers may have changed.
void wish(OpenedScene& opened, const SceneOptions& options);

/// The same scene seen by another of its cameras; Error(usage) with the nearest for one that it does not have.
void look_through(OpenedScene& opened, const SceneOptions& options, const std::string& camera);

/// The view of an opened scene after it was posed: its camera may have moved.
[[nodiscard]] View moved_view(const OpenedScene& opened);

/// Error(usage) for anything in the options that can be seen to be wrong without a context or a scene.
void check_options(const SceneOptions& options);

/// {"--size", "64x64", "--tier", "low"}: the options that differ from the defaults, as a child process takes them.
[[nodiscard]] std::vector<std::string> option_words(const SceneOptions& options);
/// Width and height of --size; Error(usage) as above.
[[nodiscard]] std::pair<int, int> parsed_size(const SceneOptions& options);

/// " --size 64x64 --tier low": the options that differ from the defaults, quoted for a shell.
[[nodiscard]] std::string options_text(const SceneOptions& options);
[[nodiscard]] std::string shell_quoted(const std::string& word);

}  // namespace halfframe::cli
