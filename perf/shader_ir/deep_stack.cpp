// A thread of POSIX: that of C++ has no size of its stack.
#include "perf/shader_ir/deep_stack.h"

#include <exception>

#include <pthread.h>

namespace halfframe::shader_ir {
namespace {

/// Half a million operators, the most that a megabyte of text has, of 2 KiB each. Memory is taken where it is touched.
constexpr std::size_t kStackBytes = std::size_t{1} << 30;

struct Work {
    const std::function<void()>* function;
    std::exception_ptr thrown = {};
};

void* run(void* argument) {
    Work& work = *static_cast<Work*>(argument);
    try {
        (*work.function)();
    } catch (...) {
        work.thrown = std::current_exception();
    }
    return nullptr;
}

}  // namespace

void on_deep_stack(const std::function<void()>& work) {
    Work ours{.function = &work};
    pthread_attr_t attributes;
    pthread_t thread{};
    pthread_attr_init(&attributes);
    pthread_attr_setstacksize(&attributes, kStackBytes);
    const bool started = pthread_create(&thread, &attributes, run, &ours) == 0;
    pthread_attr_destroy(&attributes);
    if (started) pthread_join(thread, nullptr);
    else run(&ours);
    if (ours.thrown) std::rethrow_exception(ours.thrown);
}

}  // namespace halfframe::shader_ir
