// Loads the entry points and wraps each call: mask, rules, ledger, the call itself, trace.
#include "engine/gl/entry_points.h"

#include <string_view>
#include <tuple>
#include <type_traits>

#include "engine/error.h"
#include "engine/gl/call_number.h"
#include "engine/gl/call_rules.h"
#include "engine/gl/call_trace.h"

namespace halfframe::gl {
namespace {

struct CallRow {
    Since since;
    const char* name;  ///< without "gl"
};

constexpr std::array<CallRow, kCallCount> kRows = {{
#define HALFFRAME_GL(since, result, name, parameters, arguments) {Since::since, #name},
#include "engine/gl/entry_points.inl"
#undef HALFFRAME_GL
}};

/// Where to look for a function, in order. Loaders of Mesa and of libglvnd hand out an address for every name, also for
/// functions that the context lacks: so the name that belongs to this kind of context comes first, and whether a
/// function may be called is decided by read_caps(), not by its address.
std::vector<std::string> names_to_try(const CallRow& row, bool desktop, bool es2) {
    const std::string plain = std::string("gl") + row.name;
    switch (row.since) {
        case Since::es20:
        case Since::desktop_only: return {plain};
        case Since::es30:
            if (es2) return {plain + "OES", plain + "KHR", plain};
            return {plain, plain + "OES", plain + "KHR"};
        case Since::khr_debug: return {plain, plain + "KHR"};
        case Since::timer_query:
            if (desktop) return {plain};
            return {plain + "EXT", plain};
    }
    return {plain};
}

/// Deleting breaks no device's rules, and objects outlive a change of the mask.
bool deletes(Call call) { return std::string_view(kRows[static_cast<std::size_t>(call)].name).starts_with("Delete"); }

bool granted(Call call, const Caps& caps) {
    if (deletes(call)) return true;
    switch (call) {
        // Workaround core_profile_vertex_array: a desktop core profile draws nothing without a bound vertex array
        // object, which ES 2.0 does not know. The renderer binds one there, under every mask.
        case Call::BindVertexArray:
        case Call::GenVertexArrays: return caps.vertex_array_objects || caps.core_profile;
        case Call::GetProgramBinary:
        case Call::ProgramBinary: return caps.program_binary;
        // OES_get_program_binary has no glProgramParameteri: ES 3.0 brought it.
        case Call::ProgramParameteri: return caps.program_binary && caps.es_version >= 30;
        case Call::FenceSync:
        case Call::ClientWaitSync: return caps.fence_sync;
        case Call::InvalidateFramebuffer: return caps.discard_framebuffer;
        case Call::GetStringi: return caps.es_version >= 30 || caps.desktop;
        default: break;
    }
    switch (kRows[static_cast<std::size_t>(call)].since) {
        case Since::es20: return true;
        case Since::es30: return caps.es_version >= 30;
        case Since::khr_debug: return caps.debug_labels;
        case Since::timer_query: return caps.timer_query || caps.samples_passed;
        case Since::desktop_only: return caps.desktop;
    }
    return false;
}

const char* needed(Call call) {
    switch (kRows[static_cast<std::size_t>(call)].since) {
        case Since::es20: return "it is part of ES 2.0";
        case Since::es30: return "it needs ES 3.0 or the extension that brings it";
        case Since::khr_debug: return "it needs KHR_debug";
        case Since::timer_query: return "it needs EXT_disjoint_timer_query or desktop GL 3.3";
        case Since::desktop_only: return "it exists on desktop GL alone";
    }
    return "";
}

// What a call adds to its pass besides the count, and the pixel-store state that sizes depend on.
struct Accounts {
    PassCalls& pass;
    int& unpack_alignment;
    int& pack_alignment;
};

template <Call call>
struct Accounting {
    Accounts to;
    template <typename... Arguments>
    void operator()(const Arguments&...) const {}
};

template <>
struct Accounting<Call::BufferData> {
    Accounts to;
    void operator()(GLenum, GLsizeiptr size, const void* data, GLenum) const {
        if (data != nullptr) to.pass.bytes_uploaded += static_cast<std::uint64_t>(size);
    }
};

template <>
struct Accounting<Call::BufferSubData> {
    Accounts to;
    void operator()(GLenum, GLintptr, GLsizeiptr size, const void*) const {
        to.pass.bytes_uploaded += static_cast<std::uint64_t>(size);
    }
};

template <>
struct Accounting<Call::TexImage2D> {
    Accounts to;
    void operator()(GLenum, GLint, GLint, GLsizei width, GLsizei height, GLint, GLenum format, GLenum type,
                    const void* pixels) const {
        if (pixels == nullptr) return;
        to.pass.bytes_uploaded += transfer_bytes(format, type, width, height, to.unpack_alignment);
    }
};

template <>
struct Accounting<Call::CompressedTexImage2D> {
    Accounts to;
    void operator()(GLenum, GLint, GLenum, GLsizei, GLsizei, GLint, GLsizei image_size, const void* data) const {
        if (data != nullptr) to.pass.bytes_uploaded += static_cast<std::uint64_t>(image_size);
    }
};

template <>
struct Accounting<Call::ReadPixels> {
    Accounts to;
    void operator()(GLint, GLint, GLsizei width, GLsizei height, GLenum format, GLenum type, void*) const {
        to.pass.bytes_read_back += transfer_bytes(format, type, width, height, to.pack_alignment);
    }
};

template <>
struct Accounting<Call::PixelStorei> {
    Accounts to;
    void operator()(GLenum pname, GLint value) const {
        if (value != 1 && value != 2 && value != 4 && value != 8) return;  // GL refuses it too
        if (pname == GL_UNPACK_ALIGNMENT) to.unpack_alignment = value;
        if (pname == GL_PACK_ALIGNMENT) to.pack_alignment = value;
    }
};

template <>
struct Accounting<Call::DrawArrays> {
    Accounts to;
    void operator()(GLenum, GLint, GLsizei count) const {
        ++to.pass.draws;
        to.pass.vertices += static_cast<std::uint64_t>(count);
    }
};

template <>
struct Accounting<Call::DrawElements> {
    Accounts to;
    void operator()(GLenum, GLsizei count, GLenum, const void*) const {
        ++to.pass.draws;
        to.pass.vertices += static_cast<std::uint64_t>(count);
    }
};

}  // namespace

const char* error_name(std::uint32_t error) {
    switch (error) {
        case GL_NO_ERROR: return "";
        case GL_INVALID_ENUM: return "GL_INVALID_ENUM";
        case GL_INVALID_VALUE: return "GL_INVALID_VALUE";
        case GL_INVALID_OPERATION: return "GL_INVALID_OPERATION";
        case GL_INVALID_FRAMEBUFFER_OPERATION: return "GL_INVALID_FRAMEBUFFER_OPERATION";
        case GL_OUT_OF_MEMORY: return "GL_OUT_OF_MEMORY";
        case kContextLost: return "GL_CONTEXT_LOST";
        default: return "an unknown GL error";
    }
}

EntryPoints::EntryPoints(const Loader& loader) {
    expect(static_cast<bool>(loader), "the loader of GL functions is empty");
    const auto get_string = reinterpret_cast<const GLubyte*(GL_APIENTRYP)(GLenum)>(loader("glGetString"));
    const GLubyte* version = get_string != nullptr ? get_string(GL_VERSION) : nullptr;
    if (version == nullptr) {
        throw Error(Fault::context,
                    "the loader gives no glGetString that answers: make a GL context current on this thread before the "
                    "engine starts, and hand in the loader of that context");
    }
    const std::string_view text = reinterpret_cast<const char*>(version);
    const bool desktop = !text.starts_with("OpenGL ES");
    const bool es2 = text.starts_with("OpenGL ES 2");
    for (int call = 0; call < kCallCount; ++call) {
        const auto index = static_cast<std::size_t>(call);
        for (const std::string& name : names_to_try(kRows[index], desktop, es2)) {
            functions_[index] = loader(name.c_str());
            if (functions_[index] != nullptr) break;
        }
        if (functions_[index] == nullptr && kRows[index].since == Since::es20) {
            throw Error(Fault::context, std::string("the context (") + std::string(text) + ") has no " +
                                            call_name(call) +
                                            ": halfframe needs OpenGL ES 2.0, or desktop GL 4.1 or later");
        }
        allowed_[index] = functions_[index] != nullptr;
    }
}

EntryPoints::~EntryPoints() = default;
EntryPoints::EntryPoints(EntryPoints&&) noexcept = default;
EntryPoints& EntryPoints::operator=(EntryPoints&&) noexcept = default;

void EntryPoints::restrict_to(const Caps& caps) {
    caps_ = caps;
    restricted_ = true;
    for (int call = 0; call < kCallCount; ++call) {
        const auto index = static_cast<std::size_t>(call);
        allowed_[index] = functions_[index] != nullptr && granted(static_cast<Call>(call), caps_);
    }
}

const char* EntryPoints::current_pass() const { return ledger.pass_names()[static_cast<std::size_t>(pass_)].c_str(); }

void EntryPoints::begin_pass(const char* pass) {
    expect(pass_ == 0, [&] {
        return std::string("pass \"") + pass + "\" was begun inside pass \"" + current_pass() +
               "\": passes do not nest";
    });
    pass_ = ledger.pass_index(pass);
    expect(pass_ != 0, [&] { return std::string("\"") + pass + "\" is the name for everything outside a pass"; });
    if (debug_labels()) PushDebugGroup(GL_DEBUG_SOURCE_APPLICATION_KHR, 0, -1, pass);
}

void EntryPoints::end_pass() {
    expect(pass_ != 0, "end_pass() without begin_pass()");
    if (debug_labels()) PopDebugGroup();
    pass_ = 0;
}

void EntryPoints::start_trace() { trace_ = std::make_unique<CallTrace>(); }

std::string EntryPoints::trace_json() const {
    expect(trace_ != nullptr, "trace_json() without an open trace: call start_trace() first");
    return trace_->json();
}

void EntryPoints::stop_trace() { trace_.reset(); }

inline void EntryPoints::before(int call) {
    if (!allowed_[static_cast<std::size_t>(call)]) [[unlikely]]
        refuse(call, needed(static_cast<Call>(call)));
    ++ledger.pass(pass_).count[static_cast<std::size_t>(call)];
}

void EntryPoints::refuse(int call, const std::string& reason) const {
    const std::string device = restricted_ ? "device \"" + caps_.device + "\"" : "this context";
    throw MaskedUse(std::string(call_name(call)) + " in pass \"" + current_pass() + "\" is refused by " + device +
                    ": " + reason);
}

template <typename Result, typename Raw, typename Arguments>
Result EntryPoints::run(int call, Raw&& raw, const Arguments& arguments) {
    if (!trace_) [[likely]]
        return raw();
    const auto record = [&](const TraceValue* result) {
        const auto values = std::apply(
            [](const auto&... each) { return std::array<TraceValue, sizeof...(each)>{TraceValue::of(each)...}; },
            arguments);
        const int alignment = call == number(Call::ReadPixels) ? pack_alignment_ : unpack_alignment_;
        trace_->record(call, current_pass(), values, result, alignment);
    };
    if constexpr (std::is_void_v<Result>) {
        raw();
        record(nullptr);
    } else {
        const Result result = raw();
        const TraceValue traced = TraceValue::of(result);
        record(&traced);
        return result;
    }
}

// Every call: refused or counted, then made, then traced. Nothing here allocates while no trace is open.
#define HALFFRAME_GL(since, result, name, parameters, arguments)                                                       \
    result EntryPoints::name parameters {                                                                              \
        before(number(Call::name));                                                                                    \
        if (restricted_) {                                                                                             \
            const std::string broken_rule = ArgumentRule<Call::name>{caps_} arguments;                                 \
            if (!broken_rule.empty()) [[unlikely]]                                                                     \
                refuse(number(Call::name), broken_rule);                                                               \
        }                                                                                                              \
        Accounting<Call::name> {                                                                                       \
            { ledger.pass(pass_), unpack_alignment_, pack_alignment_ }                                                 \
        }                                                                                                              \
        arguments;                                                                                                     \
        const auto raw_call = [&]() -> result {                                                                        \
            return reinterpret_cast<result(GL_APIENTRYP) parameters>(functions_[static_cast<std::size_t>(Call::name)]) \
                arguments;                                                                                             \
        };                                                                                                             \
        return run<result>(number(Call::name), raw_call, std::tie arguments);                                          \
    }
#include "engine/gl/entry_points.inl"
#undef HALFFRAME_GL

}  // namespace halfframe::gl
