// EGL: the usual way to a context without a window. Mesa's surfaceless platform, else a device, else the default
// display.
#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#define EGL_NO_X11  // no X headers for a type we never name
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "platform/implementation.h"
#include "platform/shared_library.h"

namespace halfframe::platform {

namespace {

constexpr const char* kNames[] = {"libEGL.so.1", "libEGL.so"};
constexpr const char* kEsNames[] = {"libGLESv2.so.2", "libGLESv2.so"};
constexpr const char* kDesktopNames[] = {"libOpenGL.so.0", "libGL.so.1"};
constexpr const char* kRemedy = "install the Debian package libegl1";
constexpr const char* kDriverRemedy = "install the Debian packages libegl-mesa0 and libgl1-mesa-dri";

struct EglFunctions {
    decltype(&eglGetError) get_error = nullptr;
    decltype(&eglGetDisplay) get_display = nullptr;
    decltype(&eglInitialize) initialize = nullptr;
    decltype(&eglQueryString) query_string = nullptr;
    decltype(&eglBindAPI) bind_api = nullptr;
    decltype(&eglChooseConfig) choose_config = nullptr;
    decltype(&eglCreateContext) create_context = nullptr;
    decltype(&eglDestroyContext) destroy_context = nullptr;
    decltype(&eglCreatePbufferSurface) create_pbuffer = nullptr;
    decltype(&eglDestroySurface) destroy_surface = nullptr;
    decltype(&eglMakeCurrent) make_current = nullptr;
    decltype(&eglGetCurrentContext) current_context = nullptr;
    decltype(&eglGetProcAddress) address = nullptr;
    // Extensions; empty where the client has none.
    PFNEGLGETPLATFORMDISPLAYEXTPROC platform_display = nullptr;
    PFNEGLQUERYDEVICESEXTPROC query_devices = nullptr;

    explicit EglFunctions(const SharedLibrary& library) {
        library.require(get_error, "eglGetError");
        library.require(get_display, "eglGetDisplay");
        library.require(initialize, "eglInitialize");
        library.require(query_string, "eglQueryString");
        library.require(bind_api, "eglBindAPI");
        library.require(choose_config, "eglChooseConfig");
        library.require(create_context, "eglCreateContext");
        library.require(destroy_context, "eglDestroyContext");
        library.require(create_pbuffer, "eglCreatePbufferSurface");
        library.require(destroy_surface, "eglDestroySurface");
        library.require(make_current, "eglMakeCurrent");
        library.require(current_context, "eglGetCurrentContext");
        library.require(address, "eglGetProcAddress");
        platform_display = reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(address("eglGetPlatformDisplayEXT"));
        query_devices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(address("eglQueryDevicesEXT"));
    }
};

/// The name of an EGL error, for sentences.
std::string error_name(EGLint error) {
    constexpr std::array<const char*, 15> kErrors{
        "EGL_SUCCESS",       "EGL_NOT_INITIALIZED", "EGL_BAD_ACCESS",        "EGL_BAD_ALLOC",
        "EGL_BAD_ATTRIBUTE", "EGL_BAD_CONFIG",      "EGL_BAD_CONTEXT",       "EGL_BAD_CURRENT_SURFACE",
        "EGL_BAD_DISPLAY",   "EGL_BAD_MATCH",       "EGL_BAD_NATIVE_PIXMAP", "EGL_BAD_NATIVE_WINDOW",
        "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE",     "EGL_CONTEXT_LOST"};  // 0x3000 and up, without a gap
    const auto index = static_cast<std::size_t>(error - EGL_SUCCESS);
    return index < kErrors.size() ? kErrors[index] : "EGL error " + std::to_string(error);
}

/// Does `list`, words with spaces between, hold `extension`?
bool has_extension(const char* list, std::string_view extension) {
    std::string_view rest = list == nullptr ? "" : list;
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        if (rest.substr(0, end) == extension) return true;
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return false;
}

struct Display {
    EGLDisplay handle = EGL_NO_DISPLAY;
    std::string route;     ///< "surfaceless", "device 0", "default display"
    bool pbuffer = false;  ///< make a pbuffer even where a context may be current without a surface
};

/// Every display this machine may have, in the order of trying; nothing is opened yet.
std::vector<Display> displays(const EglFunctions& egl, std::optional<EglRoute> only) {
    const char* client = egl.query_string(EGL_NO_DISPLAY, EGL_EXTENSIONS);  // null before EGL 1.5
    const auto wanted = [&](EglRoute route) { return !only || *only == route; };
    std::vector<Display> found;
    if (wanted(EglRoute::surfaceless) && egl.platform_display &&
        has_extension(client, "EGL_MESA_platform_surfaceless")) {
        found.push_back(
            {egl.platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr), "surfaceless"});
    }
    const bool devices =
        has_extension(client, "EGL_EXT_platform_device") &&
        (has_extension(client, "EGL_EXT_device_enumeration") || has_extension(client, "EGL_EXT_device_base"));
    if (wanted(EglRoute::device) && egl.platform_display && egl.query_devices && devices) {
        std::array<EGLDeviceEXT, 16> handles{};
        EGLint count = 0;
        if (egl.query_devices(static_cast<EGLint>(handles.size()), handles.data(), &count) == EGL_FALSE) count = 0;
        for (EGLint i = 0; i < count; ++i) {
            found.push_back(
                {egl.platform_display(EGL_PLATFORM_DEVICE_EXT, handles[static_cast<std::size_t>(i)], nullptr),
                 "device " + std::to_string(i)});
        }
    }
    if (wanted(EglRoute::default_display)) {
        found.push_back({egl.get_display(EGL_DEFAULT_DISPLAY), "default display", true});
    }
    return found;
}

struct Version {
    Api api;
    int major;
    int minor;
    EGLint renderable;
    const char* what;
};
constexpr std::array kEsVersions{Version{Api::es, 3, 0, EGL_OPENGL_ES3_BIT, "ES 3.0"},
                                 Version{Api::es, 2, 0, EGL_OPENGL_ES2_BIT, "ES 2.0"}};
constexpr std::array kDesktopVersions{Version{Api::desktop, 4, 5, EGL_OPENGL_BIT, "GL 4.5 core"}};

class EglContext final : public Context::Implementation {
public:
    EglContext(const SharedLibrary& library, const EglFunctions& egl, const Display& display)
        : library_(library), egl_(egl), display_(display.handle), always_pbuffer_(display.pbuffer) {
        backend = Backend::egl;
    }

    ~EglContext() override {
        // eglTerminate is never called: every EGL user of the process that asks for the same platform shares this
        // display, and ending it would end their contexts too. EGL itself frees it at exit.
        if (context_ != EGL_NO_CONTEXT && egl_.current_context() == context_) {
            egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        }
        if (surface_ != EGL_NO_SURFACE) egl_.destroy_surface(display_, surface_);
        if (context_ != EGL_NO_CONTEXT) egl_.destroy_context(display_, context_);
    }

    /// Makes a context of `version` current. Returns the reason when that does not work, else an empty text.
    std::string start(const ContextDescription& description, const Version& version) {
        api_ = version.api == Api::es ? EGL_OPENGL_ES_API : EGL_OPENGL_API;
        if (egl_.bind_api(api_) == EGL_FALSE) return failure("eglBindAPI");
        const bool surfaceless =
            has_extension(egl_.query_string(display_, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context");
        const bool pbuffer = always_pbuffer_ || !surfaceless;

        // clang-format off
        const EGLint wish[] = {EGL_SURFACE_TYPE, pbuffer ? EGL_PBUFFER_BIT : 0,
                               EGL_RENDERABLE_TYPE, version.renderable,
                               EGL_RED_SIZE, 8, EGL_GREEN_SIZE, 8, EGL_BLUE_SIZE, 8, EGL_NONE};
        // clang-format on
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (egl_.choose_config(display_, wish, &config, 1, &count) == EGL_FALSE) return failure("eglChooseConfig");
        if (count == 0) return std::string("no configuration for ") + version.what;

        if (pbuffer) {
            const EGLint size[] = {EGL_WIDTH, description.width, EGL_HEIGHT, description.height, EGL_NONE};
            surface_ = egl_.create_pbuffer(display_, config, size);
            if (surface_ == EGL_NO_SURFACE) return failure("eglCreatePbufferSurface");
        }
        // ES takes the major version alone, which EGL 1.4 knows as EGL_CONTEXT_CLIENT_VERSION.
        const EGLint es[] = {EGL_CONTEXT_CLIENT_VERSION, version.major, EGL_NONE};
        // clang-format off
        const EGLint desktop[] = {EGL_CONTEXT_MAJOR_VERSION, version.major,
                                  EGL_CONTEXT_MINOR_VERSION, version.minor,
                                  EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        // clang-format on
        context_ = egl_.create_context(display_, config, EGL_NO_CONTEXT, version.api == Api::es ? es : desktop);
        if (context_ == EGL_NO_CONTEXT) return failure((std::string("eglCreateContext for ") + version.what).c_str());
        if (!bind()) return failure("eglMakeCurrent");
        // Before EGL 1.5, eglGetProcAddress need not know the core functions: those come from the GL library itself.
        gl_library_ =
            SharedLibrary::open_if_there(version.api == Api::es ? std::span<const char* const>(kEsNames)
                                                                : std::span<const char* const>(kDesktopNames));
        return {};
    }

    void* function(const char* function_name) const override {
        void* found = reinterpret_cast<void*>(egl_.address(function_name));
        return found != nullptr ? found : gl_library_.find(function_name);
    }

    void make_current() override {
        if (!bind()) {
            throw ContextError("the context was lost (eglMakeCurrent: " + error_name(egl_.get_error()) +
                               "); make a new one and prepare everything again");
        }
    }

private:
    /// Released first: EGL takes a context that it believes current for current and does nothing, but OSMesa, which EGL
    /// does not know of, may have taken the thread's GL calls over in between.
    bool bind() {
        egl_.bind_api(api_);
        return egl_.make_current(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT) == EGL_TRUE &&
               egl_.make_current(display_, surface_, surface_, context_) == EGL_TRUE;
    }

    [[nodiscard]] std::string failure(const char* call) const {
        return std::string(call) + ": " + error_name(egl_.get_error());
    }

    SharedLibrary library_;
    SharedLibrary gl_library_;
    EglFunctions egl_;
    EGLDisplay display_;
    bool always_pbuffer_;
    EGLenum api_ = EGL_OPENGL_ES_API;
    EGLContext context_ = EGL_NO_CONTEXT;
    EGLSurface surface_ = EGL_NO_SURFACE;
};

}  // namespace

std::unique_ptr<Context::Implementation> start_egl(const ContextDescription& description,
                                                   std::optional<EglRoute> only) {
    const SharedLibrary library = SharedLibrary::open("EGL", kNames, kRemedy);
    const EglFunctions egl(library);
    const std::span<const Version> versions =
        description.api == Api::es ? std::span<const Version>(kEsVersions) : std::span<const Version>(kDesktopVersions);
    std::string reasons;
    const auto note = [&](const Display& display, const std::string& reason) {
        reasons += (reasons.empty() ? "" : ", ") + display.route + ": " + reason;
    };
    for (const Display& display : displays(egl, only)) {
        EGLint major = 0;
        EGLint minor = 0;
        if (display.handle == EGL_NO_DISPLAY) {
            note(display, "none");
            continue;
        }
        if (egl.initialize(display.handle, &major, &minor) == EGL_FALSE) {
            note(display, "eglInitialize: " + error_name(egl.get_error()));
            continue;
        }
        for (const Version& version : versions) {
            auto context = std::make_unique<EglContext>(library, egl, display);
            const std::string reason = context->start(description, version);
            if (!reason.empty()) {
                note(display, reason);
                continue;
            }
            const char* vendor = egl.query_string(display.handle, EGL_VENDOR);
            context->how = "EGL " + std::to_string(major) + "." + std::to_string(minor) + " " + display.route + " (" +
                           (vendor != nullptr ? vendor : "no vendor") + ")";
            complete(*context);
            return context;
        }
    }
    if (reasons.empty()) reasons = "this EGL does not know the way that was asked for";
    throw ContextError("EGL cannot start: no driver gives a context (" + reasons + "); " + kDriverRemedy);
}

}  // namespace halfframe::platform
