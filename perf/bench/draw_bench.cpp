// halfframe_draw_bench: what a draw costs the processor, beside replaying the same GL calls in a bare loop. Prints
// medians and a ratio, judges nothing, is no test.
//
// Objects are one small quad each into a picture of 16x16 pixels, so that the driver's drawing does not hide our part.
// Frames and replays take turns; the time is that of the calling thread alone, waits for the driver's threads excluded.
#include <ctime>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "content/content.h"
#include "content/shapes.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/renderer.h"
#include "engine/gl/call_number.h"
#include "perf/bench/call_recorder.h"
#include "perf/report/text_table.h"
#include "platform/context.h"

namespace halfframe::bench {
namespace {

struct Options {
    int objects = 10000, rounds = 21;
    Tier tier = Tier::console;
};

/// What a case has of everything that can make a draw dearer.
struct Case {
    std::string name;
    int materials = 8;
    int meshes = 16;
    int lamps = 0;
};

double thread_us() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e6 + static_cast<double>(now.tv_nsec) * 1e-3;
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

Image texture_of(int index) {
    Image image{.name = fmt::format("texture {}", index), .width = 4, .height = 4, .srgb = true, .rgba = {}};
    for (int i = 0; i < 64; ++i) image.rgba.push_back(static_cast<std::uint8_t>(97 * index + 13 * i));
    return image;
}

/// A square field of objects, each turned and of its own size, all in view.
Scene field(const Case& one, int objects) {
    Scene scene;
    scene.name = one.name;
    for (int i = 0; i < one.meshes; ++i)
        scene.meshes.push_back(content::quad({0.2f + 0.01f * static_cast<float>(i), 0.3f}, glm::vec2(1.0f), 1.0f));
    for (int i = 0; i < one.materials; ++i) {
        scene.images.push_back(texture_of(i));
        Material material;
        material.name = fmt::format("material {}", i);
        material.metallic = 0.0f;
        material.roughness = 0.4f;
        material.base_color_texture.image = i;
        scene.materials.push_back(material);
    }
    const int side = static_cast<int>(std::ceil(std::sqrt(objects)));
    for (int i = 0; i < objects; ++i) {
        Surface surface;
        surface.name = fmt::format("object {}", i);
        surface.mesh = i % one.meshes;
        surface.material = (i / 3) % one.materials;
        const float turn_rad = 0.1f * static_cast<float>(i);
        surface.world_from_local[0] = {std::cos(turn_rad), std::sin(turn_rad), 0.0f, 0.0f};
        surface.world_from_local[1] = {-std::sin(turn_rad), std::cos(turn_rad), 0.0f, 0.0f};
        surface.world_from_local[3] = {static_cast<float>(i % side) - 0.5f * static_cast<float>(side),
                                       static_cast<float>(i / side) - 0.5f * static_cast<float>(side), 0.0f, 1.0f};
        scene.surfaces.push_back(surface);
    }
    scene.ambient = glm::vec3(0.1f);
    scene.lights.push_back({.kind = LightKind::sun, .direction = glm::normalize(glm::vec3(0.3f, -0.4f, -1.0f))});
    for (int i = 0; i < one.lamps; ++i) {
        scene.lights.push_back(
            {.kind = LightKind::point, .position = {10.0f * static_cast<float>(i), 0.0f, 30.0f}, .range_m = 1000.0f});
    }
    return scene;
}

/// From above; the eye walks with every frame, so that the order of the draws changes.
View over(int objects, int frame) {
    Camera camera;
    camera.world_from_view[3] = {0.3f * static_cast<float>(frame % 16), 0.0f, 100.0f, 1.0f};
    camera.orthographic = true;
    camera.half_height_m = 10.0f + 0.6f * static_cast<float>(std::ceil(std::sqrt(objects)));
    return view_of(camera, 16, 16);
}

void run(gl::EntryPoints& gl, const gl::Caps& caps, const Options& options, perf::TextTable& table, const Case& one) {
    const Scene scene = field(one, options.objects);
    const View view = over(options.objects, 0);
    Wishes wishes{.tier = options.tier};
    for (const char* effect : {"depth_prepass", "bloom", "shadow", "anti_alias"})  // the surface pass alone counts
        wishes.effect_switches.emplace_back(effect, false);
    Renderer renderer(gl, caps);
    renderer.prepare(scene, plan_frame(scene, view, wishes, caps, all_effects()));
    renderer.draw(view);
    CallRecorder::start();
    renderer.draw(view);
    CallRecorder::stop();
    std::vector<double> ours_us, bare_us;
    for (int round = 0; round < options.rounds; ++round) {
        gl.Finish();
        double start = thread_us();
        renderer.draw(over(options.objects, round));
        ours_us.push_back(thread_us() - start);
        gl.Finish();
        start = thread_us();
        CallRecorder::replay();
        bare_us.push_back(thread_us() - start);
    }
    gl.Finish();
    const double ours = median(ours_us) / options.objects, bare = median(bare_us) / options.objects;
    table.add_row({one.name, fmt::format("{:.1f}", static_cast<double>(CallRecorder::calls()) / options.objects),
                   fmt::format("{:.3f}", ours), fmt::format("{:.3f}", bare), fmt::format("{:.3f}", ours - bare),
                   fmt::format("{:.2f}", ours / bare)});
}

int run_all(const Options& options) {
    using perf::Align;
    const platform::Context context = platform::Context::create({});
    gl::EntryPoints gl(CallRecorder::around(context.loader()));
    const gl::Caps caps = gl::read_caps(gl);
    perf::TextTable table({{"objects of", Align::left},
                           {"calls a draw", Align::right},
                           {"us a draw", Align::right},
                           {"bare loop", Align::right},
                           {"ours alone", Align::right},
                           {"ratio", Align::right}});
    for (const Case& one :
         {Case{.name = "8 materials, 16 meshes"}, Case{.name = "1 material, 1 mesh", .materials = 1, .meshes = 1},
          Case{.name = "64 materials, 256 meshes", .materials = 64, .meshes = 256},
          Case{.name = "8 materials, 2 lamps", .lamps = 2}}) {
        run(gl, caps, options, table, one);
    }
    fmt::print("{}\n{} objects, {}, medians of {} frames\n\n{}\n", context.description(), options.objects,
               name(options.tier), options.rounds, table.text());
    return 0;
}

}  // namespace
}  // namespace halfframe::bench

int main(int argc, char** argv) {
    using namespace halfframe;
    bench::Options options;
    std::string tier = "console";
    CLI::App app{"What a draw costs the processor, beside the same GL calls in a bare loop"};
    app.add_option("--objects", options.objects, "In the scene")->check(CLI::Range(1, 1000000));
    app.add_option("--rounds", options.rounds, "Frames of every case")->check(CLI::Range(1, 100000));
    app.add_option("--tier", tier)->check(CLI::IsMember({"low", "console", "reference"}));
    CLI11_PARSE(app, argc, argv);
    options.tier = tier_from_name(tier).value();  // CLI11 has checked it
    try {
        return bench::run_all(options);
    } catch (const std::exception& error) {
        fmt::print(stderr, "halfframe_draw_bench: {}\n", error.what());
        return 1;
    }
}
