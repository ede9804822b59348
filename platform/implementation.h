// What a back end must do, and the functions that start each one. Private to platform/ and its tests.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "platform/context.h"

namespace halfframe::platform {

/// One back end's context. The destructor gives back whatever was reached, also after a start that failed half way.
struct Context::Implementation {
    Implementation() = default;
    Implementation(const Implementation&) = delete;
    Implementation& operator=(const Implementation&) = delete;
    virtual ~Implementation() = default;

    [[nodiscard]] virtual void* function(const char* name) const = 0;
    virtual void make_current() = 0;
    virtual void swap() {}
    [[nodiscard]] virtual bool should_close() const { return false; }

    Backend backend = Backend::automatic;
    std::string how;      ///< "EGL 1.5 surfaceless (Mesa Project)": the part of the description before the version
    std::string summary;  ///< how and GL_VERSION
    std::vector<std::string> tried;
};

/// The ways to an EGL display, in the order they are tried.
enum class EglRoute { surfaceless, device, default_display };

// Each returns a context that is current, or throws ContextError with one sentence.
/// `only`: tries that route alone (the tests do).
[[nodiscard]] std::unique_ptr<Context::Implementation> start_egl(const ContextDescription& description,
                                                                 std::optional<EglRoute> only = std::nullopt);
[[nodiscard]] std::unique_ptr<Context::Implementation> start_osmesa(const ContextDescription& description);
[[nodiscard]] std::unique_ptr<Context::Implementation> start_glfw(const ContextDescription& description);

/// Completes a current context: reads its version into `summary` and, on desktop GL, switches on the two things that
/// ES has always on. Throws ContextError when the context does not answer.
void complete(Context::Implementation& context);

}  // namespace halfframe::platform
