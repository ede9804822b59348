// The table of rules.
#include "perf/check/rules.h"

#include <array>

#include "engine/error.h"

namespace halfframe::check {
namespace {

constexpr const char* kTalk = "S. Lagarde and L. Harduin, The Art and Rendering of Remember Me, GDC Europe 2013";
constexpr const char* kGltf = "glTF 2.0 specification";
constexpr const char* kEs2 = "OpenGL ES 2.0.25 specification, 3.8.2";
constexpr const char* kOurs = "ours";

constexpr std::array<Rule, kRuleCount> kRules{{
    {RuleId::albedo_dark, "albedo-dark", "The albedo of what is no metal is at least as bright as charcoal.", kTalk,
     "Brighten the base colour; take shadows and occlusion out of it, the engine makes those."},
    {RuleId::albedo_bright, "albedo-bright", "The albedo of what is no metal is at most as bright as fresh snow.",
     kTalk, "Darken the base colour; what shines by itself belongs into the emission."},
    {RuleId::metal_albedo, "metal-albedo", "Pure metal has no albedo.", kTalk,
     "Make the diffuse colour black where the specular colour is that of a metal."},
    {RuleId::dielectric_specular, "dielectric-specular",
     "The specular of what is no metal is that of water to that of dense plastics and stones.", kTalk,
     "Leave the index of refraction at 1.5 and the specular factor at 1 unless a measurement says otherwise."},
    {RuleId::metal_specular, "metal-specular", "The specular of a metal is bright.", kTalk,
     "Take the metal's colour from a chart (halfframe render charts); dirt on it is no metal."},
    {RuleId::specular_gap, "specular-gap", "No specular lies between those of metals and of everything else.", kTalk,
     "Decide for metal or not; only texels on a border between both may lie between."},
    {RuleId::metallic_between, "metallic-between", "A texel is metal or it is not.", kTalk,
     "Make metallic 0 or 1; only texels on a border between both may lie between."},
    {RuleId::smoothness_ends, "smoothness-ends",
     "Smoothness lies inside its scale: highlights have a power of 2 to 2048, and beyond nothing changes.", kTalk,
     "Keep the roughness between 0.18 and 0.84, and vary it with a texture."},
    {RuleId::texture_power_of_two, "texture-power-of-two", "The sides of a texture are powers of two.", kEs2,
     "Resize the picture: plain ES 2.0 has neither mipmaps nor repetition for other sizes."},
    {RuleId::texture_size, "texture-size", "A texture is no larger than the device takes and the project allows.",
     kOurs, "Make the picture smaller, or cut it up."},
    {RuleId::texture_mipmaps, "texture-mipmaps", "A texture has mipmaps.", kOurs,
     "Choose a minification filter with mipmaps in the sampler: without them it sparkles far away and costs "
     "bandwidth."},
    {RuleId::texture_wrap, "texture-wrap", "A clamped texture is not left by the coordinates.", kGltf,
     "Set the sampler to repeat, or move the coordinates into 0 to 1."},
    {RuleId::images_duplicate, "images-duplicate", "No two images hold the same pixels.", kOurs,
     "Let both textures name the same image."},
    {RuleId::alpha_unused, "alpha-unused",
     "An alpha channel is stored where it is used, and used where it is asked for.", kOurs,
     "Store the picture without alpha, or set alphaMode to what the picture is."},
    {RuleId::normal_map_length, "normal-map-length", "The vectors of a normal map are unit.", kGltf,
     "Save the map without sRGB conversion and scale, and normalise it after filtering."},
    {RuleId::normal_map_inward, "normal-map-inward", "No vector of a normal map points into the surface.", kGltf,
     "Check that it is a tangent space map (blue above 127) and no other kind of picture."},
    {RuleId::mesh_degenerate, "mesh-degenerate", "Every triangle has an area.", kOurs,
     "Merge by distance and dissolve degenerate faces before export."},
    {RuleId::mesh_unused_vertices, "mesh-unused-vertices", "Every vertex belongs to something that is drawn.", kOurs,
     "Remove loose vertices before export: they are stored and may be transformed."},
    {RuleId::mesh_normals, "mesh-normals", "The normals of vertices are unit.", kGltf,
     "Let the exporter write normalised normals; the loader repairs them at the cost of time."},
}};

}  // namespace

std::span<const Rule> rules() { return kRules; }

const Rule& rule(RuleId id) {
    const Rule& found = kRules[static_cast<std::size_t>(id)];
    expect(found.id == id, "the rules stand in the order of their ids");
    return found;
}

const char* name(Level level) {
    switch (level) {
        case Level::note: return "note";
        case Level::warning: return "warning";
        case Level::error: return "error";
    }
    return "error";
}

}  // namespace halfframe::check
