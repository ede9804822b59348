// OSMesa: Mesa's rasteriser drawing to plain memory. Needs no display, no device file and no EGL. Mesa 25.1 removed it.
#include <array>
#include <cstdint>

#include <GL/osmesa.h>

#include "platform/implementation.h"
#include "platform/shared_library.h"

namespace halfframe::platform {

namespace {

// .8: Mesa 12 and newer; .6: older; the plain name: other systems' packages.
constexpr const char* kNames[] = {"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
constexpr const char* kRemedy =
    "install the Debian package libosmesa6 (Mesa 25.1 and newer no longer have it: use EGL there)";

class OsmesaContext final : public Context::Implementation {
public:
    explicit OsmesaContext(const ContextDescription& description)
        : library_(SharedLibrary::open("OSMesa", kNames, kRemedy)),
          width_(description.width),
          height_(description.height),
          color_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * 4) {
        backend = Backend::osmesa;
        how = "OSMesa";
        library_.require(create_, "OSMesaCreateContextAttribs");
        library_.require(destroy_, "OSMesaDestroyContext");
        library_.require(make_current_, "OSMesaMakeCurrent");
        library_.require(current_, "OSMesaGetCurrentContext");
        library_.require(address_, "OSMesaGetProcAddress");
    }

    ~OsmesaContext() override {
        if (context_ == nullptr) return;
        if (current_() == context_) make_current_(nullptr, nullptr, 0, 0, 0);
        destroy_(context_);
    }

    /// Core profile: point sprites are always on there, as in ES. 4.5 runs `#version 100` and `300 es`; 3.3, which a
    /// Mesa without LLVM gives, runs 100 alone.
    void start() {
        for (const std::array<int, 2> version : {std::array{4, 5}, std::array{3, 3}}) {
            // clang-format off
            const int attributes[] = {OSMESA_FORMAT, OSMESA_RGBA,
                                      OSMESA_DEPTH_BITS, 24,
                                      OSMESA_STENCIL_BITS, 8,
                                      OSMESA_PROFILE, OSMESA_CORE_PROFILE,
                                      OSMESA_CONTEXT_MAJOR_VERSION, version[0],
                                      OSMESA_CONTEXT_MINOR_VERSION, version[1],
                                      0};
            // clang-format on
            context_ = create_(attributes, nullptr);
            if (context_ != nullptr) break;
        }
        if (context_ == nullptr) {
            throw ContextError(
                "OSMesa cannot start: it makes neither a GL 4.5 nor a GL 3.3 core context; "
                "install the Debian package libosmesa6 of Debian 12");
        }
        if (!bind()) {
            throw ContextError("OSMesa cannot start: it refuses a drawing buffer of " + std::to_string(width_) + "x" +
                               std::to_string(height_) + " pixels; ask for 1x1 to 16384x16384");
        }
    }

    void* function(const char* function_name) const override {
        return reinterpret_cast<void*>(address_(function_name));
    }

    void make_current() override {
        if (!bind()) throw ContextError("the context was lost (OSMesaMakeCurrent failed); make a new one");
    }

private:
    bool bind() { return make_current_(context_, color_.data(), GL_UNSIGNED_BYTE, width_, height_) != GL_FALSE; }

    SharedLibrary library_;
    decltype(&OSMesaCreateContextAttribs) create_ = nullptr;
    decltype(&OSMesaDestroyContext) destroy_ = nullptr;
    decltype(&OSMesaMakeCurrent) make_current_ = nullptr;
    decltype(&OSMesaGetCurrentContext) current_ = nullptr;
    decltype(&OSMesaGetProcAddress) address_ = nullptr;
    OSMesaContext context_ = nullptr;
    int width_;
    int height_;
    std::vector<std::uint8_t> color_;  ///< RGBA8, the default framebuffer
};

}  // namespace

std::unique_ptr<Context::Implementation> start_osmesa(const ContextDescription& description) {
    auto context = std::make_unique<OsmesaContext>(description);
    context->start();
    complete(*context);
    return context;
}

}  // namespace halfframe::platform
