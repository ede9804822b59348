// A pass of many triangles is flushed on its way where the driver draws nothing before, and nowhere else; no pixel
// moves.
#include "engine/frame/early_flush.h"

#include <array>
#include <optional>

#include <gtest/gtest.h>

#include "content/content.h"
#include "engine/frame/renderer.h"
#include "engine/gl/call_number.h"
#include "tests/frame/counted_new.h"
#include "tests/harness/gl_fixture.h"
#include "tests/harness/image_compare.h"

namespace halfframe::tests {
namespace {

constexpr int kTriangles = 10'000;  // of every surface here: four of them are past the bound, three are not
static_assert(kFlushTriangles > 3 * kTriangles && kFlushTriangles <= 4 * kTriangles);

/// A band of waves along x, of kTriangles triangles; as points, of as many points.
Mesh band(Primitive primitive, bool indexed) {
    Mesh mesh;
    mesh.primitive = primitive;
    const int corners = primitive == Primitive::points ? kTriangles : kTriangles + 2;
    for (int i = 0; i < corners; ++i) {
        const float x = static_cast<float>(i) / static_cast<float>(corners);
        const bool far = primitive == Primitive::triangle_fan ? i > 0 : i % 2 == 1;
        mesh.positions.emplace_back(x, far ? 1.0f : 0.0f, 0.1f * std::sin(40.0f * x));
        mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
    }
    for (std::uint32_t i = 0; indexed && primitive == Primitive::triangles && i < kTriangles; ++i)
        mesh.indices.insert(mesh.indices.end(), {i + i % 2, i + 1 - i % 2, i + 2});
    for (std::uint32_t i = 0; indexed && primitive != Primitive::triangles && i < static_cast<std::uint32_t>(corners);
         ++i)
        mesh.indices.push_back(i);
    if (primitive == Primitive::triangles && !indexed) {  // as a list, every corner its own
        const Mesh strip = mesh;
        mesh.positions.clear();
        for (std::size_t i = 0; i < kTriangles; ++i) {
            for (const std::size_t corner : {i + i % 2, i + 1 - i % 2, i + 2})
                mesh.positions.push_back(strip.positions[corner]);
        }
        mesh.normals.assign(mesh.positions.size(), glm::vec3(0.0f, 0.0f, 1.0f));
    }
    return mesh;
}

/// `count` bands one behind the other, in part over each other.
Scene bands(int count, Primitive primitive = Primitive::triangles, bool indexed = true) {
    Scene scene;
    scene.name = "bands";
    scene.meshes = {band(primitive, indexed)};
    scene.materials = {Material{.double_sided = true}};
    scene.lights = {{.kind = LightKind::sun, .color = glm::vec3(2.0f), .direction = {0.3f, -0.2f, -1.0f}}};
    for (int i = 0; i < count; ++i) {
        Surface surface{.name = "band"};
        surface.world_from_local[3] = glm::vec4(0.03f * static_cast<float>(i), 0.05f * static_cast<float>(i % 5),
                                                -0.2f * static_cast<float>(i), 1.0f);
        scene.surfaces.push_back(surface);
    }
    return scene;
}

class EarlyFlush : public harness::GlFixture {
protected:
    struct Drawn {
        std::uint32_t flushes = 0;      ///< of one frame
        std::uint32_t in_pass = 0;      ///< of those, in the pass that draws the bands
        std::uint64_t allocations = 0;  ///< of that frame
        Picture picture;
    };
    /// The second frame of a renderer whose driver is told, or is not.
    Drawn draw(const Scene& scene, bool told, Wishes wishes = {}, const char* pass = "surface") {
        gl::Caps with = caps();
        with.rasters_at_flush = told;
        Renderer renderer(gl(), with);
        const View view = view_of(camera_framing(world_box(bands(12)), 1.5f), 96, 64);
        wishes.effect_switches.emplace_back("shadow", false);  // its map is another pass, and not drawn every frame
        renderer.prepare(scene, plan_frame(scene, view, wishes, with, all_effects()));
        renderer.draw(view);
        gl().ledger.clear();
        const std::uint64_t before = heap_allocations();
        renderer.draw(view);
        Drawn drawn{.allocations = heap_allocations() - before};
        const int call = gl::number(gl::Call::Flush);
        drawn.flushes = static_cast<std::uint32_t>(gl().ledger.total(call));
        drawn.in_pass = gl().ledger.pass(gl().ledger.pass_index(pass)).count[static_cast<std::size_t>(call)];
        drawn.picture = renderer.read_display();
        EXPECT_EQ(renderer.first_gl_error(), "");
        EXPECT_GT(harness::coverage(drawn.picture), 0.05);  // one of twelve bands: 0.07
        return drawn;
    }
};

TEST_F(EarlyFlush, ComesWhereAsMuchIsDrawnAsIsToCome) {
    struct Row {
        int bands;
        std::uint32_t flushes;
    };
    for (const auto& [count, flushes] : {Row{1, 0}, Row{4, 0}, Row{7, 0}, Row{8, 1}, Row{11, 1}, Row{12, 2}}) {
        const Drawn told = draw(bands(count), true);
        EXPECT_EQ(told.flushes, flushes) << count << " bands of " << kTriangles << " triangles";
        EXPECT_EQ(told.in_pass, told.flushes) << count;
        EXPECT_EQ(told.allocations, 0u) << count;
        EXPECT_EQ(draw(bands(count), false).flushes, 0u) << count;
    }
}

TEST_F(EarlyFlush, CountsTrianglesOfEveryPrimitive) {
    for (const Primitive primitive : {Primitive::triangles, Primitive::triangle_strip, Primitive::triangle_fan}) {
        for (const bool indexed : {false, true})
            EXPECT_EQ(draw(bands(12, primitive, indexed), true).flushes, 2u)
                << static_cast<int>(primitive) << (indexed ? " indexed" : "");
    }
    for (const Primitive primitive : {Primitive::points, Primitive::lines, Primitive::line_strip})
        EXPECT_EQ(triangles_in(primitive, kTriangles), 0) << static_cast<int>(primitive);
    for (const Primitive primitive : {Primitive::triangles, Primitive::triangle_strip, Primitive::triangle_fan}) {
        for (int corners = 0; corners < 3; ++corners) EXPECT_EQ(triangles_in(primitive, corners), 0) << corners;
        EXPECT_EQ(triangles_in(primitive, 3), 1);
    }
}

TEST_F(EarlyFlush, CountsOnlyWhatTheCameraSees) {
    Scene scene = bands(12);
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
        if (i % 12 >= 7) scene.surfaces[i].world_from_local[3].x = 500.0f;
    }
    EXPECT_EQ(draw(scene, true).flushes, 0u);
}

TEST_F(EarlyFlush, BeginsToCountAnewInEveryPass) {
    Scene scene = bands(12);
    Material glass = scene.materials[0];
    glass.alpha_mode = AlphaMode::blend;
    glass.base_color.a = 0.5f;
    scene.materials.push_back(glass);
    for (std::size_t i = 0; i < 6; ++i) scene.surfaces[2 * i].material = 1;
    EXPECT_EQ(draw(scene, true).flushes, 0u) << "six bands in each of two passes";
    for (Surface& surface : scene.surfaces) surface.material = 1;
    const Drawn told = draw(scene, true, {}, "transparent");
    EXPECT_EQ(told.flushes, 2u);
    EXPECT_EQ(told.in_pass, 2u);
}

TEST_F(EarlyFlush, MovesNoPixel) {
    for (const Tier tier : {Tier::low, Tier::console, Tier::reference}) {
        const Drawn told = draw(bands(12), true, {.tier = tier});
        EXPECT_EQ(told.flushes, 2u) << name(tier);
        EXPECT_TRUE(harness::same_picture(told.picture, draw(bands(12), false, {.tier = tier}).picture,
                                          std::string("early_flush_") + name(tier)))
            << name(tier);
    }
}

// A frame of little triangles makes the calls that it made before there was any of this.
TEST_F(EarlyFlush, IsNotThereInAScene) {
    const Scene scene = content::open_scene("test_room");
    const View view = view_of(scene.cameras.at(0), 96, 64);
    gl().ledger.clear();
    (void)render(scene, view);
    EXPECT_EQ(gl().ledger.total(gl::number(gl::Call::Flush)), 0u);
}

TEST_F(EarlyFlush, IsForLlvmpipeAndNotForWhatItImitates) {
    EXPECT_EQ(caps().rasters_at_flush, caps().renderer.find("llvmpipe") != std::string::npos);
    gl::Caps told = caps();
    told.rasters_at_flush = true;
    EXPECT_FALSE(masked(told, {.name = "poorer"}).rasters_at_flush);
}

}  // namespace
}  // namespace halfframe::tests
