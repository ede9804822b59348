// Draws one frame of built-in scenes and prints the traces of every GL call: preparing, drawing, reading back.
// Usage: trace_frame SCENE TIER [SCENE TIER]... Exit code 77: no context here.
#include <cstdio>
#include <map>
#include <string>

#include "content/content.h"
#include "engine/frame/renderer.h"
#include "platform/context.h"

using namespace halfframe;

namespace {

constexpr char kRecordMark = '\x1e';  // ASCII's record separator begins each trace

void trace(gl::EntryPoints& gl, const gl::Caps& caps, const Scene& scene, std::optional<Tier> tier) {
    const View view = view_of(scene.cameras.empty() ? camera_framing(Box{}, 1.0f) : scene.cameras.front(), 64, 64);
    gl.start_trace();
    Renderer renderer(gl, caps);
    renderer.prepare(scene,
                     plan_frame(scene, view, {.tier = tier, .arithmetic = Arithmetic::full}, caps, all_effects()));
    renderer.draw(view);
    (void)renderer.read_display();
    std::fputs(gl.trace_json().c_str(), stdout);
    gl.stop_trace();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3 || argc % 2 == 0) return 2;
    try {
        const platform::Context context = platform::Context::create({.backend = platform::Backend::egl});
        gl::EntryPoints gl(context.loader());
        const gl::Caps caps = gl::read_caps(gl);
        gl.restrict_to(caps);
        std::map<std::string, Scene> scenes;  // made once, drawn at several tiers
        for (int i = 1; i < argc; i += 2) {
            const auto [made, is_new] = scenes.try_emplace(argv[i]);
            if (is_new) made->second = content::open_scene(argv[i]);
            std::printf("%c%s %s\n", kRecordMark, argv[i], argv[i + 1]);
            trace(gl, caps, made->second, tier_from_name(argv[i + 1]));
        }
        return 0;
    } catch (const platform::ContextError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 77;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
