// Functions that stand before those of the driver, one for every row of the table of entry points.
#include "perf/bench/call_recorder.h"

#include <array>
#include <cstring>
#include <deque>
#include <new>
#include <string>
#include <tuple>
#include <type_traits>

#include "engine/gl/call_number.h"

namespace halfframe::bench {

namespace {

/// A recorded call: who makes it again, and its arguments.
struct Recorded {
    void (*make)(const Recorded&);
    alignas(8) std::byte arguments[88];
};

struct Record {
    bool on = false;
    std::vector<Recorded> calls;
    std::deque<std::vector<std::byte>> data;  ///< what pointers pointed to; a deque keeps its elements where they are
    std::array<void*, gl::kCallCount> real{};
    gl::Loader loader;
};
Record record;  // the functions below have no other way to it

/// Bytes behind a pointer among the arguments, where the caller may change or free them after the call; 0: none.
template <typename... Arguments>
std::size_t data_bytes(gl::Call call, const std::tuple<Arguments...>& arguments) {
    const auto count = [&]() -> std::size_t {
        if constexpr (sizeof...(Arguments) > 1) {
            using Second = std::tuple_element_t<1, std::tuple<Arguments...>>;
            if constexpr (std::is_integral_v<Second>) return static_cast<std::size_t>(std::get<1>(arguments));
        }
        return 0;
    }();
    if (call == gl::Call::Uniform4fv) return count * 16;
    if (call == gl::Call::UniformMatrix4fv) return count * 64;
    if (call == gl::Call::InvalidateFramebuffer) return count * sizeof(GLenum);
    return 0;
}

template <typename... Arguments>
void keep_data(gl::Call call, std::tuple<Arguments...>& arguments) {
    const std::size_t bytes = data_bytes(call, arguments);
    if (bytes == 0) return;
    auto& last = std::get<sizeof...(Arguments) - 1>(arguments);
    if constexpr (std::is_pointer_v<std::remove_reference_t<decltype(last)>>) {
        std::vector<std::byte>& kept = record.data.emplace_back(bytes);
        std::memcpy(kept.data(), last, bytes);
        last = reinterpret_cast<std::remove_reference_t<decltype(last)>>(kept.data());
    }
}

template <gl::Call call, typename Result, typename... Arguments>
struct Shim {
    using Function = Result(GL_APIENTRYP)(Arguments...);
    using Packed = std::tuple<Arguments...>;
    static_assert(sizeof(Packed) <= sizeof(Recorded::arguments));

    static Function real() { return reinterpret_cast<Function>(record.real[static_cast<std::size_t>(call)]); }

    static void make(const Recorded& recorded) {
        std::apply(real(), *std::launder(reinterpret_cast<const Packed*>(recorded.arguments)));
    }

    static Result GL_APIENTRY function(Arguments... arguments) {
        if (record.on) {
            Packed packed(arguments...);
            if constexpr (sizeof...(Arguments) > 0) keep_data(call, packed);
            Recorded& recorded = record.calls.emplace_back();
            recorded.make = make;
            new (recorded.arguments) Packed(packed);
        }
        return real()(arguments...);
    }
};

template <gl::Call call, typename Result, typename... Arguments>
void* shim_of(Result (gl::EntryPoints::*)(Arguments...)) {
    return reinterpret_cast<void*>(&Shim<call, Result, Arguments...>::function);
}

}  // namespace

gl::Loader CallRecorder::around(gl::Loader loader) {
    record.loader = std::move(loader);
    return [](const char* name) -> void* {
        void* real = record.loader(name);
        if (real == nullptr) return nullptr;
        const std::string_view wanted(name);
#define HALFFRAME_GL(since, result, call, parameters, arguments)      \
    if (wanted == "gl" #call) {                                       \
        record.real[static_cast<std::size_t>(gl::Call::call)] = real; \
        return shim_of<gl::Call::call>(&gl::EntryPoints::call);       \
    }
#include "engine/gl/entry_points.inl"
#undef HALFFRAME_GL
        return real;
    };
}

void CallRecorder::start() {
    record.calls.clear();
    record.data.clear();
    record.on = true;
}

void CallRecorder::stop() { record.on = false; }

void CallRecorder::replay() {
    for (const Recorded& call : record.calls) call.make(call);
}

std::size_t CallRecorder::calls() { return record.calls.size(); }

}  // namespace halfframe::bench
