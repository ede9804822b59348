// Writes the trace of the sample frame to standard output.
#include <cstdio>

#include "platform/context.h"
#include "tests/gl/sample_frame.h"

int main() {
    using namespace halfframe;
    try {
        const platform::Context context = platform::Context::create({.backend = platform::Backend::egl});
        gl::EntryPoints gl(context.loader());
        const gl::Caps caps = gl::read_caps(gl);
        gl.restrict_to(caps);
        gl.start_trace();
        static_cast<void>(gl::draw_sample_frame(gl, caps));
        std::fputs(gl.trace_json().c_str(), stdout);
        return 0;
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "%s\n", problem.what());
        return 1;
    }
}
