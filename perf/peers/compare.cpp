// One model: start everybody, look at the pictures, measure in rounds.
#include "perf/peers/compare.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <iterator>
#include <memory>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "engine/error.h"
#include "perf/peers/comparison.h"
#include "perf/peers/environment.h"
#include "perf/peers/peer_process.h"
#include "perf/report/picture_file.h"

namespace halfframe::peers {
namespace {

using Json = nlohmann::json;

constexpr int kLoadTimeout_s = 300;  // three.js links its shaders, Filament generates its own: a minute here
constexpr int kDrawTimeout_s = 300;
/// 0 and 1 are the same in linear light and in every encoding, and no model here is magenta.
constexpr glm::vec3 kBackground{1.0f, 0.0f, 1.0f};
/// Mean radiance of the environment: with the rig's sun and points (0.77 together) nothing is black or white.
constexpr float kEnvironmentMean = 0.3f;
/// Edges are rasterised by the same driver from the same triangles: overlaps measured here are 0.999 and more. What is
/// below this misses a part, or stands elsewhere.
constexpr double kLeastOverlap = 0.98;
constexpr double kLeastCover = 0.02;

Json json_from(const glm::vec3& value) { return {value.x, value.y, value.z}; }

/// The camera and the lights of every peer: halfframe's own framing and studio rig, without its ambient.
Json load_order(Scene scene, const Model& model, const CompareRequest& request) {
    scene.lights.clear();
    scene.ambient = glm::vec3(0.0f);
    content::add_studio_rig(scene);
    const float aspect = static_cast<float>(request.width) / static_cast<float>(request.height);
    const Camera camera = close_camera(scene, aspect);
    Json matrix = Json::array();
    for (int i = 0; i < 16; ++i) matrix.push_back(glm::value_ptr(camera.world_from_view)[i]);
    const glm::vec3 mean = mean_radiance(request.environment);
    Json order = {{"do", "load"},
                  {"model", model.file},
                  {"width", request.width},
                  {"height", request.height},
                  {"background", json_from(kBackground)},
                  {"environment", request.environment},
                  {"environment_ktx", request.folder / "environment" / "environment_ibl.ktx"},
                  {"environment_scale", kEnvironmentMean / std::max({mean.r, mean.g, mean.b})},
                  {"suns", Json::array()},
                  {"points", Json::array()}};
    order["camera"] = {{"world_from_view", matrix},
                       {"fov_y_rad", camera.fov_y_rad},
                       {"near_m", camera.near_m},
                       {"far_m", camera.far_m}};
    for (const Light& light : scene.lights) {
        if (light.kind == LightKind::sun) {
            order["suns"].push_back({{"direction", json_from(light.direction)}, {"color", json_from(light.color)}});
        } else {
            order["points"].push_back({{"position", json_from(light.position)},
                                       {"color", json_from(light.color)},
                                       {"range_m", light.range_m}});
        }
    }
    return order;
}

/// A contestant with its process and its picture.
struct Running {
    std::unique_ptr<PeerProcess> process;
    Picture picture;
    std::vector<bool> mask;
};

Picture picture_of(PeerProcess& process, const CompareRequest& request) {
    const auto file = request.folder / "picture.rgba";
    const Json answer = process.ask({{"do", "picture"}, {"file", file}}, kDrawTimeout_s);
    std::ifstream stream(file, std::ios::binary);
    Picture picture{.width = request.width, .height = request.height, .rgba = {}};
    picture.rgba.assign(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
    std::filesystem::remove(file);
    const auto pixels = static_cast<std::size_t>(request.width) * static_cast<std::size_t>(request.height);
    if (picture.rgba.size() != 4 * pixels) throw Error(Fault::check, process.name() + " left no whole picture");
    if (answer.value("bottom_up", false)) flip(picture);
    if (answer.value("linear", false)) encode_srgb(picture);
    return picture;
}

std::string file_name(std::string text) {
    std::ranges::replace(text, ' ', '_');
    std::ranges::replace(text, '+', '_');
    return text;
}

/// Starts, loads, asks for the driver, and takes the picture.
Running start(Result& result, const Json& order, const Model& model, const CompareRequest& request) {
    const std::string& name = result.contestant.name;
    const auto stem = request.folder / file_name(model.name + "_" + name);
    Running running;
    running.process =
        std::make_unique<PeerProcess>(name, result.contestant.command, fmt::format("{}.log", stem.string()));
    const Json loaded = running.process->ask(order, kLoadTimeout_s);
    result.driver = loaded["renderer"];
    result.version = loaded["version"];
    result.lit_by = loaded["lit_by"];
    result.notices = loaded["notices"].get<std::vector<std::string>>();
    if (const auto sentence = refused_driver(name, result.driver)) throw Error(Fault::check, *sentence);
    running.picture = picture_of(*running.process, request);
    running.mask = cover(running.picture, kBackground);
    result.covered = fraction(running.mask);
    result.brightness = mean_brightness(running.picture, running.mask);
    result.picture = fmt::format("{}.png", stem.string());
    perf::write_png(result.picture, running.picture);
    if (result.covered < kLeastCover) {
        throw Error(Fault::check, fmt::format("{} draws next to nothing: {:.2f} % of the picture is covered; see {}",
                                              name, result.covered * 100.0, result.picture.string()));
    }
    return running;
}

/// Who covers other pixels than console+full does not draw the same thing.
void check_overlaps(Comparison& comparison, std::vector<Running>& running) {
    const auto reference = std::ranges::find_if(
        comparison.results, [](const Result& result) { return result.contestant.name == kConsole; });
    if (reference == comparison.results.end() || reference->refused) return;
    const std::vector<bool> mask = running[static_cast<std::size_t>(reference - comparison.results.begin())].mask;
    for (std::size_t i = 0; i < running.size(); ++i) {
        Result& result = comparison.results[i];
        if (result.refused) continue;
        result.overlap = overlap(running[i].mask, mask);
        if (result.overlap < kLeastOverlap) {
            result.refused =
                fmt::format("{} and {} share only {:.1f} % of the pixels that either covers; see {}",
                            result.contestant.name, kConsole, 100.0 * result.overlap, result.picture.string());
        }
    }
}

/// Half the size, three in a row.
void write_sheet(const std::filesystem::path& file, const std::vector<Running>& running) {
    std::vector<const Picture*> pictures;
    for (const Running& each : running) {
        if (!each.picture.rgba.empty()) pictures.push_back(&each.picture);
    }
    if (pictures.empty()) return;
    const int width = pictures[0]->width / 2, height = pictures[0]->height / 2;
    const int rows = (static_cast<int>(pictures.size()) + 2) / 3;
    Picture sheet{.width = 3 * width, .height = rows * height, .rgba = {}};
    sheet.rgba.resize(static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height) * 4);
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const int left = static_cast<int>(i % 3) * width, top = static_cast<int>(i / 3) * height;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const std::size_t from = 4 * (static_cast<std::size_t>(2 * y) * pictures[i]->width + 2 * x);
                const std::size_t to = 4 * (static_cast<std::size_t>(top + y) * sheet.width + left + x);
                std::copy_n(pictures[i]->rgba.begin() + static_cast<std::ptrdiff_t>(from), 4,
                            sheet.rgba.begin() + static_cast<std::ptrdiff_t>(to));
            }
        }
    }
    perf::write_png(file, sheet);
}

/// One contestant draws `frames` frames: milliseconds and processor milliseconds a frame, and what others used.
void draw_batch(Result& result, PeerProcess& process, int frames, std::vector<double>& others_share) {
    const auto start = std::chrono::steady_clock::now();
    const double busy_before = busy_s();
    const double own_before = process.processor_s();
    const Json answer = process.ask({{"do", "draw"}, {"frames", frames}}, kDrawTimeout_s);
    const double own_s = process.processor_s() - own_before;
    const double busy = busy_s() - busy_before;
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
    result.ms.push_back(answer["ms"].get<double>() / frames);
    result.processor_ms.push_back(1000.0 * own_s / (frames + 1));  // with the frame that wakes it up
    const double all_s = wall.count() * static_cast<double>(sysconf(_SC_NPROCESSORS_ONLN));
    others_share.push_back(std::max(busy - own_s, 0.0) / all_s);
}

void measure(Comparison& comparison, std::vector<Running>& running, const CompareRequest& request) {
    std::vector<std::size_t> ready;
    for (std::size_t i = 0; i < running.size(); ++i) {
        if (!comparison.results[i].refused) ready.push_back(i);
    }
    for (const std::size_t i : ready) {  // warm, and learn how many frames fill a batch
        const Json answer = running[i].process->ask({{"do", "draw"}, {"frames", 3}}, kDrawTimeout_s);
        comparison.results[i].frames = frames_for(answer["ms"].get<double>() / 3.0, request.batch_ms);
    }
    for (int round = 0; round < request.rounds; ++round) {
        request.say(fmt::format("{}: round {} of {}", comparison.model.name, round + 1, request.rounds));
        for (const int turn : order_of_round(static_cast<int>(ready.size()), round)) {
            const std::size_t i = ready[static_cast<std::size_t>(turn)];
            Result& result = comparison.results[i];
            draw_batch(result, *running[i].process, result.frames, comparison.others_share);
        }
    }
}

}  // namespace

Comparison compare(const Model& model, const std::vector<Contestant>& contestants, const CompareRequest& request) {
    const Scene scene = content::load_gltf(model.file);
    Comparison comparison{.model = model,
                          .triangles = triangle_count(scene),
                          .surfaces = scene.surfaces.size(),
                          .results = {},
                          .others_share = {}};
    const Json order = load_order(scene, model, request);
    std::vector<Running> running;
    for (const Contestant& contestant : contestants) {
        request.say(fmt::format("{}: {} starts", model.name, contestant.name));
        Result& result = comparison.results.emplace_back();
        result.contestant = contestant;
        try {
            running.push_back(start(result, order, model, request));
        } catch (const Error& error) {
            result.refused = error.what();
            running.emplace_back();
        }
    }
    check_overlaps(comparison, running);
    write_sheet(request.folder / (file_name(model.name) + ".png"), running);
    measure(comparison, running, request);
    return comparison;
}

}  // namespace halfframe::peers
