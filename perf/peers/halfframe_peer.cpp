// The halfframe peer: draws one model through the public library as the orders on standard input say, one JSON object a
// line, answers on standard output. Usage: halfframe_peer TIER ARITHMETIC surface|constant|fetches [rgba16f]
#include <array>
#include <chrono>
#include <fstream>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>

#include "content/content.h"
#include "engine/effects.h"
#include "engine/error.h"
#include "engine/frame/renderer.h"
#include "perf/peers/environment.h"
#include "perf/peers/floor_card.h"
#include "perf/peers/peer_orders.h"
#include "platform/context.h"

namespace halfframe::peers {
namespace {

using Json = nlohmann::json;

glm::vec3 vector_from(const Json& value) {
    return {value[0].get<float>(), value[1].get<float>(), value[2].get<float>()};
}

void set_lights(Scene& scene, const Json& order) {
    scene.lights.clear();  // the file's own are left out, as in every peer
    for (const Json& value : order["suns"]) {
        Light sun;
        sun.kind = LightKind::sun;
        sun.name = "sun";
        sun.direction = vector_from(value["direction"]);
        sun.color = vector_from(value["color"]);
        scene.lights.push_back(sun);
    }
    for (const Json& value : order["points"]) {
        Light point;
        point.kind = LightKind::point;
        point.name = "point";
        point.position = vector_from(value["position"]);
        point.color = vector_from(value["color"]);
        point.range_m = value["range_m"];
        scene.lights.push_back(point);
    }
}

Camera camera_from(const Json& value) {
    Camera camera;
    for (int i = 0; i < 16; ++i) glm::value_ptr(camera.world_from_view)[i] = value["world_from_view"][i].get<float>();
    camera.fov_y_rad = value["fov_y_rad"];
    camera.near_m = value["near_m"];
    camera.far_m = value["far_m"];
    return camera;
}

class Peer {
public:
    Peer(Wishes wishes, std::span<const EffectCard* const> cards)
        : wishes_(std::move(wishes)),
          cards_(cards),
          context_(platform::Context::create({})),
          gl_(context_.loader()),
          caps_(gl::read_caps(gl_)) {
        gl_.restrict_to(caps_);
    }

    Json load(const Json& order) {
        scene_ = content::load_gltf(order["model"].get<std::string>());
        set_lights(scene_, order);
        scene_.background = vector_from(order["background"]);
        add_environment(scene_, order["environment"].get<std::string>(), order["environment_scale"].get<float>());
        view_ = view_of(camera_from(order["camera"]), order["width"], order["height"]);
        const FramePlan plan = plan_frame(scene_, view_, wishes_, caps_, cards_);
        renderer_ = std::make_unique<Renderer>(gl_, caps_, RendererDescription{.effects = cards_});
        renderer_->prepare(scene_, plan);
        draw_and_wait();
        if (const std::string error = renderer_->first_gl_error(); !error.empty()) {
            throw Error(Fault::check, "GL reports " + error + " after the first frame");
        }
        std::string passes;
        for (const Pass& pass : plan.passes) passes += (passes.empty() ? "" : ", ") + pass.name;
        return {{"renderer", caps_.renderer},
                {"version", "halfframe " HALFFRAME_VERSION ", " + caps_.version},
                {"lit_by", "environment"},
                {"draws", scene_.surfaces.size()},
                {"notices", Json::array({fmt::format("passes: {}", passes)})}};
    }

    Json draw(int frames) {
        draw_and_wait();  // wakes what fell asleep while the others drew
        const auto start = std::chrono::steady_clock::now();
        for (int frame = 0; frame < frames; ++frame) draw_and_wait();
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
        return {{"ms", taken.count()}};
    }

    Json picture(const std::string& file) {
        draw_and_wait();
        const Picture picture = renderer_->read_display();
        std::ofstream stream(file, std::ios::binary);
        stream.write(reinterpret_cast<const char*>(picture.rgba.data()),
                     static_cast<std::streamsize>(picture.rgba.size()));
        if (!stream.flush()) throw Error(Fault::environment, file + " cannot be written");
        return {{"file", file}};
    }

private:
    void draw_and_wait() {
        renderer_->draw(view_);
        gl_.Finish();
    }

    Wishes wishes_;
    std::span<const EffectCard* const> cards_;
    platform::Context context_;
    gl::EntryPoints gl_;
    gl::Caps caps_;
    Scene scene_;
    View view_;
    std::unique_ptr<Renderer> renderer_;
};

int run(const std::string& tier_name, const std::string& arithmetic, const std::string& work,
        const std::string& storage) {
    static constexpr std::array<const EffectCard*, 2> kConstant = {&kConstantFloor, &kToneMap};
    static constexpr std::array<const EffectCard*, 2> kFetches = {&kFetchFloor, &kToneMap};
    Wishes wishes;
    wishes.tier = tier_from_name(tier_name);
    wishes.arithmetic = arithmetic == "half" ? Arithmetic::half : Arithmetic::full;
    if (!storage.empty()) wishes.storage = gl::PixelFormat::rgba16f;
    const bool known = wishes.tier && (storage.empty() || storage == "rgba16f") &&
                       (arithmetic == "half" || arithmetic == "full") &&
                       (work == "surface" || work == "constant" || work == "fetches");
    if (!known) {
        std::cerr << "usage: halfframe_peer low|console|reference half|full surface|constant|fetches [rgba16f]\n";
        return static_cast<int>(Fault::usage);
    }
    // What the peers draw too: no shadow, no bloom, no antialiasing.
    static constexpr std::array<const EffectCard*, 5> kLit = {&kSurface, &kDepthPrepass, &kEnvironment, &kTransparent,
                                                              &kToneMap};
    std::span<const EffectCard* const> cards = kLit;
    if (work == "constant") cards = kConstant;
    if (work == "fetches") cards = kFetches;
    Peer peer(wishes, cards);
    obey_orders([&peer](const Json& order) { return answer(peer, order); });
    return 0;
}

}  // namespace
}  // namespace halfframe::peers

int main(int argument_count, char** arguments) {
    try {
        return halfframe::peers::run(argument_count > 1 ? arguments[1] : "", argument_count > 2 ? arguments[2] : "",
                                     argument_count > 3 ? arguments[3] : "", argument_count > 4 ? arguments[4] : "");
    } catch (const std::exception& error) {
        std::cout << nlohmann::json{{"error", error.what()}}.dump() << std::endl;
        return 4;
    }
}
