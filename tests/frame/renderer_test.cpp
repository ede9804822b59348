// The renderer draws what the plan says, at every tier, arithmetic and storage, and the same every time.
#include "engine/frame/renderer.h"

#include <algorithm>
#include <array>

#include <gtest/gtest.h>

#include "content/content.h"
#include "tests/frame/planning.h"
#include "tests/harness/gl_fixture.h"
#include "tests/harness/image_compare.h"

namespace halfframe::tests {
namespace {

class RendererTest : public harness::GlFixture {};

TEST_F(RendererTest, DrawsEveryTierArithmeticAndStorage) {
    const Scene scene = content::open_scene("test_room");
    const View view = view_of(scene.cameras.at(0), 160, 90);
    const Picture shadowed = render(scene, view, {.tier = Tier::reference, .arithmetic = Arithmetic::full}).picture;
    const Picture sunny =
        render(scene, view,
               {.tier = Tier::reference, .effect_switches = {{"shadow", false}}, .arithmetic = Arithmetic::full})
            .picture;
    int drawn = 0;
    for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
        for (const Arithmetic arithmetic : {Arithmetic::half, Arithmetic::full}) {
            for (const gl::PixelFormat storage :
                 {gl::PixelFormat::rgba32f, gl::PixelFormat::rgba16f, gl::PixelFormat::r11g11b10f,
                  gl::PixelFormat::rgb10_a2, gl::PixelFormat::rgba8}) {
                if (!caps().renders[static_cast<std::size_t>(storage)]) continue;
                const auto rendered = render(scene, view, {.tier = tier, .arithmetic = arithmetic, .storage = storage});
                EXPECT_GT(harness::coverage(rendered.picture), 0.5);
                const Picture& expected = tier == Tier::low ? sunny : shadowed;  // walls cast nothing at low
                // Every tier shows the same room: the mean difference stays under 12 codes (low drops highlights of
                // local lights and lights by vertex), where an all-black or unlit picture is past 40.
                double sum = 0.0;
                for (std::size_t i = 0; i < expected.rgba.size(); ++i)
                    sum += std::abs(int{expected.rgba[i]} - int{rendered.picture.rgba[i]});
                EXPECT_LT(sum / static_cast<double>(expected.rgba.size()), 12.0)
                    << name(tier) << ' ' << name(arithmetic) << ' ' << name(storage);
                ++drawn;
            }
        }
    }
    EXPECT_GE(drawn, 12);
}

TEST_F(RendererTest, DrawsTheSamePictureTwice) {
    const Scene scene = content::open_scene("test_room");
    const View view = view_of(scene.cameras.at(0), 160, 90);
    const Picture first = render(scene, view).picture;
    EXPECT_TRUE(harness::same_picture(render(scene, view).picture, first, "twice"));
}

// ES 1.00 has no flat inputs: at low an interpolated constant may be off in its last bit. So far no code has moved.
TEST_F(RendererTest, UniformsHandedOnByVerticesMoveNoPixel) {
    if (!caps().gathers_uniforms) GTEST_SKIP() << caps().renderer << " hands none on";
    gl::Caps plain = caps();
    plain.gathers_uniforms = false;
    const Scene scene = content::open_scene("test_room");
    const View view = view_of(scene.cameras.at(0), 160, 90);
    for (const auto& [tier, arithmetic] :
         {std::pair{Tier::low, Arithmetic::full}, std::pair{Tier::console, Arithmetic::half},
          std::pair{Tier::console, Arithmetic::full}, std::pair{Tier::reference, Arithmetic::full}}) {
        std::vector<Picture> pictures;
        for (const gl::Caps* with : std::array<const gl::Caps*, 2>{&caps(), &plain}) {
            Renderer renderer(gl(), *with);
            renderer.prepare(scene, plan_frame(scene, view, {.tier = tier, .arithmetic = arithmetic}, *with,
                                               all_effects()));
            renderer.draw(view);
            pictures.push_back(renderer.read_display());
            EXPECT_EQ(with->gathers_uniforms,
                      std::ranges::any_of(renderer.programs().programs(), [](const gl::Program* program) {
                          return program->description().uniforms_by_vertex;
                      }));
        }
        EXPECT_TRUE(harness::same_picture(pictures[1], pictures[0], std::string("uniforms_") + name(tier)))
            << name(tier) << ' ' << name(arithmetic);
    }
}

TEST_F(RendererTest, MakesTheSameTraceTwice) {
    const Scene scene = content::open_scene("test_room");
    const View view = view_of(scene.cameras.at(0), 64, 36);
    std::string traces[2];
    for (std::string& trace : traces) {
        auto [ground, reason] = harness::make_ground(wish());
        ASSERT_TRUE(ground) << reason;
        ground->gl.start_trace();
        (void)harness::render(*ground, scene, view);
        trace = ground->gl.trace_json();
    }
    EXPECT_GT(traces[0].size(), 1000u);
    EXPECT_EQ(traces[0], traces[1]);
    EXPECT_NE(traces[0].find("surface"), std::string::npos);
    EXPECT_NE(traces[0].find("glDrawElements"), std::string::npos);
}

TEST_F(RendererTest, CutsAMeshForADeviceWithSixteenBitIndices) {
    // 300 x 300 squares: 90,601 vertices, more than 65,536.
    Scene scene = square_scene();
    Mesh& mesh = scene.meshes[0];
    const int side = 301;
    mesh = {};
    mesh.name = "fine square";
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            mesh.positions.push_back(
                {static_cast<float>(x) / 300.0f - 0.5f, static_cast<float>(y) / 300.0f - 0.5f, 0.0f});
            mesh.normals.push_back({0.0f, 0.0f, 1.0f});
        }
    }
    for (std::uint32_t y = 0; y < 300; ++y) {
        for (std::uint32_t x = 0; x < 300; ++x) {
            const std::uint32_t i = y * side + x;
            mesh.indices.insert(mesh.indices.end(), {i, i + 1, i + side, i + 1, i + side + 1, i + side});
        }
    }
    scene.ambient = glm::vec3(0.5f);
    const View view = square_view();
    const Picture whole = render(scene, view).picture;
    gl::Caps narrow = caps();
    narrow.index_uint = false;
    gl().restrict_to(narrow);
    Renderer renderer(gl(), narrow);
    renderer.prepare(scene, plan_frame(scene, view, {}, narrow, all_effects()));
    renderer.draw(view);
    EXPECT_GT(renderer.mesh(0).parts.size(), 1u);
    EXPECT_TRUE(harness::same_picture(renderer.read_display(), whole, "cut_mesh"));
    EXPECT_EQ(renderer.first_gl_error(), "");
}

TEST_F(RendererTest, TwoRenderersShareAContext) {
    const Scene room = content::open_scene("test_room");
    const Scene square = square_scene();
    const View room_view = view_of(room.cameras.at(0), 64, 36), view = square_view();
    const Picture alone = render(room, room_view).picture;
    Renderer first(gl(), caps()), second(gl(), caps());
    first.prepare(room, plan_frame(room, room_view, {}, caps(), all_effects()));
    second.prepare(square, plan_frame(square, view, {}, caps(), all_effects()));
    for (int frame = 0; frame < 2; ++frame) {
        first.draw(room_view);
        second.draw(view);
    }
    EXPECT_TRUE(harness::same_picture(first.read_display(), alone, "shared_context"));
}

TEST_F(RendererTest, AnEmptySceneIsItsBackground) {
    Scene scene;
    scene.name = "nothing";
    scene.background = {1.0f, 0.5f, 0.0f};
    Renderer renderer(gl(), caps());
    const View view = square_view(8, 8);
    renderer.prepare(scene, plan_frame(scene, view, {}, caps(), all_effects()));
    renderer.draw(view);
    const Picture picture = renderer.read_display();
    EXPECT_EQ(picture.rgba[0], 255);
    EXPECT_EQ(picture.rgba[1], 128);
    EXPECT_EQ(picture.rgba[2], 0);
    EXPECT_EQ(gl().ledger.program_links(), 0u) << "nothing is compiled for a scene that calls for nothing";
}

TEST_F(RendererTest, TheBackgroundLooksTheSameOnEveryRung) {
    Scene scene = square_scene();
    scene.background = {0.2f, 0.4f, 0.8f};
    for (const gl::PixelFormat storage :
         {gl::PixelFormat::rgba16f, gl::PixelFormat::r11g11b10f, gl::PixelFormat::rgb10_a2, gl::PixelFormat::rgba8}) {
        if (!caps().renders[static_cast<std::size_t>(storage)]) continue;
        const Picture picture = render(scene, square_view(), {.storage = storage}).picture;
        EXPECT_NEAR(picture.rgba[0], 51, 2)
            << name(storage);  // 2 codes: R11G11B10F keeps 6 bits and llvmpipe truncates
        EXPECT_NEAR(picture.rgba[1], 102, 2) << name(storage);
        EXPECT_NEAR(picture.rgba[2], 204, 4) << name(storage);  // blue keeps 5 bits
    }
}

TEST_F(RendererTest, PreparesAgainWithoutCompilingAgain) {
    const Scene scene = content::open_scene("test_room");
    const View view = view_of(scene.cameras.at(0), 32, 32);
    Renderer renderer(gl(), caps());
    renderer.prepare(scene, plan_frame(scene, view, {}, caps(), all_effects()));
    const std::size_t bytes = renderer.texture_bytes();
    EXPECT_GT(bytes, 0u);
    const int compiled = renderer.programs().statistics().compiled + renderer.programs().statistics().from_disk;
    renderer.prepare(scene, plan_frame(scene, view, {}, caps(), all_effects()));
    EXPECT_EQ(renderer.texture_bytes(), bytes);
    EXPECT_EQ(renderer.programs().statistics().compiled + renderer.programs().statistics().from_disk, compiled);
}

}  // namespace
}  // namespace halfframe::tests
