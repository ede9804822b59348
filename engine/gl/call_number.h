// A number for every row of entry_points.inl, in its order: what the ledger, the mask and the trace index by.
#pragma once

#include "engine/gl/call_ledger.h"

namespace halfframe::gl {

/// One enumerator an entry point, spelled as in the ES reference pages without "gl".
enum class Call : int {
#define HALFFRAME_GL(since, result, name, parameters, arguments) name,
#include "engine/gl/entry_points.inl"
#undef HALFFRAME_GL
};

inline constexpr int kCallCount = 0
#define HALFFRAME_GL(since, result, name, parameters, arguments) +1
#include "engine/gl/entry_points.inl"
#undef HALFFRAME_GL
    ;
static_assert(kCallCount <= kMaxCalls, "raise kMaxCalls in call_ledger.h");

[[nodiscard]] constexpr int number(Call call) { return static_cast<int>(call); }

}  // namespace halfframe::gl
