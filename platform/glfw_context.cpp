// GLFW: a window on the user's desktop, or an invisible one.
#include <array>
#include <span>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include "platform/implementation.h"
#include "platform/shared_library.h"

namespace halfframe::platform {

namespace {

constexpr const char* kNames[] = {"libglfw.so.3", "libglfw.so"};
constexpr const char* kRemedy = "install the Debian package libglfw3";
constexpr const char* kNoWindowRemedy = "run it inside a desktop, or under xvfb-run (Debian package xvfb)";

struct GlfwFunctions {
    decltype(&glfwInit) init = nullptr;
    decltype(&glfwGetError) get_error = nullptr;
    decltype(&glfwGetVersionString) version = nullptr;
    decltype(&glfwDefaultWindowHints) default_hints = nullptr;
    decltype(&glfwWindowHint) hint = nullptr;
    decltype(&glfwCreateWindow) create_window = nullptr;
    decltype(&glfwDestroyWindow) destroy_window = nullptr;
    decltype(&glfwMakeContextCurrent) make_current = nullptr;
    decltype(&glfwGetProcAddress) address = nullptr;
    decltype(&glfwSwapBuffers) swap = nullptr;
    decltype(&glfwPollEvents) poll = nullptr;
    decltype(&glfwWindowShouldClose) should_close = nullptr;

    explicit GlfwFunctions(const SharedLibrary& library) {
        library.require(init, "glfwInit");
        library.require(get_error, "glfwGetError");
        library.require(version, "glfwGetVersionString");
        library.require(default_hints, "glfwDefaultWindowHints");
        library.require(hint, "glfwWindowHint");
        library.require(create_window, "glfwCreateWindow");
        library.require(destroy_window, "glfwDestroyWindow");
        library.require(make_current, "glfwMakeContextCurrent");
        library.require(address, "glfwGetProcAddress");
        library.require(swap, "glfwSwapBuffers");
        library.require(poll, "glfwPollEvents");
        library.require(should_close, "glfwWindowShouldClose");
    }

    /// GLFW's own words for its last error on this thread, and forgets it.
    [[nodiscard]] std::string error_text() const {
        const char* text = nullptr;
        get_error(&text);
        return text == nullptr ? "no reason given" : text;
    }
};

struct Request {
    int api;       ///< GLFW_OPENGL_ES_API or GLFW_OPENGL_API
    int creation;  ///< GLFW_EGL_CONTEXT_API or GLFW_NATIVE_CONTEXT_API
    int major;
    int minor;
    const char* what;
};

// EGL first: an EGL context may take turns with one of our EGL back end on one thread, a GLX one may not.
constexpr std::array kEsRequests{
    Request{GLFW_OPENGL_ES_API, GLFW_EGL_CONTEXT_API, 3, 0, "ES 3.0 through EGL"},
    Request{GLFW_OPENGL_ES_API, GLFW_NATIVE_CONTEXT_API, 3, 0, "ES 3.0 through the window system"},
    Request{GLFW_OPENGL_ES_API, GLFW_EGL_CONTEXT_API, 2, 0, "ES 2.0 through EGL"},
    Request{GLFW_OPENGL_ES_API, GLFW_NATIVE_CONTEXT_API, 2, 0, "ES 2.0 through the window system"},
};
constexpr std::array kDesktopRequests{
    Request{GLFW_OPENGL_API, GLFW_EGL_CONTEXT_API, 4, 5, "GL 4.5 core through EGL"},
    Request{GLFW_OPENGL_API, GLFW_NATIVE_CONTEXT_API, 4, 5, "GL 4.5 core through the window system"},
};

class GlfwContext final : public Context::Implementation {
public:
    GlfwContext() : library_(SharedLibrary::open("GLFW", kNames, kRemedy)), glfw_(library_) { backend = Backend::glfw; }

    ~GlfwContext() override {
        // glfwTerminate is never called: GLFW is one global thing for the process, and ending it would also destroy the
        // windows of other contexts and of the host program. glfwInit is harmless when it is running already.
        if (window_ != nullptr) glfw_.destroy_window(window_);
    }

    void start(const ContextDescription& description) {
        if (glfw_.init() == GLFW_FALSE) {
            throw ContextError("GLFW cannot start: " + glfw_.error_text() + "; " + kNoWindowRemedy);
        }
        std::string reasons;
        const std::span<const Request> requests = description.api == Api::es
                                                      ? std::span<const Request>(kEsRequests)
                                                      : std::span<const Request>(kDesktopRequests);
        for (const Request& request : requests) {
            window_ = open_window(description, request);
            if (window_ != nullptr) {
                // "3.3.8 X11 GLX EGL OSMesa ...": the number is enough.
                const std::string version = glfw_.version();
                how = "GLFW " + version.substr(0, version.find(' ')) + " " + request.what;
                make_current();
                return;
            }
            reasons += (reasons.empty() ? "" : ", ") + std::string(request.what) + ": " + glfw_.error_text();
        }
        throw ContextError("GLFW cannot start: no window with a context (" + reasons +
                           "); install the Debian packages libegl-mesa0, libgl1-mesa-dri and libgles2");
    }

    void* function(const char* function_name) const override {
        return reinterpret_cast<void*>(glfw_.address(function_name));
    }

    void make_current() override {
        glfw_.get_error(nullptr);
        // Released first: see EglContext::make_current.
        glfw_.make_current(nullptr);
        glfw_.make_current(window_);
        const char* text = nullptr;
        if (glfw_.get_error(&text) != GLFW_NO_ERROR) {
            throw ContextError(std::string("the context was lost (") + text + "); make a new one");
        }
    }

    void swap() override {
        glfw_.swap(window_);
        glfw_.poll();
    }

    bool should_close() const override { return glfw_.should_close(window_) == GLFW_TRUE; }

private:
    /// Sets the hints, which are global to GLFW, from the defaults each time.
    GLFWwindow* open_window(const ContextDescription& description, const Request& request) {
        glfw_.default_hints();
        glfw_.hint(GLFW_VISIBLE, description.visible ? GLFW_TRUE : GLFW_FALSE);
        glfw_.hint(GLFW_CLIENT_API, request.api);
        glfw_.hint(GLFW_CONTEXT_CREATION_API, request.creation);
        glfw_.hint(GLFW_CONTEXT_VERSION_MAJOR, request.major);
        glfw_.hint(GLFW_CONTEXT_VERSION_MINOR, request.minor);
        if (request.api == GLFW_OPENGL_API) glfw_.hint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        return glfw_.create_window(description.width, description.height, description.title.c_str(), nullptr, nullptr);
    }

    SharedLibrary library_;
    GlfwFunctions glfw_;
    GLFWwindow* window_ = nullptr;
};

}  // namespace

std::unique_ptr<Context::Implementation> start_glfw(const ContextDescription& description) {
    auto context = std::make_unique<GlfwContext>();
    context->start(description);
    complete(*context);
    return context;
}

}  // namespace halfframe::platform
