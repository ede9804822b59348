// Chooses the back end and keeps the sentences of those that did not start.
#include "platform/context.h"

#include <cstring>
#include <utility>

#include <GLES3/gl3.h>

#include "platform/implementation.h"

namespace halfframe::platform {

namespace {

// Desktop GL only, so not in the ES headers. ES 3.0 filters across cube faces and takes gl_PointSize always; with both
// on, OSMesa, GL 4.5 and ES 3 draw the same pictures to the bit.
constexpr GLenum kTextureCubeMapSeamless = 0x884F;
constexpr GLenum kProgramPointSize = 0x8642;

std::unique_ptr<Context::Implementation> start(Backend backend, const ContextDescription& description) {
    switch (backend) {
        case Backend::egl: return start_egl(description);
        case Backend::osmesa: return start_osmesa(description);
        case Backend::glfw: return start_glfw(description);
        case Backend::automatic: break;
    }
    std::vector<std::string> tried;
    for (const Backend candidate : {Backend::egl, Backend::osmesa, Backend::glfw}) {
        try {
            auto context = start(candidate, description);
            context->tried = std::move(tried);
            return context;
        } catch (const ContextError& error) {
            tried.emplace_back(error.what());
        }
    }
    std::string text = "no graphics context could be made:";
    for (const std::string& sentence : tried) text += "\n  " + sentence;
    throw ContextError(text);
}

}  // namespace

void complete(Context::Implementation& context) {
    const auto get_string = reinterpret_cast<const GLubyte* (*)(GLenum)>(context.function("glGetString"));
    const auto* version = get_string == nullptr ? nullptr : reinterpret_cast<const char*>(get_string(GL_VERSION));
    if (version == nullptr) {
        throw ContextError(context.how + " gave a context that does not tell its GL version; try another back end");
    }
    const bool desktop = std::strncmp(version, "OpenGL ES", 9) != 0;
    context.summary = context.how + ", " + (desktop ? "OpenGL " : "") + version;
    if (desktop) {
        const auto enable = reinterpret_cast<void (*)(GLenum)>(context.function("glEnable"));
        enable(kTextureCubeMapSeamless);
        enable(kProgramPointSize);
    }
}

Context Context::create(const ContextDescription& description) {
    return Context(start(description.backend, description));
}

Context::Context(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
Context::~Context() = default;
Context::Context(Context&&) noexcept = default;
Context& Context::operator=(Context&&) noexcept = default;

void* Context::function(const char* function_name) const { return implementation_->function(function_name); }

std::function<void*(const char*)> Context::loader() const {
    // The implementation stays where it is when the Context moves.
    return [implementation = implementation_.get()](const char* function_name) {
        return implementation->function(function_name);
    };
}

void Context::make_current() { implementation_->make_current(); }
void Context::swap() { implementation_->swap(); }
bool Context::should_close() const { return implementation_->should_close(); }
Backend Context::backend() const { return implementation_->backend; }
const std::string& Context::description() const { return implementation_->summary; }
const std::vector<std::string>& Context::tried() const { return implementation_->tried; }

const char* name(Backend backend) {
    switch (backend) {
        case Backend::automatic: return "auto";
        case Backend::egl: return "egl";
        case Backend::osmesa: return "osmesa";
        case Backend::glfw: return "glfw";
    }
    return "unknown";
}

}  // namespace halfframe::platform
