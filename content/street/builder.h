// Collects faces by material and place, and makes them into few meshes: one for each material of a cell of the street.
#pragma once

#include <array>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "engine/frame/scene.h"

namespace halfframe::content::street {

/// How a material's texture lies on faces.
struct Mapping {
    float side_m = 1.0f;  ///< of one repeat of the texture
    bool colors = false;  ///< its vertices have colours
    bool wall = false;    ///< ground floors are meshes of their own, so that shops light no floor above
    bool unlit = false;   ///< no lamp matters to it: long meshes
};

/// Which sides of a box are made.
enum Side : unsigned { kLeft = 1, kRight = 2, kBottom = 4, kTop = 8, kBack = 16, kFront = 32 };
constexpr unsigned kAllSides = 63;
constexpr unsigned kNotBack = kAllSides & ~kBack;
constexpr unsigned kNotBottom = kAllSides & ~kBottom;

/// Faces are given in the frame that `place` sets: x right, y up, z out of what they stand on. Static faces end up in
/// world space. Texture coordinates of faces without their own run along the face in metres of that frame, so that
/// neighbours continue each other.
class Builder {
public:
    explicit Builder(Scene& scene) : scene_(scene) {}

    int add_material(Material material, const Mapping& mapping);
    int add_image(Image image);
    [[nodiscard]] Scene& scene() { return scene_; }

    /// What follows is placed by this.
    void place(const glm::mat4& world_from_here) { world_from_here_ = world_from_here; }
    [[nodiscard]] const glm::mat4& placed() const { return world_from_here_; }
    [[nodiscard]] glm::vec3 world(const glm::vec3& here) const { return {world_from_here_ * glm::vec4(here, 1.0f)}; }
    /// Of the vertices that follow, where the material has colours.
    void color(const glm::vec4& value) { color_ = value; }

    /// A parallelogram from its lower left corner; its front looks along cross(right, up).
    void quad(int material, const glm::vec3& corner, const glm::vec3& right, const glm::vec3& up);
    /// As `quad`, with a rectangle of the texture on it: `uv_low` at the upper left, `uv_high` at the lower right.
    void picture(int material, const glm::vec3& corner, const glm::vec3& right, const glm::vec3& up,
                 const glm::vec2& uv_low, const glm::vec2& uv_high);
    /// Any four corners, against the clock from the lower left, that lie in one plane or nearly so.
    void patch(int material, const std::array<glm::vec3, 4>& corners);
    /// Four corners with a colour each.
    void colored_patch(int material, const std::array<glm::vec3, 4>& corners, const std::array<glm::vec4, 4>& colors);
    void triangle(int material, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
    void box(int material, const glm::vec3& low, const glm::vec3& high, unsigned sides = kAllSides);
    /// A round bar between two points, with ends if `capped`.
    void bar(int material, const glm::vec3& from, const glm::vec3& to, float radius_m, int slices = 6,
             bool capped = false);
    /// Bars along a path.
    void tube(int material, std::span<const glm::vec3> path, float radius_m, int slices = 6);
    /// A body of revolution about y: (radius, height) from the top down; smooth where `smooth`.
    void lathe(int material, const glm::vec3& foot, std::span<const glm::vec2> profile, int slices,
               bool smooth = false);
    /// One smooth strip between two rows of points and their normals; u and v in metres.
    void strip(int material, std::span<const glm::vec3> lower, std::span<const glm::vec3> upper,
               std::span<const glm::vec3> normals);

    /// Makes meshes and surfaces of all that was collected: one for a cell, more where many lamps meet.
    void finish();

private:
    struct Vertex {
        glm::vec3 position;
        glm::vec3 normal;
        glm::vec3 tangent;  ///< of growing u; v grows along -cross(normal, tangent)
        glm::vec2 uv;
        glm::vec4 color;
    };
    using Key = std::tuple<int, int, int, int>;  ///< material, cells in x, y, z
    void add_lit(const std::string& name, Mesh mesh, int material);
    [[nodiscard]] int lamps_left_out(const Mesh& mesh, int material) const;
    Mesh& cell_of(int material, const glm::vec3& world);
    void add(Mesh& mesh, int material, const Vertex& here);
    void add_quad(int material, const std::array<Vertex, 4>& corners);
    [[nodiscard]] glm::vec2 flat_uv(int material, const glm::vec3& here, const glm::vec3& right,
                                    const glm::vec3& up) const;

    Scene& scene_;
    std::vector<Mapping> mappings_;
    std::map<Key, Mesh> cells_;
    std::map<std::string, int> parts_;  ///< meshes made of a cell so far
    glm::mat4 world_from_here_{1.0f};
    glm::vec4 color_{1.0f};
};

}  // namespace halfframe::content::street
