// A scene as plain data: no GL, no files. Lengths in metres, angles in radians, +Y up, right-handed.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "engine/frame/motion.h"

namespace halfframe {

enum class Primitive : std::uint8_t { points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan };

/// What a morph target of weight 1 adds to a mesh. Empty streams add nothing; present ones are as long as the mesh's.
struct MorphTarget {
    std::string name;
    std::vector<glm::vec3> positions;  ///< [m]
    std::vector<glm::vec3> normals;
    std::vector<glm::vec3> tangents;
};

/// One vertex stream set. Empty optional streams are absent; present ones are as long as `positions`.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;  ///< [m], local
    std::vector<glm::vec3> normals;    ///< unit
    std::vector<glm::vec4> tangents;   ///< xyz unit, w = +1 or -1: bitangent = cross(normal, tangent) * w
    std::vector<glm::vec2> uv;
    std::vector<glm::vec2> uv1;        ///< second set
    std::vector<glm::vec4> colors;     ///< linear, 0..1
    std::vector<glm::u16vec4> joints;  ///< indices in Skin::joints: the four that weigh most
    std::vector<glm::vec4> weights;    ///< of these joints; they sum to 1
    std::vector<MorphTarget> morph_targets;
    std::vector<std::uint32_t> indices;  ///< empty: draw in order
    Primitive primitive = Primitive::triangles;
};

/// 8-bit pixels, row 0 first at v = 0 (glTF convention: top of the picture).
struct Image {
    std::string name;
    int width = 0;
    int height = 0;
    bool srgb = false;               ///< colour data; else linear data
    std::vector<std::uint8_t> rgba;  ///< 4 * width * height
};

enum class Wrap : std::uint8_t { repeat, clamp, mirror };

/// How a texture is filtered where its texels are smaller than pixels.
struct Minify {
    bool linear = true;   ///< inside a level
    bool between = true;  ///< between two levels; only with mip levels
    bool operator==(const Minify&) const = default;
};

/// A use of an image: which and how it is sampled.
struct Texture {
    int image = -1;  ///< index in Scene::images; -1: none
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    bool linear = true;  ///< filter on magnification
    bool mipmaps = true;
    std::optional<Minify> minify;  ///< none: as `linear`, inside a level and between levels
    [[nodiscard]] explicit operator bool() const { return image >= 0; }
    bool operator==(const Texture&) const = default;
};

/// How a texture's coordinates are made of the mesh's: uv' = rotate(uv * scale) + offset (KHR_texture_transform).
struct UvMapping {
    int set = 0;  ///< 0: Mesh::uv, 1: Mesh::uv1
    glm::vec2 offset{0.0f};
    glm::vec2 scale{1.0f};
    float rotation_rad = 0.0f;  ///< counter-clockwise in the picture, about the coordinates' origin
    bool operator==(const UvMapping&) const = default;
};

enum class MaterialModel : std::uint8_t {
    metallic_roughness,
    specular_glossiness,  ///< the talk's own parameters: albedo, specular, smoothness
                          ///< (KHR_materials_pbrSpecularGlossiness)
    unlit,                ///< shows base_color as it is (KHR_materials_unlit)
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// Where a material takes up water, if the scene is wet (engine/effects/wet_surface).
enum class WaterMask : std::uint8_t {
    none,          ///< stays dry
    everywhere,    ///< all of it
    vertex_color,  ///< as the alpha of Mesh::colors says (vertex_water() there); opaque materials only
    texture,       ///< as the red of Material::water_texture says
};

/// A material as glTF 2.0 has it; mapped to albedo, specular and power by surface (engine/effects/surface).
struct Material {
    std::string name;
    MaterialModel model = MaterialModel::metallic_roughness;
    glm::vec4 base_color{1.0f};  ///< linear, 0..1; the albedo where the model is specular_glossiness
    float metallic = 1.0f;       ///< 0..1
    float roughness = 1.0f;      ///< 0..1, perceptual (alpha = roughness squared)
    float ior = 1.5f;            ///< of the dielectric: its specular is ((ior - 1) / (ior + 1))^2; >= 1, 0: specular 1
    glm::vec3 specular{1.0f};    ///< times the dielectric's specular (KHR_materials_specular, factor times colour);
                                 ///< with specular_glossiness the specular itself, linear
    float smoothness = 1.0f;     ///< specular_glossiness only: the glossiness, 0..1; roughness is 1 - smoothness
    glm::vec3 emissive{0.0f};    ///< linear radiance scale
    float occlusion_strength = 1.0f;  ///< 0..1, of occlusion_texture
    float normal_scale = 1.0f;
    float alpha_cutoff = 0.5f;  ///< 0..1, mask only
    AlphaMode alpha_mode = AlphaMode::opaque;
    bool double_sided = false;
    Texture base_color_texture;           ///< sRGB
    Texture metallic_roughness_texture;   ///< G roughness, B metallic
    Texture normal_texture;               ///< tangent space, +Y up
    Texture emissive_texture;             ///< sRGB
    Texture occlusion_texture;            ///< R: the share of light from everywhere that arrives
    Texture specular_texture;             ///< A: times `specular`; linear
    Texture specular_color_texture;       ///< sRGB: times `specular`
    Texture specular_smoothness_texture;  ///< specular_glossiness only: RGB specular (sRGB), A smoothness
    UvMapping base_color_uv, metallic_roughness_uv, normal_uv, emissive_uv;
    UvMapping occlusion_uv, specular_uv, specular_color_uv, specular_smoothness_uv;
    WaterMask water = WaterMask::none;
    float deepest_puddle_m = 0.04f;  ///< depth of the hollow where the vertex alpha says 1 [m], > 0
    Texture water_texture;           ///< R: share of the water that it takes up; G: height, 0 cracks, 1 stays above water
    UvMapping water_uv;
};

/// Blinn power 2..2048 of a roughness 0..1 and smoothness 0..1 of both, as shaders_es/surface/surface.glsl makes them.
[[nodiscard]] float power_of(float roughness);
[[nodiscard]] float smoothness_of_power(float power);
[[nodiscard]] float smoothness_of(float roughness);

/// Roughness 0..1 of a lit material without its textures.
[[nodiscard]] float unmapped_roughness(const Material& material);
/// A texture says how smooth a lit material is.
[[nodiscard]] bool maps_smoothness(const Material& material);

/// One drawn thing: a mesh with a material at a place.
struct Surface {
    std::string name;
    int mesh = 0;
    int material = 0;
    glm::mat4 world_from_local{1.0f};
    bool dynamic = false;  ///< moves: characters, doors
    int node = -1;         ///< index in Scene::nodes that carries it; -1: stays where it is
    int skin = -1;         ///< index in Scene::skins; then any `world_from_local` near by draws the same: see pose.h
};

enum class LightKind : std::uint8_t { sun, point, spot };

/// A punctual light. `color` is c_light of Hoffman 2010: a white Lambert surface facing it at 1 m (or at any distance
/// for a sun) shows exactly `color`. That is, irradiance is pi * color.
struct Light {
    LightKind kind = LightKind::point;
    std::string name;
    glm::vec3 color{1.0f};                   ///< linear, >= 0
    glm::vec3 position{0.0f};                ///< [m] point, spot
    glm::vec3 direction{0.0f, -1.0f, 0.0f};  ///< unit, the way the light travels: sun, spot
    float range_m = 10.0f;                   ///< falls smoothly to 0 here; point, spot
    float inner_cone_rad = 0.0f;             ///< spot: full inside this half angle
    float outer_cone_rad = 0.785398f;        ///< spot: dark outside this half angle
    float radius_m = 0.0f;                   ///< of the shining sphere, less than range_m; 0: a point. point, spot
    int node = -1;                           ///< index in Scene::nodes that carries it along its -Z; -1: stays
};

struct Camera {
    std::string name;
    glm::mat4 world_from_view{1.0f};  ///< looks along its -Z
    float fov_y_rad = 0.785398f;      ///< perspective
    float near_m = 0.1f;
    float far_m = 1000.0f;
    bool orthographic = false;
    float half_height_m = 1.0f;  ///< orthographic
    float exposure = 1.0f;       ///< linear factor before the tone map, > 0
    int node = -1;               ///< index in Scene::nodes that carries it; -1: stays
};

/// A vertical gradient in *display* values (what a picture would show), taken back to linear light through the inverse
/// tone map where the frame is HDR (talk, "LDR sky").
struct Sky {
    glm::vec3 zenith{0.16f, 0.20f, 0.28f};
    glm::vec3 horizon{0.45f, 0.50f, 0.58f};
    glm::vec3 ground{0.12f, 0.12f, 0.13f};
};

/// Glow round what is brighter than a light of 1 after exposure (the talk's display code 214).
struct Bloom {
    float strength = 0.25f;  ///< share of the light above 1 that is spread, 0..1; ours
};

/// How wet what takes up water is, outside of puddles.
struct Wetness {
    float level = 1.0f;  ///< 0 dry .. 1 soaked
    /// The level never changes: the plan may write it into textures once, and later changes of it do not show.
    bool is_static = true;
    std::optional<float> since_s;  ///< seconds since the rain stopped; none: it goes on, or nothing dries. Not static
    float dry_s = 60.0f;           ///< all is dry this long after the rain [s], > 0
};

/// Water that stands in hollows.
struct Puddles {
    float level = 1.0f;  ///< 0 none .. 1 every hollow is full
};

/// Light from everywhere, prefiltered (content/environment makes it): radiance smoothed by cosine-power lobes for
/// reflections, and spherical harmonics for the diffuse part. Linear, >= 0, world axes.
struct EnvironmentMap {
    std::string name;
    int size = 0;  ///< texels a side of level 0; a power of two
    /// Level 0 is the sharpest; level l is max(size >> l, 1) texels a side. Each holds six faces, +X -X +Y -Y +Z -Z,
    /// rows in the order glTexImage2D takes them. The chain ends at one texel, as ES 2.0 demands.
    std::vector<std::vector<glm::vec3>> levels;
    /// The level for smoothness 0; a surface of smoothness s reads level (1 - s) * roughest_level.
    int roughest_level = 0;
    /// Power of the Phong lobe (R.l)^power that each level was smoothed with, for reporting.
    std::vector<float> powers;
    /// Light that a white Lambert surface of normal n shows: the sum of irradiance[i] times the polynomial 1, y, z, x,
    /// xy, yz, 3 z^2 - 1, xz, x^2 - y^2 of n. Constants are folded in; windowed so that the sum is nowhere negative.
    std::array<glm::vec3, 9> irradiance{};
};

/// What is drawn. An effect is simulated only if something here calls for it.
struct Scene {
    std::string name;
    std::vector<Mesh> meshes;
    std::vector<Image> images;
    std::vector<Material> materials;
    std::vector<Surface> surfaces;
    std::vector<Light> lights;
    std::vector<Camera> cameras;
    std::vector<Node> nodes;  ///< only what moves, and what that hangs on
    std::vector<Skin> skins;
    std::vector<Animation> animations;
    glm::vec3 ambient{0.0f};                    ///< constant radiance from everywhere, linear; added to `environment`
    std::optional<EnvironmentMap> environment;  ///< none: nothing to reflect but `ambient`
    std::optional<Bloom> bloom;                 ///< none: as `Bloom{}` if something shines above 1 by itself
    std::optional<Wetness> wetness;             ///< none: dry
    std::optional<Puddles> puddles;             ///< none: no water stands
    std::optional<Sky> sky;                     ///< none: the background is `background`
    glm::vec3 background{0.12f, 0.13f, 0.15f};  ///< display value behind everything
    std::vector<std::string> notices;           ///< what the loader left out, one sentence each
};

/// Axis-aligned box; empty when low > high.
struct Box {
    glm::vec3 low{1e30f};
    glm::vec3 high{-1e30f};
    [[nodiscard]] bool empty() const { return low.x > high.x; }
    void add(const glm::vec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
};

/// Of all points.
[[nodiscard]] Box box_of(std::span<const glm::vec3> points);
/// Of the vertices that are drawn.
[[nodiscard]] Box local_box(const Mesh& mesh);
[[nodiscard]] Box world_box(const Box& local, const glm::mat4& world_from_local);
/// Box of every surface together [m].
[[nodiscard]] Box world_box(const Scene& scene);

/// Where a frame is seen from and how big it is.
struct View {
    glm::mat4 view_from_world{1.0f};
    glm::mat4 clip_from_view{1.0f};
    glm::vec3 eye{0.0f};  ///< [m] world
    int width = 1280;     ///< [pixels]
    int height = 720;
    float exposure = 1.0f;  ///< linear factor before the tone map
    bool orthographic = false;
    [[nodiscard]] glm::mat4 clip_from_world() const { return clip_from_view * view_from_world; }
};

/// `width` x `height` pixels of what `camera` sees, at its exposure.
[[nodiscard]] View view_of(const Camera& camera, int width, int height);
/// `camera` with near and far moved towards each other until they just hold `scene_box`, never apart: the same picture
/// from a depth buffer that separates more. An empty box leaves them alone.
[[nodiscard]] Camera tightened(const Camera& camera, const Box& scene_box);
/// A camera three quarters from above that has the whole of `box` inside the picture.
[[nodiscard]] Camera camera_framing(const Box& box, float aspect, float fov_y_rad = 0.6981317f);
/// eye to target [m], +Y up (or +Z when looking straight up or down).
[[nodiscard]] Camera camera_looking(const glm::vec3& eye, const glm::vec3& target, float fov_y_rad,
                                    const Box& scene_box);

}  // namespace halfframe
