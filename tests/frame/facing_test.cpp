// Triangles in the order of where they face: no front is left out, backs are, and nothing is torn that was in order.
#include "engine/frame/facing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>

namespace halfframe {
namespace {

struct Shape {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
};

/// A ball of rings, whose rows of triangles go all the way round; fronts face outwards.
Shape ball(int slices = 48, int stacks = 31, float radius = 1.0f, const glm::vec3& centre = glm::vec3(0.0f)) {
    Shape shape;
    for (int stack = 0; stack <= stacks; ++stack) {
        for (int slice = 0; slice <= slices; ++slice) {
            const double down = 3.14159265358979 * stack / stacks, around = 6.28318530717959 * slice / slices;
            shape.positions.push_back(centre + radius * glm::vec3(std::sin(down) * std::sin(around), std::cos(down),
                                                                  std::sin(down) * std::cos(around)));
        }
    }
    for (int stack = 0; stack < stacks; ++stack) {
        for (int slice = 0; slice < slices; ++slice) {
            const auto at = [&](int s, int r) { return static_cast<std::uint32_t>(s * (slices + 1) + r); };
            shape.indices.insert(shape.indices.end(),
                                 {at(stack, slice), at(stack + 1, slice), at(stack, slice + 1), at(stack + 1, slice),
                                  at(stack + 1, slice + 1), at(stack, slice + 1)});
        }
    }
    return shape;
}

/// Triangles anywhere and facing anywhere, in an order without neighbours.
Shape splinters(unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    const auto anywhere = [&] { return glm::vec3(uniform(random), uniform(random), uniform(random)); };
    Shape shape;
    for (std::uint32_t i = 0; i < 4000; ++i) {
        const glm::vec3 at = anywhere();
        for (std::uint32_t corner = 0; corner < 3; ++corner) {
            shape.positions.push_back(at + 0.1f * anywhere());
            shape.indices.push_back(3 * i + corner);
        }
    }
    return shape;
}

View seen_from(const glm::vec3& eye, bool orthographic = false) {
    Camera camera;
    camera.world_from_view = glm::inverse(glm::lookAt(eye, glm::vec3(0.1f, 0.2f, -0.1f), glm::vec3(0.3f, 1.0f, 0.2f)));
    camera.orthographic = orthographic;
    camera.near_m = 0.01f;
    return view_of(camera, 160, 90);
}

std::vector<TriangleRange> ranges_of(const FacingGroups& groups, const glm::mat4& clip) {
    std::array<TriangleRange, kMostRanges> ranges;
    const std::size_t count = visible_ranges(groups, clip, ranges);
    return {ranges.begin(), ranges.begin() + static_cast<std::ptrdiff_t>(count)};
}

std::size_t triangles_in(const std::vector<TriangleRange>& ranges) {
    std::size_t sum = 0;
    for (const TriangleRange& range : ranges) sum += range.count;
    return sum;
}

/// Twice the area in the window of a triangle taken to clip coordinates, as the device judges it: above 0 is a front.
/// Of one that reaches behind the eye the sign is that of the part in front.
double area(const Shape& shape, std::size_t triangle, const glm::mat4& clip) {
    std::array<glm::dvec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec4 at = glm::dmat4(clip) * glm::dvec4(shape.positions[shape.indices[3 * triangle + i]], 1.0);
        corners[i] = {at.x, at.y, at.w};
    }
    return glm::dot(corners[0], glm::cross(corners[1], corners[2])) /
           (glm::length(corners[0]) * glm::length(corners[1]) * glm::length(corners[2]));
}

/// How many fronts no range holds.
std::size_t fronts_left_out(const Shape& shape, const std::vector<TriangleRange>& ranges, const glm::mat4& clip) {
    std::vector<bool> drawn(shape.indices.size() / 3, false);
    for (const TriangleRange& range : ranges) std::fill_n(drawn.begin() + range.first, range.count, true);
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < drawn.size(); ++i)
        left_out += !drawn[i] && area(shape, i, clip) > 1e-12;  // rounding of doubles, at a pole's slivers
    return left_out;
}

/// Matrices that a mesh may be drawn by: near and far, inside, parallel, turned, stretched, far from the origin.
std::vector<glm::mat4> matrices() {
    std::vector<glm::mat4> list;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    const auto anywhere = [&] { return glm::vec3(uniform(random), uniform(random), uniform(random)); };
    for (int i = 0; i < 60; ++i) {
        const float distance = std::exp2(3.0f * uniform(random) + 1.0f);
        const glm::mat4 turned = glm::rotate(glm::mat4(1.0f), 3.0f * uniform(random), glm::normalize(anywhere()));
        const glm::mat4 stretched = glm::scale(turned, glm::exp2(2.0f * anywhere()));
        for (const bool parallel : {false, true})
            list.push_back(seen_from(distance * anywhere(), parallel).clip_from_world() *
                           glm::translate(stretched, 0.3f * anywhere()));
    }
    return list;
}

std::vector<std::array<std::uint32_t, 3>> sorted_triangles(const std::vector<std::uint32_t>& indices) {
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::size_t i = 0; i < indices.size(); i += 3)
        triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    std::ranges::sort(triangles);
    return triangles;
}

TEST(Facing, LeavesNoFrontOut) {
    std::size_t left_out = 0, all = 0;
    for (Shape shape : {ball(), splinters(1), splinters(2), ball(48, 31, 1000.0f, {3e4f, 0.0f, 3e4f})}) {
        const FacingGroups groups = order_by_facing(shape.positions, shape.indices);
        ASSERT_FALSE(groups.groups.empty());
        for (const glm::mat4& clip : matrices()) {
            const std::vector<TriangleRange> ranges = ranges_of(groups, clip);
            EXPECT_EQ(fronts_left_out(shape, ranges, clip), 0u);
            left_out += shape.indices.size() / 3 - triangles_in(ranges);
            all += shape.indices.size() / 3;
        }
    }
    EXPECT_GT(left_out, all / 20);  // so that there was something to find
}

TEST(Facing, TheCheckFindsAFrontThatIsMissing) {
    Shape shape = ball();
    const FacingGroups groups = order_by_facing(shape.positions, shape.indices);
    const glm::mat4 clip = seen_from({0.0f, 1.0f, 5.0f}).clip_from_world();
    FacingGroups wrong = groups;
    for (FacingGroups::Group& group : wrong.groups) group.plane += 0.5f;
    EXPECT_GT(fronts_left_out(shape, ranges_of(wrong, clip), clip), 0u);
    wrong = groups;
    for (FacingGroups::Group& group : wrong.groups) group.cell = static_cast<std::uint16_t>(255 - group.cell);
    EXPECT_GT(fronts_left_out(shape, ranges_of(wrong, clip), clip), 0u);
}

TEST(Facing, ABallFromAfarIsDrawnToTwoThirdsInFewRanges) {
    Shape shape = ball();
    const FacingGroups groups = order_by_facing(shape.positions, shape.indices);
    const std::size_t triangles = shape.indices.size() / 3;
    std::size_t drawn = 0, views = 0;
    for (const glm::vec3& toward : {glm::vec3(0, 0, 1), glm::vec3(0, 1, 0), glm::vec3(-1, 0, 0), glm::vec3(0, -1, 0),
                                    glm::vec3(1, 1, 1), glm::vec3(-1, 1, -1), glm::vec3(0.3f, -0.2f, -1)}) {
        const auto ranges = ranges_of(groups, seen_from(10.0f * toward + 0.01f).clip_from_world());
        EXPECT_LE(ranges.size(), 6u);
        EXPECT_LT(triangles_in(ranges), triangles * 3 / 4);
        drawn += triangles_in(ranges);
        ++views;
    }
    EXPECT_LT(drawn, views * triangles * 2 / 3);
}

TEST(Facing, FromInsideABallOfFrontsOutwardsNothingIsDrawn) {
    Shape shape = ball();
    const FacingGroups groups = order_by_facing(shape.positions, shape.indices);
    EXPECT_TRUE(ranges_of(groups, seen_from({0.2f, 0.1f, 0.1f}).clip_from_world()).empty());
}

TEST(Facing, AMirroredViewHidesNothing) {
    Shape shape = ball();
    const FacingGroups groups = order_by_facing(shape.positions, shape.indices);
    const glm::mat4 mirrored = seen_from({0, 0, 5}).clip_from_world() * glm::scale(glm::mat4(1.0f), {-1, 1, 1});
    EXPECT_EQ(triangles_in(ranges_of(groups, mirrored)), shape.indices.size() / 3);
    EXPECT_EQ(triangles_in(ranges_of(groups, glm::mat4(0.0f))), shape.indices.size() / 3);
    EXPECT_EQ(triangles_in(ranges_of(groups, glm::mat4(std::nanf("")))), shape.indices.size() / 3);
}

TEST(Facing, KeepsEveryTriangleAndItsWinding) {
    for (const Shape& shape : {ball(), splinters(5)}) {
        std::vector<std::uint32_t> ordered = shape.indices;
        const FacingGroups groups = order_by_facing(shape.positions, ordered);
        EXPECT_NE(ordered, shape.indices);
        EXPECT_EQ(sorted_triangles(ordered), sorted_triangles(shape.indices));
        EXPECT_EQ(groups.groups.back().end, shape.indices.size() / 3);
    }
}

TEST(Facing, ThoseThatFaceAlikeKeepTheirOrder) {
    // Two layers of one wall, the second a hair above the first: what is drawn last shows where they are as far.
    Shape shape;
    for (std::uint32_t i = 0; i < 1200; ++i) {
        const float x = static_cast<float>(i % 600), z = i < 600 ? 0.0f : 1e-6f;
        for (const glm::vec3& corner : {glm::vec3(x, 0, z), glm::vec3(x + 1, 0, z), glm::vec3(x, 1, z)})
            shape.positions.push_back(corner);
        for (std::uint32_t corner = 0; corner < 3; ++corner) shape.indices.push_back(3 * i + corner);
    }
    std::vector<std::uint32_t> ordered = shape.indices;
    EXPECT_FALSE(order_by_facing(shape.positions, ordered).groups.empty());
    EXPECT_EQ(ordered, shape.indices);
}

TEST(Facing, FewTrianglesStayAsTheyAre) {
    const auto stays = [](const Shape& shape) {
        std::vector<std::uint32_t> ordered = shape.indices;
        return order_by_facing(shape.positions, ordered).groups.empty() && ordered == shape.indices;
    };
    Shape shape = splinters(9);
    shape.indices.resize(3 * (kFacingTriangles - 1));
    EXPECT_TRUE(stays(shape));
    EXPECT_TRUE(stays({}));
    shape = ball();
    shape.indices[1000] = static_cast<std::uint32_t>(shape.positions.size());
    EXPECT_TRUE(stays(shape)) << "an index without a position";
}

TEST(Facing, AnOrderThatSharesVerticesStays) {
    // A bumpy field in strips of ten columns: neighbours follow each other, and face elsewhere.
    Shape shape;
    constexpr int kSize = 60;
    for (int z = 0; z <= kSize; ++z) {
        for (int x = 0; x <= kSize; ++x)
            shape.positions.emplace_back(
                x, std::sin(1.7f * static_cast<float>(x)) * std::cos(1.3f * static_cast<float>(z)), -z);
    }
    for (int strip = 0; strip < kSize; strip += 10) {
        for (int z = 0; z < kSize; ++z) {
            for (int x = strip; x < strip + 10; ++x) {
                const auto at = [](int column, int row) {
                    return static_cast<std::uint32_t>(row * (kSize + 1) + column);
                };
                shape.indices.insert(shape.indices.end(), {at(x, z), at(x + 1, z), at(x, z + 1), at(x + 1, z),
                                                           at(x + 1, z + 1), at(x, z + 1)});
            }
        }
    }
    std::vector<std::uint32_t> ordered = shape.indices;
    EXPECT_TRUE(order_by_facing(shape.positions, ordered).groups.empty());
    EXPECT_EQ(ordered, shape.indices);
    std::mt19937 random(1);  // and it is the order that matters: torn up, the same field is sorted
    std::vector<std::size_t> places(shape.indices.size() / 3);
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = i;
    std::ranges::shuffle(places, random);
    for (std::size_t i = 0; i < places.size(); ++i)
        std::copy_n(shape.indices.begin() + static_cast<std::ptrdiff_t>(3 * places[i]), 3,
                    ordered.begin() + static_cast<std::ptrdiff_t>(3 * i));
    EXPECT_FALSE(order_by_facing(shape.positions, ordered).groups.empty());
}

TEST(Facing, TrianglesWithoutAreaAndPlacesThatAreNoNumbersDoNoHarm) {
    Shape shape = ball();
    for (const float odd : {std::nanf(""), std::numeric_limits<float>::infinity()}) {
        Shape with = shape;
        with.positions[70].x = odd;
        (void)order_by_facing(with.positions, with.indices);
        EXPECT_EQ(sorted_triangles(with.indices), sorted_triangles(shape.indices));
    }
    for (std::size_t i = 0; i < 300; i += 3) shape.indices[i + 1] = shape.indices[i];
    const FacingGroups groups = order_by_facing(shape.positions, shape.indices);
    for (const glm::mat4& clip : matrices()) EXPECT_EQ(fronts_left_out(shape, ranges_of(groups, clip), clip), 0u);
}

TEST(Facing, OrdersWhatIsOpaqueAndShowsItsFrontAlone) {
    Mesh mesh;
    mesh.positions.resize(3);
    mesh.indices = {0, 1, 2};
    Mesh strip = mesh, bare = mesh;
    strip.primitive = Primitive::triangle_strip;
    bare.indices.clear();
    Scene scene;
    scene.materials = {Material{}, Material{.double_sided = true}, Material{.alpha_mode = AlphaMode::blend},
                       Material{.alpha_mode = AlphaMode::mask}};
    const auto ordered = [&](const Mesh& one, std::initializer_list<int> materials) {
        scene.meshes = {one};
        scene.surfaces.clear();
        for (const int material : materials) scene.surfaces.push_back({.material = material});
        return static_cast<bool>(meshes_to_order(scene).at(0));
    };
    EXPECT_TRUE(ordered(mesh, {0}));
    EXPECT_TRUE(ordered(mesh, {3}));
    EXPECT_TRUE(ordered(mesh, {1, 0}));
    EXPECT_FALSE(ordered(mesh, {1}));
    EXPECT_FALSE(ordered(mesh, {0, 2}));
    EXPECT_FALSE(ordered(mesh, {}));
    EXPECT_FALSE(ordered(strip, {0}));
    EXPECT_FALSE(ordered(bare, {0}));
}

}  // namespace
}  // namespace halfframe
