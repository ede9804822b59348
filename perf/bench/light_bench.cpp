// halfframe_bench: how the time of a frame grows with lights. Prints medians and ratios, judges nothing, is no test.
//
// Every case is prepared first and then drawn in turn, one frame of each a round, so that a machine that slows down
// slows all alike: ratios of one run can be compared, milliseconds of two runs cannot. A frame is timed from glFinish
// to glFinish, because timer queries of a software driver measure the submission.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "content/content.h"
#include "content/shapes.h"
#include "engine/effects/surface/surface.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/renderer.h"
#include "perf/report/text_table.h"
#include "platform/context.h"
#include "shaders_es/surface/surface_limits.h"

namespace halfframe::bench {
namespace {

constexpr int kTiles = 8;  // the wall is kTiles x kTiles objects of 1 m
constexpr float kWallDistance_m = 1.0f;

/// A wall that fills the picture, cut into 64 objects.
Scene wall() {
    Scene scene;
    scene.name = "wall";
    scene.meshes.push_back(content::quad({1.0f, 1.0f}, glm::vec2(1.0f), 0.25f));
    Material lacquer;
    lacquer.base_color = {0.3f, 0.3f, 0.35f, 1.0f};
    lacquer.metallic = 0.0f;
    lacquer.roughness = 0.4f;
    scene.materials.push_back(lacquer);
    for (int y = 0; y < kTiles; ++y) {
        for (int x = 0; x < kTiles; ++x) {
            Surface tile;
            tile.name = fmt::format("tile {} {}", x, y);
            tile.world_from_local[3] =
                glm::vec4(static_cast<float>(x) - 3.5f, static_cast<float>(y) - 3.5f, 0.0f, 1.0f);
            scene.surfaces.push_back(tile);
        }
    }
    scene.ambient = glm::vec3(0.1f);
    return scene;
}

/// `count` lights in front of the middle, each of which reaches every object.
Scene wall_with_lights(int count, LightKind kind, float radius_m) {
    Scene scene = wall();
    for (int i = 0; i < count; ++i) {
        const float turn_rad = 2.4f * static_cast<float>(i);
        scene.lights.push_back({.kind = kind,
                                .position = {2.0f * std::cos(turn_rad), 2.0f * std::sin(turn_rad), kWallDistance_m},
                                .direction = {0.0f, 0.0f, -1.0f},
                                .range_m = 100.0f,
                                .outer_cone_rad = 1.5f,
                                .radius_m = radius_m});
    }
    return scene;
}

/// 64 lights, one in front of every object, that reach `range_m`.
Scene wall_with_a_light_a_tile(float range_m) {
    Scene scene = wall();
    for (const Surface& tile : wall().surfaces) {
        scene.lights.push_back({.kind = LightKind::point,
                                .position = glm::vec3(tile.world_from_local[3]) + glm::vec3(0.0f, 0.0f, 0.25f),
                                .range_m = range_m});
    }
    return scene;
}

/// Lights that an object of the scene is drawn with, on average.
double lights_per_object(const Scene& scene) {
    double sum = 0.0;
    std::vector<int> lights;
    for (const Surface& surface : scene.surfaces) {
        int left_out = 0;
        const Box box =
            world_box(local_box(scene.meshes[static_cast<std::size_t>(surface.mesh)]), surface.world_from_local);
        lights_reaching(scene, box, SURFACE_LIGHT_LIMIT, lights, left_out);
        sum += static_cast<double>(lights.size());
    }
    return sum / static_cast<double>(scene.surfaces.size());
}

struct Case {
    std::string group;
    std::string name;
    std::unique_ptr<Scene> scene;  // the renderer keeps its address
    std::unique_ptr<Renderer> renderer;
    std::vector<double> frames_ms = {};
    [[nodiscard]] double median_ms() const {
        std::vector<double> sorted = frames_ms;
        std::ranges::sort(sorted);
        return sorted[sorted.size() / 2];
    }
};

struct Options {
    int width = 640, height = 360, rounds = 15;
    Tier tier = Tier::console;
    Arithmetic arithmetic = Arithmetic::full;
};

View front(const Options& options) {
    Camera camera;
    camera.world_from_view[3] = {0.0f, 0.0f, 4.0f, 1.0f};
    camera.orthographic = true;
    camera.half_height_m = 2.2f;  // 16:9 of it is inside the wall's 8 m
    return view_of(camera, options.width, options.height);
}

class Bench {
public:
    Bench(gl::EntryPoints& gl, const gl::Caps& caps, const Options& options)
        : gl_(gl), caps_(caps), options_(options), view_(front(options)) {}

    void add(const std::string& group, const std::string& name, Scene scene) {
        Case made{
            .group = group, .name = name, .scene = std::make_unique<Scene>(std::move(scene)), .renderer = nullptr};
        const Wishes wishes{.tier = options_.tier, .arithmetic = options_.arithmetic};
        made.renderer = std::make_unique<Renderer>(gl_, caps_);
        made.renderer->prepare(*made.scene, plan_frame(*made.scene, view_, wishes, caps_, all_effects()));
        made.renderer->draw(view_);
        cases_.push_back(std::move(made));
    }

    void run() {
        for (int round = 0; round < options_.rounds; ++round) {
            for (Case& one : cases_) {
                gl_.Finish();
                const auto start = std::chrono::steady_clock::now();
                one.renderer->draw(view_);
                gl_.Finish();
                one.frames_ms.push_back(
                    std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
            }
        }
    }

    [[nodiscard]] std::string text() const {
        using perf::Align;
        const double dark_ms = cases_.front().median_ms();
        perf::TextTable table({{"lights", Align::left},
                               {"", Align::left},
                               {"an object", Align::right},
                               {"median ms", Align::right},
                               {"of none", Align::right}});
        for (const Case& one : cases_) {
            if (&one != &cases_.front() && one.group != (&one - 1)->group) table.add_rule();
            table.add_row({one.group, one.name, fmt::format("{:.2f}", lights_per_object(*one.scene)),
                           fmt::format("{:.2f}", one.median_ms()), fmt::format("{:.2f}", one.median_ms() / dark_ms)});
        }
        return table.text();
    }

    /// Milliseconds that a light on every object adds: least squares over the cases of `group` and the one without.
    [[nodiscard]] std::string slope_text(const std::string& group) const {
        std::vector<std::pair<double, double>> points{{0.0, cases_.front().median_ms()}};
        for (const Case& one : cases_) {
            if (one.group == group) points.emplace_back(lights_per_object(*one.scene), one.median_ms());
        }
        double mean_x = 0.0, mean_y = 0.0, product = 0.0, square = 0.0;
        for (const auto& [x, y] : points) {
            mean_x += x / static_cast<double>(points.size());
            mean_y += y / static_cast<double>(points.size());
        }
        for (const auto& [x, y] : points) {
            product += (x - mean_x) * (y - mean_y);
            square += (x - mean_x) * (x - mean_x);
        }
        const double slope_ms = product / square;
        return fmt::format("{}: {:.3f} ms a light, {:.1f} ns a pixel, {:.3f} of the frame without lights\n", group,
                           slope_ms, slope_ms * 1e6 / (options_.width * options_.height),
                           slope_ms / cases_.front().median_ms());
    }

private:
    gl::EntryPoints& gl_;
    const gl::Caps& caps_;
    Options options_;
    View view_;
    std::vector<Case> cases_;
};

void add_cases(Bench& bench) {
    bench.add("none", "", wall());
    for (const int count : {1, 2, 4, 8})
        bench.add("points", fmt::format("{} everywhere", count), wall_with_lights(count, LightKind::point, 0.0f));
    for (const int count : {1, 8})
        bench.add("spots", fmt::format("{} everywhere", count), wall_with_lights(count, LightKind::spot, 0.0f));
    for (const int count : {1, 8})
        bench.add("spheres", fmt::format("{} everywhere", count), wall_with_lights(count, LightKind::point, 0.3f));
    for (const float range_m : {0.4f, 0.6f, 100.0f})
        bench.add("64 points", fmt::format("reach {} m", range_m), wall_with_a_light_a_tile(range_m));
}

int run(const Options& options) {
    const platform::Context context = platform::Context::create({});
    gl::EntryPoints gl(context.loader());
    const gl::Caps caps = gl::read_caps(gl);
    Bench bench(gl, caps, options);
    add_cases(bench);
    bench.run();
    fmt::print("{}\n{}x{}, {} {}, {} rounds\n\n{}\n", context.description(), options.width, options.height,
               name(options.tier), name(options.arithmetic), options.rounds, bench.text());
    for (const char* group : {"points", "spots", "spheres", "64 points"}) fmt::print("{}", bench.slope_text(group));
    return 0;
}

}  // namespace
}  // namespace halfframe::bench

int main(int argc, char** argv) {
    using namespace halfframe;
    bench::Options options;
    std::string tier = "console", arithmetic = "full";
    CLI::App app{"How the time of a frame grows with lights: medians and ratios of one run"};
    app.add_option("--width", options.width, "Of the picture [pixels]")->check(CLI::Range(16, 4096));
    app.add_option("--height", options.height, "Of the picture [pixels]")->check(CLI::Range(16, 4096));
    app.add_option("--rounds", options.rounds, "Frames of every case")->check(CLI::Range(1, 100000));
    app.add_option("--tier", tier)->check(CLI::IsMember({"low", "console", "reference"}));
    app.add_option("--arithmetic", arithmetic)->check(CLI::IsMember({"half", "full"}));
    CLI11_PARSE(app, argc, argv);
    options.tier = tier_from_name(tier).value();  // CLI11 has checked it
    options.arithmetic = arithmetic == "half" ? Arithmetic::half : Arithmetic::full;
    try {
        return bench::run(options);
    } catch (const std::exception& error) {
        fmt::print(stderr, "halfframe_bench: {}\n", error.what());
        return 1;
    }
}
