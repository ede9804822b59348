// The open trace: every call with its arguments as one line of JSON. Only entry_points.cpp talks to it.
//
// A line is ["pass","glName",[arguments]]. glCreateShader, glCreateProgram and glFenceSync add a fourth element, the
// name made. Enumerants are written by name; data as {"bytes":N,"hash":"..."} (FNV-1a, 64 bits) and never as an
// address; what a query returns is null, because it depends on the driver. GL objects and fences are numbered in the
// order in which this trace meets them, each kind from 1 (fences from 0): the driver's own names rise from frame to
// frame.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace halfframe::gl {

/// One argument or result on its way to the trace.
struct TraceValue {
    std::int64_t integer = 0;
    double real = 0.0;
    const void* pointer = nullptr;

    template <typename T>
    static TraceValue of(T value) {
        TraceValue traced;
        if constexpr (std::is_pointer_v<T>) {
            traced.pointer = value;
        } else if constexpr (std::is_floating_point_v<T>) {
            traced.real = static_cast<double>(value);
        } else {
            traced.integer = static_cast<std::int64_t>(value);
        }
        return traced;
    }
};

/// The kinds of names that GL numbers apart. Shaders and programs share one.
enum class NameSpace : std::uint8_t { none, buffer, texture, framebuffer, renderbuffer, vertex_array, query, program };

/// The trace's own numbers for the driver's names.
class TracedNames {
public:
    int number(NameSpace space, std::uint32_t name);   ///< 0 stays 0
    void forget(NameSpace space, std::uint32_t name);  ///< the driver may hand the name out again, as another object

private:
    std::map<std::pair<NameSpace, std::uint32_t>, int> numbers_;
    std::map<NameSpace, int> last_;
};

class CallTrace {
public:
    /// `values` in the order of the parameters; `result` null for calls that return nothing. `row_alignment` is the
    /// pixel-store alignment in force [bytes]. Called after the call, so that generated names are there to be written.
    void record(int call, std::string_view pass, std::span<const TraceValue> values, const TraceValue* result,
                int row_alignment);

    [[nodiscard]] std::string json() const;

private:
    std::string sync_index(const void* sync);

    std::string lines_;
    TracedNames names_;
    std::vector<const void*> syncs_;  ///< by index; an address may come back, so the last one counts
};

}  // namespace halfframe::gl
