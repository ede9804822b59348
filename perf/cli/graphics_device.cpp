// A context, its entry points and what it can do.
#include "perf/cli/graphics_device.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>

#include "content/content.h"
#include "engine/error.h"
#include "perf/cli/spelling.h"
#include "perf/cli/terminal.h"

namespace halfframe::cli {

gl::DeviceProfile device_mask(const std::string& device) {
    const std::vector<std::string> names = content::device_profile_names();
    if (std::find(names.begin(), names.end(), device) == names.end() && !device.ends_with(".json")) {
        throw Error(Fault::usage, unknown("device", device, names) + ", or a .json file");
    }
    return content::device_profile(device);
}

void add_device_options(CLI::App& command, DeviceOptions& options) {
    command
        .add_option(
            "--context", options.context,
            "Back end: auto (EGL, then OSMesa, then GLFW), egl, osmesa, glfw, or desktop: a desktop GL 4.5 core "
            "context of the same driver, the one that counts fragments exactly")
        ->type_name("NAME")
        ->capture_default_str();
    command
        .add_option(
            "--device", options.device,
            fmt::format("Device to imitate: {}, or a .json file with its version, extensions and limits. A mask "
                        "only takes away",
                        fmt::join(content::device_profile_names(), ", ")))
        ->type_name("NAME|FILE")
        ->capture_default_str();
}

platform::ContextDescription context_description(const DeviceOptions& options) {
    platform::ContextDescription description;
    if (options.context == "auto") {
        return description;
    }
    if (options.context == "desktop") {
        description.api = platform::Api::desktop;
    } else if (options.context == "egl") {
        description.backend = platform::Backend::egl;
    } else if (options.context == "osmesa") {
        description.backend = platform::Backend::osmesa;
    } else if (options.context == "glfw") {
        description.backend = platform::Backend::glfw;
    } else {
        throw Error(Fault::usage, unknown("context", options.context, {"auto", "egl", "osmesa", "glfw", "desktop"}));
    }
    return description;
}

GraphicsDevice::GraphicsDevice(const DeviceOptions& options)
    : profile_(device_mask(options.device)),
      context_(platform::Context::create(context_description(options))),
      gl_(context_.loader()),
      caps_(gl::masked(gl::read_caps(gl_), profile_)) {
    gl_.restrict_to(caps_);
    for (const std::string& sentence : context_.tried()) {
        notice(sentence);
    }
}

}  // namespace halfframe::cli
