// A shared library opened while running, so that a machine without it loses one back end and not the program.
#pragma once

#include <span>
#include <string>

#include "platform/context.h"

namespace halfframe::platform {

/// An open library. It is deliberately never closed: drivers register per-thread and at-exit work that points into
/// them, and unloading one under it crashes. Opening twice gives the same library, so nothing grows.
class SharedLibrary {
public:
    SharedLibrary() = default;

    /// Opens the first of `names` that loads. Throws ContextError: "`who` cannot start: NAME cannot be opened (the
    /// system's reason); `remedy`".
    [[nodiscard]] static SharedLibrary open(const char* who, std::span<const char* const> names, const char* remedy);
    /// The same without an exception: an empty library when none of `names` loads.
    [[nodiscard]] static SharedLibrary open_if_there(std::span<const char* const> names);

    /// Address of `function`, or nullptr; nullptr too in an empty library.
    [[nodiscard]] void* find(const char* function) const;

    /// Fills `target` with `function`. Throws ContextError when the library is too old to have it.
    template <typename Function>
    void require(Function*& target, const char* function) const {
        target = reinterpret_cast<Function*>(find(function));
        if (target == nullptr) {
            throw ContextError(who_ + " cannot start: " + name_ + " has no function " + function +
                               ", so it is too old; install a newer one");
        }
    }

private:
    void* handle_ = nullptr;
    std::string who_;
    std::string name_;
};

}  // namespace halfframe::platform
