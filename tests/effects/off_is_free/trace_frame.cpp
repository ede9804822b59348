// Draws one frame of built-in scenes and writes the traces of every GL call: preparing, drawing, reading back. Before
// each stand its scene, its tier and the effects that its plan has in.
// Usage: trace_frame FILE [SCENE TIER]... (none: every built-in scene at every tier). Exit code 77: no context here.
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "content/content.h"
#include "engine/error.h"
#include "engine/frame/renderer.h"
#include "platform/context.h"

using namespace halfframe;

namespace {

constexpr char kRecordMark = '\x1e';  // ASCII's record separator begins each trace

struct Frame {
    std::string scene;
    Tier tier;
};

std::vector<Frame> frames_asked_for(int argc, char** argv) {
    std::vector<Frame> frames;
    for (int i = 2; i < argc; i += 2) frames.push_back({argv[i], tier_from_name(argv[i + 1]).value()});
    if (!frames.empty()) return frames;
    for (const content::BuiltInScene& scene : content::built_in_scenes()) {
        for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
            frames.push_back({std::string(scene.name), tier});
        }
    }
    return frames;
}

std::string trace(gl::EntryPoints& gl, const gl::Caps& caps, const Scene& scene, const Frame& frame) {
    const View view = view_of(scene.cameras.empty() ? camera_framing(Box{}, 1.0f) : scene.cameras.front(), 64, 64);
    gl.start_trace();
    Renderer renderer(gl, caps);
    renderer.prepare(
        scene, plan_frame(scene, view, {.tier = frame.tier, .arithmetic = Arithmetic::full}, caps, all_effects()));
    renderer.draw(view);
    (void)renderer.read_display();
    std::string text = fmt::format("{}{} {}", kRecordMark, frame.scene, name(frame.tier));
    for (const EffectCard* card : all_effects()) {
        if (renderer.plan().find(card->name)->in) text += fmt::format(" {}", card->name);
    }
    text += "\n" + gl.trace_json();
    gl.stop_trace();
    return text;
}

/// The file until it is whole: gone again when anything ends the program before, but for what it cannot hear of.
class UnfinishedFile {
public:
    explicit UnfinishedFile(const std::string& whole) {
        std::snprintf(path, sizeof path, "%s.unfinished", whole.c_str());
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, &remove_and_die);
    }
    ~UnfinishedFile() { ::unlink(path); }
    UnfinishedFile(const UnfinishedFile&) = delete;
    UnfinishedFile& operator=(const UnfinishedFile&) = delete;

    static inline char path[4096] = "";  // what a signal's handler can read

private:
    static void remove_and_die(int signal) {
        ::unlink(path);
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
};

}  // namespace

int main(int argc, char** argv) {
    // It has no options: one would be the name of the file.
    if (argc < 2 || argc % 2 == 1 || *argv[1] == '-') return 2;
    const UnfinishedFile unfinished(argv[1]);
    try {
        const platform::Context context = platform::Context::create({.backend = platform::Backend::egl});
        gl::EntryPoints gl(context.loader());
        const gl::Caps caps = gl::read_caps(gl);
        gl.restrict_to(caps);
        std::ofstream file(UnfinishedFile::path, std::ios::binary);
        std::map<std::string, Scene> scenes;  // made once, drawn at several tiers
        for (const Frame& frame : frames_asked_for(argc, argv)) {
            const auto [made, is_new] = scenes.try_emplace(frame.scene);
            if (is_new) made->second = content::open_scene(frame.scene);
            file << trace(gl, caps, made->second, frame);
        }
        if (!file.flush()) throw Error(Fault::environment, std::string(UnfinishedFile::path) + " cannot be written");
        file.close();
        std::filesystem::rename(UnfinishedFile::path, argv[1]);
        return 0;
    } catch (const platform::ContextError& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 77;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
