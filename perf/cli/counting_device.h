// A desktop context that counts, the same on every machine: vector code and shader cache of the driver are pinned.
#pragma once

#include <filesystem>
#include <string>

#include "engine/gl/caps.h"
#include "engine/gl/entry_points.h"
#include "perf/cost/draw_recorder.h"
#include "platform/context.h"

namespace halfframe::cli {

class CountingDevice {
public:
    /// Pins the driver through the environment of this process, so it must be the first context of it. `device` masks
    /// what the context can do. `cache`: where the driver may keep what it compiled; empty: nowhere.
    CountingDevice(const std::string& device, const std::filesystem::path& cache);

    [[nodiscard]] cost::DrawRecorder& recorder() { return recorder_; }
    [[nodiscard]] gl::EntryPoints& gl() { return gl_; }
    [[nodiscard]] const gl::Caps& caps() const { return caps_; }

private:
    gl::DeviceProfile profile_;
    platform::Context context_;
    cost::DrawRecorder recorder_;
    gl::EntryPoints gl_;
    gl::Caps caps_;
};

}  // namespace halfframe::cli
