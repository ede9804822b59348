// The Filament peer: draws one model with Debian's Filament as the orders on standard input say, one JSON object a
// line. Needs an X display with GLX (Debian builds Filament for GLX alone): run it under xvfb-run.
#include <dlfcn.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

// First: a header of Filament defines a macro assert_invariant, which is a member function here.
#include <nlohmann/json.hpp>

#include <filament/Camera.h>
#include <filament/Engine.h>
#include <filament/IndirectLight.h>
#include <filament/LightManager.h>
#include <filament/RenderableManager.h>
#include <filament/Renderer.h>
#include <filament/Scene.h>
#include <filament/SwapChain.h>
#include <filament/Texture.h>
#include <filament/View.h>
#include <filament/Viewport.h>
#include <gltfio/AssetLoader.h>
#include <gltfio/FilamentAsset.h>
#include <gltfio/MaterialProvider.h>
#include <gltfio/ResourceLoader.h>
#include <image/KtxBundle.h>
#include <image/KtxUtility.h>
#include <utils/EntityManager.h>

#include "perf/peers/peer_orders.h"

namespace {

using Json = nlohmann::json;
using namespace filament;

constexpr float kPi = std::numbers::pi_v<float>;

math::float3 vector_from(const Json& value) {
    return {value[0].get<float>(), value[1].get<float>(), value[2].get<float>()};
}

std::vector<std::uint8_t> bytes_of(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw std::runtime_error(file + " cannot be read");
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

/// The driver behind GLX on this display, in its own words (GLX_MESA_query_renderer). Filament gives it in no call; its
/// own context is made with the same libGL on the same display.
std::string driver() {
    void* x11 = dlopen("libX11.so.6", RTLD_NOW);
    void* gl = dlopen("libGL.so.1", RTLD_NOW);
    if (x11 == nullptr || gl == nullptr) return "unknown: libX11.so.6 or libGL.so.1 does not load";
    const auto open_display = reinterpret_cast<void* (*)(const char*)>(dlsym(x11, "XOpenDisplay"));
    const auto address = reinterpret_cast<void* (*)(const char*)>(dlsym(gl, "glXGetProcAddressARB"));
    const auto query = reinterpret_cast<const char* (*)(void*, int, int, int)>(address("glXQueryRendererStringMESA"));
    void* display = open_display(nullptr);
    if (display == nullptr) return "unknown: there is no X display";
    constexpr int kDeviceName = 0x8184;  // GLX_RENDERER_DEVICE_ID_MESA
    const char* name = query != nullptr ? query(display, 0, 0, kDeviceName) : nullptr;
    return name != nullptr ? name : "unknown: this GLX has no GLX_MESA_query_renderer";
}

/// Sends standard output elsewhere while it lives: Filament logs there, and answers must stay alone.
class QuietOutput {
public:
    QuietOutput() : saved_(dup(STDOUT_FILENO)) { dup2(STDERR_FILENO, STDOUT_FILENO); }
    QuietOutput(const QuietOutput&) = delete;
    QuietOutput& operator=(const QuietOutput&) = delete;
    ~QuietOutput() {
        std::fflush(stdout);
        dup2(saved_, STDOUT_FILENO);
        close(saved_);
    }

private:
    int saved_;
};

class Peer {
public:
    Json load(const Json& order);
    Json draw(int frames);
    Json picture(const std::string& file);

private:
    void add_camera(const Json& camera);
    void add_lights(const Json& order);
    void add_environment(const Json& order);
    void add_model(const std::string& file);
    void draw_and_wait();

    int width_ = 0;
    int height_ = 0;
    Engine* engine_ = nullptr;
    SwapChain* swap_chain_ = nullptr;
    Renderer* renderer_ = nullptr;
    Scene* scene_ = nullptr;
    View* view_ = nullptr;
    std::size_t renderables_ = 0;
};

Json Peer::load(const Json& order) {
    width_ = order["width"];
    height_ = order["height"];
    engine_ = Engine::create(Engine::Backend::OPENGL);
    if (engine_ == nullptr) throw std::runtime_error("Filament makes no engine; is there an X display with GLX?");
    swap_chain_ = engine_->createSwapChain(static_cast<std::uint32_t>(width_), static_cast<std::uint32_t>(height_));
    renderer_ = engine_->createRenderer();
    scene_ = engine_->createScene();
    view_ = engine_->createView();
    view_->setScene(scene_);
    view_->setViewport({0, 0, static_cast<std::uint32_t>(width_), static_cast<std::uint32_t>(height_)});
    view_->setPostProcessingEnabled(false);
    view_->setShadowingEnabled(false);
    view_->setAntiAliasing(View::AntiAliasing::NONE);
    view_->setDithering(View::Dithering::NONE);
    const math::float3 background = vector_from(order["background"]);
    renderer_->setClearOptions({.clearColor = {background, 1.0f}, .clear = true, .discard = true});
    add_camera(order["camera"]);
    add_lights(order);
    add_environment(order);
    add_model(order["model"]);
    draw_and_wait();
    return {{"renderer", driver()},
            {"version", "Filament " HALFFRAME_PEERS_FILAMENT_VERSION},
            {"lit_by", "environment"},
            {"draws", renderables_},
            {"notices", Json::array({"no tone map and no sRGB encoding: Filament does both in post-processing"})}};
}

void Peer::add_camera(const Json& camera_order) {
    Camera* camera = engine_->createCamera(utils::EntityManager::get().create());
    camera->setProjection(camera_order["fov_y_rad"].get<double>() * 180.0 / std::numbers::pi,
                          static_cast<double>(width_) / height_, camera_order["near_m"].get<double>(),
                          camera_order["far_m"].get<double>(), Camera::Fov::VERTICAL);
    math::mat4f world_from_view;
    for (std::size_t i = 0; i < 16; ++i)
        world_from_view[i / 4][i % 4] = camera_order["world_from_view"][i].get<float>();
    camera->setModelMatrix(world_from_view);
    camera->setExposure(1.0f, 1.2f, 100.0f);  // an exposure factor of 1 by Filament's formula, 1 / (1.2 * 2^EV100)
    view_->setCamera(camera);
}

/// halfframe's light colours are irradiance / pi; Filament wants lux and candela.
void Peer::add_lights(const Json& order) {
    for (const Json& sun : order["suns"]) {
        const utils::Entity entity = utils::EntityManager::get().create();
        LightManager::Builder(LightManager::Type::DIRECTIONAL)
            .color(vector_from(sun["color"]))
            .intensity(kPi)
            .direction(vector_from(sun["direction"]))
            .castShadows(false)
            .build(*engine_, entity);
        scene_->addEntity(entity);
    }
    for (const Json& point : order["points"]) {
        const utils::Entity entity = utils::EntityManager::get().create();
        // The colour is split so that none of its channels is above 1, as Filament asks.
        const math::float3 color = vector_from(point["color"]);
        const float strength = std::max({color.r, color.g, color.b, 1e-6f});
        LightManager::Builder(LightManager::Type::POINT)
            .color(color / strength)
            .intensityCandela(kPi * strength)
            .position(vector_from(point["position"]))
            .falloff(point["range_m"].get<float>())
            .castShadows(false)
            .build(*engine_, entity);
        scene_->addEntity(entity);
    }
}

/// `environment_ktx` was prefiltered by Filament's own cmgen.
void Peer::add_environment(const Json& order) {
    const auto bytes = bytes_of(order["environment_ktx"]);
    static image::KtxBundle bundle(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    math::float3 harmonics[9];
    if (!bundle.getSphericalHarmonics(harmonics)) throw std::runtime_error("cmgen left no spherical harmonics");
    Texture* reflections = image::ktx::createTexture(engine_, bundle, false, nullptr, nullptr);
    scene_->setIndirectLight(IndirectLight::Builder()
                                 .reflections(reflections)
                                 .irradiance(3, harmonics)
                                 .intensity(order["environment_scale"].get<float>())
                                 .build(*engine_));
    engine_->flushAndWait();
}

/// Keeps the renderables; the file's own lights and cameras are left out.
void Peer::add_model(const std::string& file) {
    gltfio::AssetLoader* loader =
        gltfio::AssetLoader::create({.engine = engine_, .materials = gltfio::createMaterialGenerator(engine_, true)});
    const auto bytes = bytes_of(file);
    const auto size = static_cast<std::uint32_t>(bytes.size());
    const bool binary = bytes.size() > 4 && std::string(bytes.begin(), bytes.begin() + 4) == "glTF";
    gltfio::FilamentAsset* asset =
        binary ? loader->createAssetFromBinary(bytes.data(), size) : loader->createAssetFromJson(bytes.data(), size);
    if (asset == nullptr) throw std::runtime_error("gltfio does not read " + file);
    gltfio::ResourceLoader resources({.engine = engine_,
                                      .gltfPath = file.c_str(),
                                      .normalizeSkinningWeights = true,
                                      .recomputeBoundingBoxes = false});
    if (!resources.loadResources(asset)) throw std::runtime_error("gltfio does not load the resources of " + file);
    for (std::size_t i = 0; i < asset->getEntityCount(); ++i) {
        const utils::Entity entity = asset->getEntities()[i];
        const auto instance = engine_->getRenderableManager().getInstance(entity);
        if (!instance) continue;
        renderables_ += engine_->getRenderableManager().getPrimitiveCount(instance);
        scene_->addEntity(entity);
    }
}

void Peer::draw_and_wait() {
    // beginFrame() says false to skip a frame when the queue is full; after a wait it is empty, but the pacing may
    // still say so: then the frame is begun again.
    while (!renderer_->beginFrame(swap_chain_)) engine_->flushAndWait();
    renderer_->render(view_);
    renderer_->endFrame();
    engine_->flushAndWait();  // ends in glFinish
}

Json Peer::draw(int frames) {
    draw_and_wait();  // wakes what fell asleep while the others drew
    const auto start = std::chrono::steady_clock::now();
    for (int frame = 0; frame < frames; ++frame) draw_and_wait();
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
    return {{"ms", taken.count()}};
}

Json Peer::picture(const std::string& file) {
    std::vector<std::uint8_t> rows(static_cast<std::size_t>(width_) * height_ * 4);
    while (!renderer_->beginFrame(swap_chain_)) engine_->flushAndWait();
    renderer_->render(view_);
    renderer_->readPixels(0, 0, static_cast<std::uint32_t>(width_), static_cast<std::uint32_t>(height_),
                          {rows.data(), rows.size(), backend::PixelDataFormat::RGBA, backend::PixelDataType::UBYTE});
    renderer_->endFrame();
    engine_->flushAndWait();
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(rows.data()), static_cast<std::streamsize>(rows.size()));
    return {{"file", file}, {"linear", true}};
}

}  // namespace

int main() {
    Peer peer;
    halfframe::peers::obey_orders([&peer](const Json& order) {
        const QuietOutput quiet;
        return halfframe::peers::answer(peer, order);
    });
    std::_Exit(0);  // the engine is not taken down: nothing outlives the process
}
