// A program that lends its context goes on using it: what it leaves in GL state between frames must not show.
// The table holds the state that the renderer sets itself, each left in the way that would harm most.
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "engine/frame/renderer.h"
#include "tests/harness/gl_fixture.h"
#include "tests/harness/image_compare.h"

namespace halfframe {
namespace {

using harness::Ground;

constexpr int kWidth = 96;  // pixels
constexpr int kHeight = 64;

/// The host's own GL calls, past our table of entry points as a host's are.
class Host {
public:
    explicit Host(const platform::Context& context) : context_(context) {}
    template <typename Function, typename... Arguments>
    auto call(const char* name, Arguments... arguments) const {
        return reinterpret_cast<Function>(context_.function(name))(arguments...);
    }

private:
    const platform::Context& context_;
};
#define HOST(name, ...) host.call<decltype(&gl##name)>("gl" #name, __VA_ARGS__)

struct Habit {
    const char* name;
    std::function<void(const Host&)> leave;
};

GLuint made(const Host& host, const char* generate) {
    GLuint name = 0;
    host.call<decltype(&glGenTextures)>(generate, 1, &name);  // every glGen* has this shape
    return name;
}

const std::vector<Habit>& habits() {
    static const std::vector<Habit> list{
        {"masks shut",
         [](const Host& host) {
             constexpr GLboolean kShut = GL_FALSE;
             HOST(ColorMask, kShut, kShut, kShut, kShut);
             HOST(DepthMask, kShut);
         }},
        {"depth test that never passes",
         [](const Host& host) {
             HOST(Enable, GL_DEPTH_TEST);
             HOST(DepthFunc, GL_NEVER);
         }},
        {"blending on", [](const Host& host) { HOST(Enable, GL_BLEND); }},
        {"culling on", [](const Host& host) { HOST(Enable, GL_CULL_FACE); }},
        {"scissor and stencil tests",
         [](const Host& host) {
             HOST(Enable, GL_SCISSOR_TEST);
             HOST(Scissor, 2, 2, 3, 3);
             HOST(Enable, GL_STENCIL_TEST);
             HOST(StencilFunc, GL_NEVER, 1, 0xffu);
         }},
        {"front faces turned round and culled",
         [](const Host& host) {
             HOST(FrontFace, GL_CW);
             HOST(CullFace, GL_FRONT);
         }},
        {"another way to blend",
         [](const Host& host) {
             HOST(BlendFunc, GL_ONE, GL_ONE);
             HOST(BlendEquation, GL_FUNC_REVERSE_SUBTRACT);
         }},
        {"another depth range", [](const Host& host) { HOST(DepthRangef, 0.9f, 0.1f); }},
        {"polygon offset",
         [](const Host& host) {
             HOST(Enable, GL_POLYGON_OFFSET_FILL);
             HOST(PolygonOffset, -100.0f, -100000.0f);
         }},
        {"rasterizer discard", [](const Host& host) { HOST(Enable, GL_RASTERIZER_DISCARD); }},
        {"own samplers",
         [](const Host& host) {
             for (GLuint unit = 0; unit < 8; ++unit) {
                 const GLuint sampler = made(host, "glGenSamplers");
                 HOST(BindSampler, unit, sampler);
                 HOST(SamplerParameteri, sampler, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
             }
         }},
        {"pixel rows with gaps",
         [](const Host& host) {
             HOST(PixelStorei, GL_PACK_SKIP_PIXELS, 1);
             HOST(PixelStorei, GL_PACK_ROW_LENGTH, 200);
             HOST(PixelStorei, GL_PACK_ALIGNMENT, 8);
         }},
        {"own pixel buffer",
         [](const Host& host) { HOST(BindBuffer, GL_PIXEL_PACK_BUFFER, made(host, "glGenBuffers")); }},
        {"clear values",
         [](const Host& host) {
             HOST(ClearColor, 1.0f, 0.0f, 1.0f, 1.0f);
             HOST(ClearDepthf, 0.0f);
         }},
        {"own framebuffer and viewport",
         [](const Host& host) {
             HOST(BindFramebuffer, GL_FRAMEBUFFER, made(host, "glGenFramebuffers"));
             HOST(Viewport, 3, 3, 5, 5);
         }},
        {"no program", [](const Host& host) { HOST(UseProgram, 0u); }},
        {"another active texture unit", [](const Host& host) { HOST(ActiveTexture, GL_TEXTURE5); }},
        {"own textures",
         [](const Host& host) {
             for (GLenum unit = 0; unit < 8; ++unit) {
                 HOST(ActiveTexture, GL_TEXTURE0 + unit);
                 HOST(BindTexture, GL_TEXTURE_2D, made(host, "glGenTextures"));
             }
         }},
        {"own buffers",
         [](const Host& host) {
             HOST(BindBuffer, GL_ARRAY_BUFFER, made(host, "glGenBuffers"));
             HOST(BindBuffer, GL_ELEMENT_ARRAY_BUFFER, made(host, "glGenBuffers"));
         }},
        {"own vertex array",
         [](const Host& host) {
             HOST(BindVertexArray, made(host, "glGenVertexArrays"));
             HOST(EnableVertexAttribArray, 7u);
         }},
    };
    return list;
}

/// A wall, and a glass before it: opaque and blended passes both draw.
Scene wall_and_glass() {
    Scene scene;
    scene.name = "wall and glass";
    Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
    mesh.normals.assign(3, {0, 0, 1});
    scene.meshes = {mesh};
    Material wall;
    wall.metallic = 0.0f;
    Material glass = wall;
    glass.alpha_mode = AlphaMode::blend;
    glass.base_color = {1, 0, 0, 0.5f};
    scene.materials = {wall, glass};
    scene.surfaces = {{.name = "wall", .material = 0}, {.name = "glass", .material = 1}};
    scene.surfaces[1].world_from_local[3] = {0.5f, 0, 0.3f, 1};
    scene.lights = {{.kind = LightKind::sun, .name = "sun", .direction = {0, 0, -1}}};
    return scene;
}

class HostState : public testing::TestWithParam<Tier> {};

INSTANTIATE_TEST_SUITE_P(Tiers, HostState, testing::Values(Tier::low, Tier::console),
                         [](const auto& tier) { return std::string(name(tier.param)); });

TEST_P(HostState, does_not_show_in_the_next_frame) {
    auto ground_or_reason = harness::make_ground({});
    if (!ground_or_reason.ground) GTEST_SKIP() << ground_or_reason.reason;
    Ground& ground = *ground_or_reason.ground;
    const Host host(ground.context);
    const Scene scene = wall_and_glass();
    Camera camera = camera_framing(world_box(scene), static_cast<float>(kWidth) / kHeight);
    const View view = view_of(camera, kWidth, kHeight);
    camera.world_from_view[3].x += 0.7f;
    const View other_view = view_of(camera, kWidth, kHeight);

    Wishes wishes;
    wishes.tier = GetParam();
    Renderer renderer(ground.gl, ground.caps);
    renderer.prepare(scene, plan_frame(scene, view, wishes, ground.caps, all_effects()));
    renderer.draw(view);
    const Picture expected = renderer.read_display();
    ASSERT_GT(harness::coverage(expected), 0.1);

    for (const Habit& habit : habits()) {
        SCOPED_TRACE(habit.name);
        renderer.draw(other_view);  // so that a frame that draws nothing shows an old picture that is wrong
        ASSERT_FALSE(harness::difference(renderer.read_display(), expected).exact());
        habit.leave(host);
        renderer.draw(view);
        EXPECT_TRUE(harness::same_picture(renderer.read_display(), expected, "host_state"));
        EXPECT_EQ(renderer.first_gl_error(), "");
    }
}

}  // namespace
}  // namespace halfframe
