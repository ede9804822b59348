// What motion costs, by joint count: posing a scene, and drawing a skinned mesh in each way beside the same mesh at
// rest. Medians of one run; cases take turns, so that a change of the machine's pace meets them all. Judges nothing.
#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "engine/frame/pose.h"
#include "engine/frame/renderer.h"
#include "perf/report/text_table.h"
#include "platform/context.h"

namespace halfframe::bench {
namespace {

constexpr int kRows = 256, kColumns = 64;  // 16384 quads: enough that vertices, not pixels, are what is timed

double ms_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
    return values[values.size() / 2];
}

Mesh sheet(int joints) {
    Mesh mesh;
    mesh.name = "sheet";
    for (int row = 0; row <= kRows; ++row) {
        const float y = static_cast<float>(row) / kRows;
        const float place = y * static_cast<float>(joints - 1);
        const auto lower = static_cast<std::uint16_t>(std::min(static_cast<int>(place), joints - 1));
        const auto upper = static_cast<std::uint16_t>(std::min(lower + 1, joints - 1));
        const float share = place - static_cast<float>(lower);
        for (int column = 0; column <= kColumns; ++column) {
            mesh.positions.emplace_back(static_cast<float>(column) / kColumns - 0.5f, y, 0.0f);
            mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
            mesh.joints.emplace_back(lower, upper, 0, 0);
            mesh.weights.emplace_back(1.0f - share, share, 0.0f, 0.0f);
            if (row == 0 || column == 0) continue;
            const auto at = static_cast<std::uint32_t>(row * (kColumns + 1) + column);
            const std::uint32_t below = at - kColumns - 1;
            mesh.indices.insert(mesh.indices.end(), {below - 1, below, at, below - 1, at, at - 1});
        }
    }
    return mesh;
}

/// A sheet on a chain of `joints`, all of which turn; without a skin it stands still.
Scene chain(int joints, bool skinned) {
    Scene scene;
    scene.name = "chain";
    scene.meshes.push_back(sheet(joints));
    scene.materials.push_back({.name = "plain", .double_sided = true});
    scene.surfaces.push_back({.name = "sheet", .dynamic = skinned, .skin = skinned ? 0 : -1});
    scene.ambient = glm::vec3(0.5f);
    if (!skinned) return scene;
    Skin skin;
    Animation animation{.name = "wave", .channels = {}, .duration_s = 1.0f};
    const float step_m = 1.0f / static_cast<float>(std::max(joints - 1, 1));
    for (int joint = 0; joint < joints; ++joint) {
        scene.nodes.push_back(
            {.name = "joint", .parent = joint - 1, .translation = {0.0f, joint ? step_m : 0.0f, 0.0f}});
        skin.joints.push_back(joint);
        glm::mat4 joint_from_mesh(1.0f);
        joint_from_mesh[3].y = -step_m * static_cast<float>(joint);
        skin.joint_from_mesh.push_back(joint_from_mesh);
        const float half_rad = 0.2f / static_cast<float>(joints);
        animation.channels.push_back(
            {.node = joint,
             .value = AnimatedValue::rotation,
             .interpolation = Interpolation::linear,
             .times_s = {0.0f, 0.5f, 1.0f},
             .values = {0, 0, 0, 1, 0, 0, std::sin(half_rad), std::cos(half_rad), 0, 0, 0, 1}});
    }
    scene.skins.push_back(std::move(skin));
    scene.animations.push_back(std::move(animation));
    return scene;
}

struct Case {
    int joints = 0;  ///< 0: the sheet at rest
    std::string way;
    std::unique_ptr<Scene> scene;
    std::unique_ptr<Animator> animator;
    std::unique_ptr<Renderer> renderer;
    std::vector<double> pose_ms, frame_ms;
};

int run(int rounds, int side) {
    const platform::Context context = platform::Context::create({});
    gl::EntryPoints gl(context.loader());
    const gl::Caps caps = gl::read_caps(gl);
    std::vector<Case> cases;
    const auto add = [&](int joints, const char* way, std::optional<Skinning> skinning) {
        Case one{
            .joints = joints, .way = way, .scene = std::make_unique<Scene>(chain(std::max(joints, 1), joints > 0))};
        one.animator = std::make_unique<Animator>(*one.scene);
        one.renderer = std::make_unique<Renderer>(gl, caps, RendererDescription{.skinning = skinning});
        cases.push_back(std::move(one));
    };
    add(0, "at rest", std::nullopt);
    for (const int joints : {4, 16, 64}) {
        add(joints, "uniforms", Skinning::uniforms);
        add(joints, "texture", Skinning::texture);
        add(joints, "cpu", Skinning::cpu);
    }
    add(256, "texture", Skinning::texture);
    add(256, "cpu", Skinning::cpu);
    const View view = view_of(camera_framing(world_box(*cases[0].scene), 1.0f), side, side);
    for (Case& one : cases)
        one.renderer->prepare(*one.scene, plan_frame(*one.scene, view, {.tier = Tier::console}, caps, all_effects()));
    for (int round = 0; round <= rounds; ++round) {
        for (Case& one : cases) {
            auto start = std::chrono::steady_clock::now();
            one.animator->pose(*one.scene, one.joints > 0 ? 0 : -1, 0.37 * round);
            const double pose_ms = ms_since(start);
            start = std::chrono::steady_clock::now();
            one.renderer->draw(view);
            gl.Finish();
            if (round == 0) continue;  // shaders are finished in the first
            one.pose_ms.push_back(pose_ms);
            one.frame_ms.push_back(ms_since(start));
        }
    }
    using perf::Align;
    perf::TextTable table({{"joints", Align::right},
                           {"skinned", Align::left},
                           {"pose us", Align::right},
                           {"frame ms", Align::right},
                           {"of rest", Align::right}});
    const double rest_ms = median(cases[0].frame_ms);
    for (const Case& one : cases)
        table.add_row({std::to_string(one.joints), one.way, fmt::format("{:.1f}", 1e3 * median(one.pose_ms)),
                       fmt::format("{:.2f}", median(one.frame_ms)),
                       fmt::format("{:.2f}", median(one.frame_ms) / rest_ms)});
    fmt::print("{}\n{} vertices, {}x{}, console, {} rounds\n\n{}", context.description(),
               cases[0].scene->meshes[0].positions.size(), side, side, rounds, table.text());
    return 0;
}

}  // namespace
}  // namespace halfframe::bench

int main(int argc, char** argv) {
    int rounds = 50, side = 64;
    CLI::App app{"What posing and skinning cost by joint count: medians of one run"};
    app.add_option("--rounds", rounds, "Frames of every case")->check(CLI::Range(1, 100000));
    app.add_option("--side", side, "Of the square picture [pixels]")->check(CLI::Range(16, 4096));
    CLI11_PARSE(app, argc, argv);
    try {
        return halfframe::bench::run(rounds, side);
    } catch (const std::exception& error) {
        fmt::print(stderr, "halfframe_motion_bench: {}\n", error.what());
        return 1;
    }
}
