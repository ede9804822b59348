// Pins, opens, masks.
#include "perf/cli/counting_device.h"

#include <cstdlib>

#include "perf/cli/graphics_device.h"

namespace halfframe::cli {
namespace {

/// With AVX2 and FMA the driver rounds vertices otherwise than with SSE2, and a triangle's edge may take another pixel.
/// Its cache does not tell the two apart, so it has one of its own.
platform::ContextDescription pinned(const std::filesystem::path& cache) {
    ::setenv("GALLIUM_OVERRIDE_CPU_CAPS", "sse2", 1);
    std::error_code failed;
    if (!cache.empty()) std::filesystem::create_directories(cache / "counting", failed);
    if (cache.empty() || failed) {
        ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    } else {
        ::setenv("MESA_SHADER_CACHE_DIR", (cache / "counting").c_str(), 1);
    }
    return context_description({.context = "desktop", .device = "native"});
}

}  // namespace

CountingDevice::CountingDevice(const std::string& device, const std::filesystem::path& cache)
    : profile_(device_mask(device)),
      context_(platform::Context::create(pinned(cache))),
      recorder_(context_.loader()),
      gl_(recorder_.loader()),
      caps_(gl::masked(gl::read_caps(gl_), profile_)) {
    gl_.restrict_to(caps_);
}

}  // namespace halfframe::cli
