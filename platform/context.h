// Makes a context current: EGL, OSMesa or GLFW. Knows nothing of what is drawn with it.
#pragma once

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace halfframe::platform {

enum class Backend { automatic, egl, osmesa, glfw };

/// Which language the context speaks. `desktop` is a GL 4.5 core context of the same driver: it runs ES text, and is
/// the one that counts fragments exactly.
enum class Api { es, desktop };

struct ContextDescription {
    Backend backend = Backend::automatic;
    Api api = Api::es;
    int width = 16;  ///< size of the default framebuffer [pixels]; we draw to our own targets
    int height = 16;
    bool visible = false;             ///< GLFW: show the window
    std::string title = "halfframe";  ///< GLFW: window title
};

/// No context could be made. what() is one sentence that says what is missing and what to install or try.
class ContextError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// One current context; destroys itself. Move-only. Current on the thread that made it. Several may live in one process
/// and take turns: call make_current() before using one, also after another was destroyed.
class Context {
public:
    /// Tries the wished backend; `automatic` tries EGL, then OSMesa, then GLFW and, when none starts, throws with the
    /// sentence of each.
    [[nodiscard]] static Context create(const ContextDescription& description);

    ~Context();
    Context(Context&&) noexcept;
    Context& operator=(Context&&) noexcept;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// Address of a GL function of this context, or nullptr. An address alone proves nothing: some drivers give one for
    /// any name, so ask the version or the extension list first.
    [[nodiscard]] void* function(const char* name) const;
    /// The same as a loader that can be handed to the engine; valid while the context lives.
    [[nodiscard]] std::function<void*(const char*)> loader() const;

    void make_current();                      ///< throws ContextError when the context is lost
    void swap();                              ///< shows the default framebuffer (GLFW; nothing elsewhere), polls events
    [[nodiscard]] bool should_close() const;  ///< GLFW: the user closed the window

    [[nodiscard]] Backend backend() const;
    /// "EGL 1.5 surfaceless (Mesa Project), OpenGL ES 3.2 Mesa 22.3.6" and the like.
    [[nodiscard]] const std::string& description() const;
    /// The sentences of the backends that `automatic` tried first and that did not start.
    [[nodiscard]] const std::vector<std::string>& tried() const;

    struct Implementation;  ///< one per backend, in its own .cpp

private:
    explicit Context(std::unique_ptr<Implementation> implementation);
    std::unique_ptr<Implementation> implementation_;
};

[[nodiscard]] const char* name(Backend backend);

}  // namespace halfframe::platform
