// Card of the environment: what calls for it, what it inserts, its cubes on the device.
#include "engine/effects/environment/environment.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "engine/effects/environment/reflection_harmonics.h"
#include "engine/effects/surface/surface_by_vertex.h"
#include "engine/frame/frame_plan.h"
#include "engine/frame/renderer.h"
#include "shaders_es/environment/environment_limits.h"

namespace halfframe {

namespace {

constexpr gl::Insertion kVertex{"surface.vertex", "environment/environment_vertex.glsl", "place_irradiance(n);"};
constexpr gl::Insertion kVertexLight{"surface.vertex_light", nullptr, "diffuse_light += vertex_irradiance;"};
constexpr gl::Insertion kVertexMirrored{"surface.vertex_mirrored", nullptr,
                                       "mirrored_light += rough_reflection(mirrored);"};
// As low has it only where one cube holds all that a surface mirrors: all that vertices light.
constexpr gl::Insertion kVertexMirror{"surface.vertex_mirror", nullptr, "vertex_mirror *= mirror_scale.x;",
                                      "CONSTANT_SMOOTHNESS"};
constexpr gl::Insertion kLowMirrored{"surface.mirrored", "environment/environment_low_fragment.glsl",
                                     "light_root += environment_root(mirrored);", "CONSTANT_SMOOTHNESS"};
constexpr std::array kInsertions = {
    kVertex, kVertexLight, gl::Insertion{"surface.mirrored", "environment/environment_cube.glsl",
                           "light_root += sqrt(environment_reflection(mirrored, smoothness));"},
    gl::Insertion{"surface.ambient", "environment/environment_cube.glsl",
                           "diffuse_light += environment_irradiance(n); "
                           "mirrored_light += environment_reflection(reflect(-v, n), smoothness);"}};
constexpr std::array kLowInsertions = {
    kVertex, kVertexLight, kVertexMirror, kVertexMirrored, kLowMirrored,
    gl::Insertion{"surface.ambient", "environment/environment_low_fragment.glsl",
                           "diffuse_light += vertex_irradiance; "
                           "mirrored_light += environment_reflection(reflect(-v, n), smoothness);"}};

bool is_lit(const Scene& scene, const Surface& surface) {
    return !scene.meshes[static_cast<std::size_t>(surface.mesh)].normals.empty() &&
           scene.materials[static_cast<std::size_t>(surface.material)].model != MaterialModel::unlit;
}

Demand called_for(const PlanContext& context) {
    const Scene& scene = context.scene;
    if (!scene.environment) return {false, "the scene has no environment"};
    if (!std::ranges::any_of(scene.surfaces, [&](const Surface& surface) { return is_lit(scene, surface); }))
        return {false, "no surface has normals, so nothing reflects the environment"};
    return {true, fmt::format("the scene is lit by the environment {}", scene.environment->name)};
}

/// Where every place is equally smooth its light comes from one cube:
/// shaders_es/environment/environment_one_level.glsl.
void add_defines(const Renderer& renderer, int index, std::vector<std::string_view>& defines) {
    const Surface& surface = renderer.scene().surfaces[static_cast<std::size_t>(index)];
    const bool maps = maps_smoothness(renderer.material(surface.material));
    if (renderer.tier_of("environment") != Tier::reference && is_lit(renderer.scene(), surface) && !maps)
        defines.emplace_back("CONSTANT_SMOOTHNESS");
}

std::span<const gl::Insertion> insertions(const PlanContext& context) {
    if (context.tier == Tier::low) return kLowInsertions;
    return kInsertions;
}

/// The largest light that RGBM8 keeps at `exposure`.
float range_at(float exposure) { return static_cast<float>(ENVIRONMENT_RANGE) / exposure; }

/// Square root of the largest light that is stored [sqrt(light)]; > 0.
float root_range_of(const EnvironmentMap& map, float exposure) {
    float largest = 0.0f;
    for (const auto& level : map.levels) {
        for (const glm::vec3& texel : level) largest = std::max({largest, texel.r, texel.g, texel.b});
    }
    return std::sqrt(std::clamp(largest, 1.0f / (64.0f * exposure), range_at(exposure)));
}

class EnvironmentWork final : public EffectWork {
public:
    explicit EnvironmentWork(Renderer& renderer)
        : map_(renderer.scene().environment ? *renderer.scene().environment : kNothing),
          tier_(renderer.tier_of("environment")),
          exposure_(renderer.plan().exposure),
          root_range_(root_range_of(map_, exposure_)) {
        if (map_.levels.empty()) return;  // switched on by hand in a scene without one
        say_what_is_cut(renderer);
        const float sharpest = tier_ == Tier::low ? static_cast<float>(ENVIRONMENT_SHARP) : 1.0f;
        first_level_ = level_for(map_, sharpest, renderer.caps().max_cube_map_size);
        upload_steps(renderer);
    }

    int adopt(Renderer& renderer, gl::Program& program) override {
        Adopted adopted;
        adopted.scale = program.uniform_if_used("reflection_scale");
        adopted.mirror_scale = program.uniform_if_used("mirror_scale");
        adopted.terms = program.uniform_if_used("irradiance_terms");
        adopted.mirror = program.uniform_if_used("mirror_terms");
        for (const auto& [sampler, unit] :
             {std::pair{"reflection_map", kReflectionUnit}, std::pair{"one_level_map", kReflectionUnit},
              std::pair{"rough_reflection_map", kRoughReflectionUnit}}) {
            if (const int location = program.uniform_if_used(sampler); location >= 0)
                renderer.gl().Uniform1i(location, unit);
        }
        adopted.reads_levels = program.uniform_if_used("reflection_map") >= 0;
        if (adopted.reads_levels) upload_levels(renderer);
        if (adopted.scale < 0 && adopted.mirror_scale < 0 && adopted.terms < 0) return -1;  // not lit
        adopted_.push_back(adopted);
        return static_cast<int>(adopted_.size()) - 1;
    }

    void feed(Renderer& renderer, const View& view, int index) override {
        const Adopted& adopted = adopted_[static_cast<std::size_t>(index)];
        gl::EntryPoints& gl = renderer.gl();
        view_exposure_ = view.exposure;
        const float scale = tier_ == Tier::reference ? view.exposure / exposure_ : root_range_ * std::sqrt(view.exposure);
        const glm::vec4 scale_and_level(map_.levels.empty() ? 0.0f : scale,
                                        static_cast<float>(map_.roughest_level - first_level_), 0.0f, 0.0f);
        for (const int location : {adopted.scale, adopted.mirror_scale}) {
            if (location >= 0) gl.Uniform4fv(location, 1, &scale_and_level.x);
        }
        if (adopted.terms >= 0) {
            // Nine terms of at most 6000 sum to less than half's 65504; in half inf - inf would be NaN.
            float largest = 1e-6f;
            for (const glm::vec3& term : map_.irradiance)
                largest = std::max({largest, std::abs(term.r), std::abs(term.g), std::abs(term.b)});
            const float exposure = std::min(view.exposure, 6000.0f / largest);
            std::array<glm::vec4, 9> terms{};
            for (std::size_t i = 0; i < terms.size(); ++i) terms[i] = glm::vec4(map_.irradiance[i] * exposure, 0.0f);
            gl.Uniform4fv(adopted.terms, static_cast<GLsizei>(terms.size()), &terms[0].x);
        }
        if (!adopted.reads_levels) return;
        if (sharp_) renderer.bind_cube(kReflectionUnit, sharp_.name());
        if (rough_) renderer.bind_cube(kRoughReflectionUnit, rough_.name());
    }

    void feed_material(Renderer& renderer, int index, int material) override {
        const Adopted& adopted = adopted_[static_cast<std::size_t>(index)];
        if (adopted.reads_levels || steps_.empty()) return;
        const float roughness = unmapped_roughness(renderer.material(material));
        if (adopted.mirror >= 0) {
            tell_harmonics(renderer, adopted.mirror, step_of(roughness));
            return;
        }
        Chosen& chosen = chosen_[static_cast<std::size_t>(material)];
        if (chosen.roughness != roughness) chosen = {roughness, nearest_cube(step_of(roughness))};
        renderer.bind_cube(kReflectionUnit, chosen.cube);
    }

private:
    struct Adopted {
        int scale = -1;         ///< of the fragment stage
        int mirror_scale = -1;  ///< of the vertex stage
        int terms = -1;
        int mirror = -1;
        bool reads_levels = false;
    };
    /// Level step / ENVIRONMENT_STEPS as a cube of its own.
    struct StepCube {
        int step;
        gl::Texture cube;
    };

    struct RoughStep {
        int step;
        ReflectionHarmonics harmonics;
    };

    /// The cube of a material, for the roughness that it was chosen for; -1: none yet.
    struct Chosen {
        float roughness = -1.0f;
        std::uint32_t cube = 0;
    };

    [[nodiscard]] int step_of(float roughness) const {
        return std::max(level_step(map_, smoothness_of(roughness)), first_level_ * ENVIRONMENT_STEPS);
    }

    [[nodiscard]] std::uint32_t nearest_cube(int step) const {
        const auto distance = [step](const StepCube& one) { return std::abs(one.step - step); };
        return std::ranges::min_element(steps_, {}, distance)->cube.name();
    }

    /// Of the rough step that is nearest.
    void tell_harmonics(Renderer& renderer, int location, int step) const {
        if (rough_steps_.empty()) return;
        const auto distance = [step](const RoughStep& one) { return std::abs(one.step - step); };
        ReflectionHarmonics terms = std::ranges::min_element(rough_steps_, {}, distance)->harmonics;
        const float scale = std::sqrt(view_exposure_);
        for (std::size_t i = 0; i < terms.size(); ++i) {
            if (i != kHarmonicsAxis) terms[i] *= scale;
        }
        renderer.gl().Uniform4fv(location, static_cast<GLsizei>(terms.size()), &terms[0].x);
    }

    /// What fragments would read of `texels`: RGBM8 cuts at its range.
    [[nodiscard]] ReflectionHarmonics harmonics_of(std::vector<glm::vec3> texels, int side) const {
        for (glm::vec3& texel : texels) texel = glm::min(texel, glm::vec3(root_range_ * root_range_));
        return reflection_harmonics(texels, side);
    }

    /// A cube for each smoothness that equally smooth surfaces have.
    void upload_steps(Renderer& renderer) {
        chosen_.resize(renderer.scene().materials.size());
        const std::vector<Surface>& surfaces = renderer.scene().surfaces;
        std::vector<std::string_view> defines;
        for (std::size_t i = 0; i < surfaces.size(); ++i) {
            const Material& material = renderer.material(surfaces[i].material);
            const int step = step_of(unmapped_roughness(material));
            const bool has_cube = std::ranges::find(steps_, step, &StepCube::step) != steps_.end();
            // Of two materials that are rounded to one step the rougher alone may have its mirror in vertices.
            const bool lacks_harmonics = tier_ == Tier::low && mirrors_by_vertex(material) &&
                                         std::ranges::find(rough_steps_, step, &RoughStep::step) == rough_steps_.end();
            if (has_cube && !lacks_harmonics) continue;
            defines.clear();
            renderer.add_defines(static_cast<int>(i), defines);
            const auto has = [&](std::string_view word) { return std::ranges::find(defines, word) != defines.end(); };
            if (!has("CONSTANT_SMOOTHNESS") || has("WATER")) continue;
            const int level = step / ENVIRONMENT_STEPS;
            const std::vector<glm::vec3> texels = texels_of_step(map_, step);
            if (lacks_harmonics) rough_steps_.push_back({step, harmonics_of(texels, map_.size >> level)});
            if (has_cube) continue;
            gl::Texture cube = begin_cube(renderer, GL_LINEAR);
            renderer.count_texture_bytes(upload_texels(renderer, texels, map_.size >> level, 0));
            steps_.push_back({step, std::move(cube)});
        }
    }

    /// What programs read that choose by pixel: the chain, or at low two levels of it.
    void upload_levels(Renderer& renderer) {
        if (sharp_ || map_.levels.empty()) return;
        if (tier_ != Tier::low) {
            sharp_ = upload(renderer, first_level_, static_cast<int>(map_.levels.size()) - first_level_);
            return;
        }
        sharp_ = upload(renderer, first_level_, 1);
        rough_ = upload(renderer,
                        level_for(map_, static_cast<float>(ENVIRONMENT_ROUGH), renderer.caps().max_cube_map_size), 1);
    }

    void say_what_is_cut(Renderer& renderer) const {
        if (tier_ == Tier::reference) return;
        const auto& top = map_.levels.front();
        const auto cut = std::ranges::count_if(top, [&](const glm::vec3& texel) {
            return std::max({texel.r, texel.g, texel.b}) > range_at(exposure_);
        });
        if (cut == 0) return;
        renderer.add_notice(fmt::format(
            "{:.2f} % of the environment {} is brighter than {} and is cut there in RGBM8; "
            "--tier environment=reference keeps it",
            100.0 * static_cast<double>(cut) / static_cast<double>(top.size()), map_.name, range_at(exposure_)));
    }

    /// `count` levels from `first` on as a cube.
    gl::Texture upload(Renderer& renderer, int first, int count) const {
        gl::Texture cube = begin_cube(renderer, count > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
        std::size_t bytes = 0;
        for (int i = 0; i < count; ++i) {
            const int level = first + i;
            bytes += upload_texels(renderer, map_.levels[static_cast<std::size_t>(level)],
                                   std::max(map_.size >> level, 1), i);
        }
        renderer.count_texture_bytes(bytes);
        return cube;
    }

    /// An empty cube, bound.
    gl::Texture begin_cube(Renderer& renderer, GLint minify) const {
        gl::EntryPoints& gl = renderer.gl();
        gl::Texture cube = gl::create<gl::Kind::texture>(gl);
        gl.ActiveTexture(GL_TEXTURE0);
        gl.BindTexture(GL_TEXTURE_CUBE_MAP, cube.name());
        for (const auto& [parameter, value] :
             {std::pair{GL_TEXTURE_MIN_FILTER, minify}, std::pair{GL_TEXTURE_MAG_FILTER, GL_LINEAR},
              std::pair{GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE}, std::pair{GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE}}) {
            gl.TexParameteri(GL_TEXTURE_CUBE_MAP, static_cast<GLenum>(parameter), value);
        }
        gl::label(gl, cube, map_.name.c_str());
        return cube;
    }

    /// Six faces of the bound cube; returns their bytes.
    std::size_t upload_texels(Renderer& renderer, const std::vector<glm::vec3>& texels, int side, int as_level) const {
        const std::size_t face_texels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
        const bool in_floats = tier_ == Tier::reference;
        const auto format = gl::transfer_format(in_floats ? gl::PixelFormat::rgba16f : gl::PixelFormat::rgba8,
                                                !renderer.caps().sized_formats);
        std::vector<std::uint8_t> packed;
        std::vector<glm::vec4> floats;
        for (int face = 0; face < 6; ++face) {
            packed.clear();
            floats.clear();
            for (std::size_t i = 0; i < face_texels; ++i) {
                const glm::vec3& light = texels[static_cast<std::size_t>(face) * face_texels + i];
                if (in_floats) {
                    floats.emplace_back(glm::min(light * exposure_, glm::vec3(kLargestHalf)), 1.0f);
                } else {
                    const auto texel = packed_rgbm(light, root_range_);
                    packed.insert(packed.end(), texel.begin(), texel.end());
                }
            }
            const void* pixels = in_floats ? static_cast<const void*>(floats.data()) : packed.data();
            renderer.gl().TexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + static_cast<GLenum>(face), as_level,
                                     static_cast<GLint>(format.internal_format), side, side, 0, format.format,
                                     in_floats ? GL_FLOAT : format.type, pixels);
        }
        return face_texels * 6 * (in_floats ? 8 : 4);
    }

    static constexpr float kLargestHalf = 65504.0f;
    static const EnvironmentMap kNothing;

    const EnvironmentMap& map_;
    Tier tier_;
    float exposure_;  ///< that what is stored is made for
    float root_range_;
    int first_level_ = 0;
    std::vector<StepCube> steps_;
    std::vector<RoughStep> rough_steps_;
    float view_exposure_ = 1.0f;  ///< of the frame being drawn
    std::vector<Chosen> chosen_;  ///< by material
    gl::Texture sharp_;
    gl::Texture rough_;
    std::vector<Adopted> adopted_;
};

const EnvironmentMap EnvironmentWork::kNothing{};

std::unique_ptr<EffectWork> prepare(Renderer& renderer) { return std::make_unique<EnvironmentWork>(renderer); }

}  // namespace

std::array<std::uint8_t, 4> packed_rgbm(const glm::vec3& light, float root_range) {
    glm::vec3 root{0.0f};
    for (int i = 0; i < 3; ++i) root[i] = light[i] > 0.0f ? std::min(std::sqrt(light[i]) / root_range, 1.0f) : 0.0f;
    const float largest = std::max({root.r, root.g, root.b});
    const float multiplier = std::clamp(std::ceil(largest * 255.0f), 1.0f, 255.0f);
    std::array<std::uint8_t, 4> texel{};
    for (std::size_t i = 0; i < 3; ++i) {
        const float share = root[static_cast<int>(i)] * 255.0f / multiplier;
        texel[i] = static_cast<std::uint8_t>(std::lround(std::min(share, 1.0f) * 255.0f));
    }
    texel[3] = static_cast<std::uint8_t>(multiplier);
    return texel;
}

int level_for(const EnvironmentMap& map, float smoothness, int largest_size) {
    const auto last = static_cast<int>(map.levels.size()) - 1;
    const auto wished = static_cast<int>(std::lround((1.0f - smoothness) * static_cast<float>(map.roughest_level)));
    int level = std::clamp(wished, 0, last);
    while (level < last && std::max(map.size >> level, 1) > largest_size) ++level;
    return level;
}

int level_step(const EnvironmentMap& map, float smoothness) {
    const float level = (1.0f - smoothness) * static_cast<float>(map.roughest_level);
    const float part = level - std::floor(level);
    return static_cast<int>(std::lround((level + 0.4f * part * (1.0f - part)) * ENVIRONMENT_STEPS));
}

std::vector<glm::vec3> texels_of_step(const EnvironmentMap& map, int step) {
    const int level = step / ENVIRONMENT_STEPS;
    const float part = static_cast<float>(step % ENVIRONMENT_STEPS) / ENVIRONMENT_STEPS;
    std::vector<glm::vec3> texels = map.levels[static_cast<std::size_t>(level)];
    if (part == 0.0f) return texels;
    const std::vector<glm::vec3>& coarse = map.levels[static_cast<std::size_t>(level) + 1];
    const int side = map.size >> level;
    const int half = side / 2;
    std::size_t at = 0;
    for (int face = 0; face < 6; ++face) {
        const glm::vec3* from = coarse.data() + static_cast<std::size_t>(face * half * half);
        for (int y = 0; y < side; ++y) {
            // Row y lies between rows (y - 1) / 2 and that + 1, a quarter or three quarters of the way, clamped as a
            // sampler does.
            const int above = std::max((y - 1) >> 1, 0), below = std::min((y + 1) >> 1, half - 1);
            const float down = (y & 1) != 0 ? 0.25f : 0.75f;
            for (int x = 0; x < side; ++x, ++at) {
                const int left = std::max((x - 1) >> 1, 0), right = std::min((x + 1) >> 1, half - 1);
                const float across = (x & 1) != 0 ? 0.25f : 0.75f;
                const glm::vec3 upper = glm::mix(from[above * half + left], from[above * half + right], across);
                const glm::vec3 lower = glm::mix(from[below * half + left], from[below * half + right], across);
                texels[at] = glm::mix(texels[at], glm::mix(upper, lower, down), part);
            }
        }
    }
    return texels;
}

const EffectCard kEnvironment{
    .name = "environment",
    .purpose = "Lights surfaces from a prefiltered map of their surroundings: diffuse light and reflections.",
    .sources =
        "S. Lagarde and L. Harduin, GDC Europe 2013, image based lighting; ATI CubeMapGen; R. Ramamoorthi and P. "
        "Hanrahan, An Efficient Representation for Irradiance Environment Maps, SIGGRAPH 2001",
    .kind = EffectKind::material,
    .called_for_by = "Scene::environment",
    .budget_row = "environment",
    .tiers = {TierCard{
                  {},
                  "none of its own",
                  "diffuse light by vertex; reflections from one small RGBM8 cube, mixed from two where smoothness "
                  "varies, so mirrors are soft"},
              TierCard{{},
                       "none of its own",
                       "diffuse light by vertex, by pixel under a normal map; one fetch from the level of an RGBM8 "
                       "cube that fits the power, from a cube of one level where smoothness does not vary"},
              TierCard{{},
                       "none of its own",
                       "as console, diffuse light always by pixel, from an RGBA16F cube and in highp"}},
    .called_for = called_for,
    .add_passes = nullptr,
    .insertions = insertions,
    .add_defines = add_defines,
    .prepare = prepare,
};

}  // namespace halfframe
