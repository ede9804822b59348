// halfframe_count_bench: how the time of counting a frame grows with its draws. Prints medians, judges nothing, is no
// test. Drawing alone and drawing under the recorder take turns, so that a machine that slows down slows both.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include <fmt/format.h>

#include "content/content.h"
#include "content/shapes.h"
#include "engine/frame/renderer.h"
#include "perf/cost/counted_frame.h"
#include "perf/report/text_table.h"
#include "platform/context.h"

namespace halfframe::bench {
namespace {

constexpr int kRounds = 5;
constexpr int kWidth = 640;
constexpr int kHeight = 360;

/// `side` x `side` tiles over the same wall: as many draws, the same pixels.
Scene tiles(int side) {
    Scene scene;
    scene.name = "tiles";
    const float size_m = 8.0f / static_cast<float>(side);
    scene.meshes.push_back(content::quad({size_m, size_m}, glm::vec2(1.0f), 0.25f));
    scene.materials.emplace_back();
    for (int i = 0; i < side * side; ++i) {
        Surface tile;
        tile.world_from_local[3] = glm::vec4(size_m * (static_cast<float>(i % side) + 0.5f) - 4.0f,
                                             size_m * (static_cast<float>(i / side) + 0.5f) - 4.0f, 0.0f, 1.0f);
        scene.surfaces.push_back(tile);
    }
    scene.ambient = glm::vec3(0.1f);
    return scene;
}

View front() {
    Camera camera;
    camera.world_from_view[3] = {0.0f, 0.0f, 4.0f, 1.0f};
    camera.orthographic = true;
    camera.half_height_m = 2.2f;
    return view_of(camera, kWidth, kHeight);
}

template <typename Work>
double milliseconds(Work work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

void run() {
    const platform::Context context = platform::Context::create({.api = platform::Api::desktop});
    cost::DrawRecorder recorder(context.loader());
    gl::EntryPoints gl(recorder.loader());
    const gl::Caps caps = gl::read_caps(gl);
    gl.restrict_to(caps);
    using perf::Align;
    perf::TextTable table({{"objects", Align::right},
                           {"draws", Align::right},
                           {"drawn ms", Align::right},
                           {"counted ms", Align::right},
                           {"us a draw more", Align::right}});
    for (const int side : {4, 8, 16, 32, 64}) {
        const Scene scene = tiles(side);
        const View view = front();
        Renderer renderer(gl, caps);
        renderer.prepare(scene, plan_frame(scene, view, {}, caps, all_effects()));
        renderer.draw(view);
        std::vector<double> drawn_ms, counted_ms;
        std::size_t draws = 0;
        for (int round = 0; round < kRounds; ++round) {
            gl.Finish();
            drawn_ms.push_back(milliseconds([&] {
                renderer.draw(view);
                gl.Finish();
            }));
            counted_ms.push_back(milliseconds([&] {
                recorder.start([&] { return std::string(gl.current_pass()); }, [](std::uint32_t) { return false; });
                renderer.draw(view);
                draws = recorder.finish().size();
            }));
        }
        const double more_us = 1e3 * (median(counted_ms) - median(drawn_ms)) / static_cast<double>(draws);
        table.add_row({std::to_string(side * side), std::to_string(draws), fmt::format("{:.2f}", median(drawn_ms)),
                       fmt::format("{:.2f}", median(counted_ms)), fmt::format("{:.1f}", more_us)});
    }
    std::fputs(table.text().c_str(), stdout);
}

}  // namespace
}  // namespace halfframe::bench

int main() {
    try {
        halfframe::bench::run();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "halfframe_count_bench: %s\n", error.what());
        return 1;
    }
    return 0;
}
