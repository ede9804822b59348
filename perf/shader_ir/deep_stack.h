// Runs what calls itself once for each operator of a text: compilers, on texts of strangers.
#pragma once

#include <functional>

namespace halfframe::shader_ir {

/// Runs `work` on a thread of its own whose stack holds a megabyte of text in one expression, and waits. What it throws
/// is thrown here. Where the system gives no such stack, on that of the caller.
void on_deep_stack(const std::function<void()>& work);

}  // namespace halfframe::shader_ir
