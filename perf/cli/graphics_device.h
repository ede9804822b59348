// A context, its entry points and what it can do, made as the user wished.
#pragma once

#include <string>

#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "platform/context.h"

namespace CLI {
class App;
}

namespace halfframe::cli {

struct DeviceOptions {
    std::string context = "auto";
    std::string device = "native";
};

/// Adds --context and --device.
void add_device_options(CLI::App& command, DeviceOptions& options);

/// A device to imitate, by name or .json file. Error(usage|input) for one that does not exist.
[[nodiscard]] gl::DeviceProfile device_mask(const std::string& device);

/// Error(usage) for a context that does not exist by name; devices are checked when they are opened.
[[nodiscard]] platform::ContextDescription context_description(const DeviceOptions& options);

/// Current from construction on. What the mask does not grant is refused by the entry points.
class GraphicsDevice {
public:
    /// platform::ContextError when no context starts; Error(usage|input) for a device that does not exist.
    /// What `auto` tried first and did not get is told as notices.
    explicit GraphicsDevice(const DeviceOptions& options);
    GraphicsDevice(const GraphicsDevice&) = delete;
    GraphicsDevice& operator=(const GraphicsDevice&) = delete;

    [[nodiscard]] const platform::Context& context() const { return context_; }
    [[nodiscard]] gl::EntryPoints& gl() { return gl_; }
    [[nodiscard]] const gl::Caps& caps() const { return caps_; }

private:
    gl::DeviceProfile profile_;
    platform::Context context_;
    gl::EntryPoints gl_;
    gl::Caps caps_;
};

}  // namespace halfframe::cli
