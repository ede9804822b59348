// One table of exactly the ES 2.0/3.0 entry points that halfframe uses. Every call goes through here: it is checked
// against the mask, counted in the ledger, and written to the trace when one is open.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include <GLES3/gl3.h>

#include <GLES2/gl2ext.h>

#include "engine/gl/call_ledger.h"
#include "engine/gl/caps.h"

namespace halfframe::gl {

class CallTrace;

constexpr std::uint32_t kContextLost = 0x0507;  ///< GL_CONTEXT_LOST, ES 3.2 and KHR_robustness

/// Returns the address of a GL function, or nullptr. eglGetProcAddress, OSMesaGetProcAddress, glfwGetProcAddress and
/// any host's own function fit.
using Loader = std::function<void*(const char*)>;

/// "GL_INVALID_OPERATION" for what glGetError() returns; empty for GL_NO_ERROR.
[[nodiscard]] const char* error_name(std::uint32_t error);

/// Since which version, or through which extension, an entry point may be called.
enum class Since : std::uint8_t {
    es20,
    es30,
    khr_debug,     ///< KHR_debug: labels and groups
    timer_query,   ///< EXT_disjoint_timer_query, or desktop GL 3.3
    desktop_only,  ///< the counting context alone
};

class EntryPoints {
public:
    /// Fetches every row of the table. A missing ES 2.0 function: Error(context) that names it. Missing later ones make
    /// the ability false in read_caps(). `es_text_on_desktop` is detected from GL_VERSION, not told.
    explicit EntryPoints(const Loader& loader);
    ~EntryPoints();
    EntryPoints(EntryPoints&&) noexcept;
    EntryPoints& operator=(EntryPoints&&) noexcept;
    EntryPoints(const EntryPoints&) = delete;
    EntryPoints& operator=(const EntryPoints&) = delete;

    /// From now on, a call, format, target or limit that `caps` does not grant throws Mistake naming call and pass.
    /// `caps` is copied.
    void restrict_to(const Caps& caps);

    CallLedger ledger;

    /// Names the pass that the following calls belong to (and opens a KHR_debug group); nested passes are not allowed.
    /// Prefer PassScope.
    void begin_pass(const char* pass);
    void end_pass();
    [[nodiscard]] const char* current_pass() const;
    /// True once restrict_to() was given caps with KHR_debug: only then are groups opened and objects labelled.
    [[nodiscard]] bool debug_labels() const { return restricted_ && caps_.debug_labels; }
    /// What restrict_to() was last given; the ES 2.0 minimums before.
    [[nodiscard]] const Caps& caps() const { return caps_; }

    /// Starts writing every call with its arguments; data is written as size and hash, never as an address.
    void start_trace();
    /// The calls so far as a JSON array, one call a line: ["pass","glName",[arguments]] ; byte-stable between runs.
    [[nodiscard]] std::string trace_json() const;
    void stop_trace();

    /// Is the function behind this call number there?  (Used by read_caps.)
    [[nodiscard]] bool loaded(int call) const { return functions_[static_cast<std::size_t>(call)] != nullptr; }

    // The calls. GLenum target etc. as in the ES reference pages; the "gl" prefix is the object: gl.DrawArrays(...).
#define HALFFRAME_GL(since, result, name, parameters, arguments) result name parameters;
#include "engine/gl/entry_points.inl"
#undef HALFFRAME_GL

private:
    friend class CallTrace;
    void before(int call);  ///< mask check and count
    [[noreturn]] void refuse(int call, const std::string& reason) const;
    template <typename Result, typename Raw, typename Arguments>
    Result run(int call, Raw&& raw, const Arguments& arguments);
    std::array<void*, kMaxCalls> functions_{};
    std::array<bool, kMaxCalls> allowed_{};
    Caps caps_;
    bool restricted_ = false;
    int pass_ = 0;
    int unpack_alignment_ = 4;  ///< as glPixelStorei set it: the rows of an upload are padded to it [bytes]
    int pack_alignment_ = 4;    ///< the same for glReadPixels [bytes]
    std::unique_ptr<CallTrace> trace_;
};

/// Opens a pass for the lifetime of the scope.
class PassScope {
public:
    PassScope(EntryPoints& gl, const char* pass) : gl_(gl) { gl_.begin_pass(pass); }
    ~PassScope() { gl_.end_pass(); }
    PassScope(const PassScope&) = delete;
    PassScope& operator=(const PassScope&) = delete;

private:
    EntryPoints& gl_;
};

}  // namespace halfframe::gl
