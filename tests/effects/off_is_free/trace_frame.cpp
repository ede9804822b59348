// Draws one frame of a built-in scene and prints the trace of every GL call: preparing, drawing, reading back.
// Usage: trace_frame SCENE TIER. Exit code 77: no context here.
#include <cstdio>
#include <string>

#include "content/content.h"
#include "engine/frame/renderer.h"
#include "platform/context.h"

using namespace halfframe;

int main(int argc, char** argv) {
    if (argc != 3) return 2;
    try {
        const platform::Context context = platform::Context::create({.backend = platform::Backend::egl});
        gl::EntryPoints gl(context.loader());
        const gl::Caps caps = gl::read_caps(gl);
        gl.restrict_to(caps);
        const Scene scene = content::open_scene(argv[1]);
        const View view = view_of(scene.cameras.empty() ? camera_framing(Box{}, 1.0f) : scene.cameras.front(), 64, 64);
        gl.start_trace();
        Renderer renderer(gl, caps);
        renderer.prepare(
            scene, plan_frame(scene, view, {.tier = tier_from_name(argv[2]), .arithmetic = Arithmetic::full}, caps,
                              all_effects()));
        renderer.draw(view);
        (void)renderer.read_display();
        std::fputs(gl.trace_json().c_str(), stdout);
        return 0;
    } catch (const platform::ContextError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 77;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
