// The same seed gives the same bits, another seed another street, and nobody sees a tile twice side by side.
#include <cstring>

#include <gtest/gtest.h>

#include "engine/error.h"
#include "tests/content/street/made_scenes.h"

namespace halfframe::tests {
namespace {

/// FNV-1a, 64 bits.
class Fingerprint {
public:
    void add(const void* data, std::size_t bytes) {
        const auto* at = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < bytes; ++i) value_ = (value_ ^ at[i]) * 1099511628211ull;
    }
    template <typename T>
    void add_all(const std::vector<T>& values) {
        add(values.data(), values.size() * sizeof(T));
    }
    [[nodiscard]] std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 14695981039346656037ull;
};

std::uint64_t fingerprint(const Scene& scene) {
    Fingerprint of;
    for (const Mesh& mesh : scene.meshes) {
        of.add_all(mesh.positions);
        of.add_all(mesh.normals);
        of.add_all(mesh.tangents);
        of.add_all(mesh.uv);
        of.add_all(mesh.colors);
        of.add_all(mesh.weights);
        of.add_all(mesh.indices);
    }
    for (const Image& image : scene.images) of.add_all(image.rgba);
    for (const Light& light : scene.lights) of.add(&light.position, sizeof light.position);
    for (const Animation& animation : scene.animations) {
        for (const AnimationChannel& channel : animation.channels) of.add_all(channel.values);
    }
    return of.value();
}

/// Of what is made with integers, sums, products, quotients and square roots alone: the same with every compiler.
std::uint64_t exact_fingerprint(const content::street::Street& street) {
    Fingerprint of;
    for (const Image& image : street.scene.images) of.add_all(image.rgba);
    for (const content::street::FacadePlan& plan : street.facades) {
        for (const content::street::FacadeTile& tile : plan.tiles) {
            const int values[4] = {tile.window, static_cast<int>(tile.shutters), static_cast<int>(tile.balcony),
                                   static_cast<int>(tile.growth)};
            of.add(values, sizeof values);
        }
    }
    return of.value();
}

TEST(MadeFromSeed, TheSameSeedGivesTheSameBits) {
    for (const char* name : {"street", "memory_room"}) {
        const std::uint64_t first = fingerprint(content::open_scene(name, {.seed = 7u}));
        EXPECT_EQ(fingerprint(content::open_scene(name, {.seed = 7u})), first) << name;
        EXPECT_NE(fingerprint(content::open_scene(name, {.seed = 8u})), first) << name;
        EXPECT_EQ(fingerprint(content::open_scene(name)), fingerprint(content::open_scene(name, {.seed = 2084u}))) << name;
    }
}

TEST(MadeFromSeed, PicturesAndPlansAreTheSameWithEveryCompiler) {
    // Noted from GCC 12, x86-64. A change of the art moves it: look at the street, then note the new one.
    EXPECT_EQ(exact_fingerprint(content::street::build_street(2084)), 2737777860852790886ull);
}

TEST(MadeFromSeed, ASceneWithoutASeedRefusesOne) {
    for (const char* scene : {"furnace", "test_room", "model.gltf"}) {
        try {
            (void)content::open_scene(scene, {.seed = 5u});
            FAIL() << scene << " took a seed";
        } catch (const Error& error) {
            EXPECT_EQ(error.fault(), Fault::usage) << scene;
            EXPECT_NE(std::string(error.what()).find("street, memory_room"), std::string::npos) << error.what();
        }
    }
}

void expect_no_repeats(const content::street::FacadePlan& plan, const std::string& what) {
    for (int floor = 0; floor < plan.floors; ++floor) {
        for (int column = 0; column < plan.columns; ++column) {
            const auto& tile = plan.at(column, floor);
            if (column > 0) {
                EXPECT_NE(tile.window, plan.at(column - 1, floor).window) << what << ' ' << column << ' ' << floor;
            }
            if (floor > 0) {
                EXPECT_NE(tile.window, plan.at(column, floor - 1).window) << what << ' ' << column << ' ' << floor;
            }
        }
    }
}

TEST(Facades, NoTileStandsBesideItsLike) {
    using content::street::FacadeKind;
    for (const FacadeKind kind : {FacadeKind::stone, FacadeKind::brick, FacadeKind::plaster}) {
        for (std::uint32_t seed = 0; seed < 200; ++seed) {
            expect_no_repeats(content::street::plan_facade(kind, 9, 6, {seed, 1}),
                              "kind " + std::to_string(static_cast<int>(kind)) + " seed " + std::to_string(seed));
        }
    }
    int kinds[3] = {};
    for (const std::uint32_t seed : kSeeds) {
        const auto street = content::street::build_street(seed);
        ASSERT_GT(street.facades.size(), 20u);
        for (const auto& plan : street.facades) {
            expect_no_repeats(plan, "street of seed " + std::to_string(seed));
            ++kinds[static_cast<int>(plan.kind)];
        }
    }
    for (const int count : kinds) EXPECT_GT(count, 3) << "three kinds of facade stand in the street";
}

TEST(Facades, ThePlanHasAllThatItPromises) {
    // Over 200 seeds every window, shutter and growth is drawn; about half of the windows are lit.
    int windows[16] = {};
    int growths[7] = {};
    int shutters[4] = {};
    int lit = 0;
    int all = 0;
    for (std::uint32_t seed = 0; seed < 200; ++seed) {
        for (const auto& tile :
             content::street::plan_facade(content::street::FacadeKind::plaster, 6, 5, {seed, 2}).tiles) {
            ++windows[tile.window];
            ++growths[static_cast<int>(tile.growth)];
            ++shutters[static_cast<int>(tile.shutters)];
            lit += tile.window >= 4 ? 1 : 0;
            ++all;
        }
    }
    for (const int count : windows) EXPECT_GT(count, 0);
    for (const int count : growths) EXPECT_GT(count, 0);
    for (const int count : shutters) EXPECT_GT(count, 0);
    EXPECT_NEAR(static_cast<double>(lit) / all, 0.54, 0.05);  // drawn at 0.53; neighbours that repeat are drawn anew
}

}  // namespace
}  // namespace halfframe::tests
