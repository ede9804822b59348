// dlopen and dlsym, with the reason kept.
#include "platform/shared_library.h"

#include <dlfcn.h>

namespace halfframe::platform {

namespace {

// RTLD_LOCAL: libOSMesa exports the whole of GL under the same names as libGL and libGLESv2, and nobody else may see
// them. RTLD_DEEPBIND is not needed (libOSMesa calls none of those names through the linker) and the sanitizers forbid
// it.
constexpr int kOpenFlags = RTLD_NOW | RTLD_LOCAL;

}  // namespace

SharedLibrary SharedLibrary::open(const char* who, std::span<const char* const> names, const char* remedy) {
    std::string reason;
    SharedLibrary library;
    library.who_ = who;
    for (const char* name : names) {
        library.handle_ = dlopen(name, kOpenFlags);
        library.name_ = name;
        if (library.handle_ != nullptr) return library;
        if (reason.empty()) {  // the first name is the usual one; the others fail the same way
            const char* text = dlerror();
            reason = std::string(name) + " cannot be opened (" + (text != nullptr ? text : "no reason given") + ")";
        }
    }
    throw ContextError(std::string(who) + " cannot start: " + reason + "; " + remedy);
}

SharedLibrary SharedLibrary::open_if_there(std::span<const char* const> names) {
    SharedLibrary library;
    for (const char* name : names) {
        library.handle_ = dlopen(name, kOpenFlags);
        library.name_ = name;
        if (library.handle_ != nullptr) break;
    }
    return library;
}

void* SharedLibrary::find(const char* function) const {
    return handle_ == nullptr ? nullptr : dlsym(handle_, function);
}

}  // namespace halfframe::platform
