// The models of the environment: one prefiltered level and the glossy Fresnel for a whole integral, and two levels for
// the lobe between them.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "content/environment/lobe_powers.h"
#include "engine/effects/environment/environment_reference.h"
#include "engine/effects/environment/reflection_harmonics.h"
#include "engine/effects/surface/surface_by_vertex.h"
#include "engine/effects/surface/surface_reference.h"
#include "engine/effects/tone_map/tone_map_reference.h"
#include "engine/frame/cube_face.h"
#include "perf/accuracy/model_list.h"

namespace halfframe::accuracy {
namespace {

using Direction = std::array<double, 3>;
using Radiance = std::function<double(const Direction&)>;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr int kCubeSize = 128;      // the default of content::EnvironmentOptions
constexpr int kLobeSteps = 96;      // a side; doubling it moves no error by more than 0.5 codes
constexpr int kRoughSide = 8;       // texels of a cube that vertices know as harmonics
constexpr int kRoughSteps = 48;     // as kLobeSteps, for its texels
constexpr double kSky = 0.3;        // radiance of the sky: half of it on screen
constexpr double kGround = 0.05;    // of what lies below the surface's own horizon
constexpr double kLamp = 6.0;       // of a lamp: far above white
constexpr double kHarshLamp = 60.0;  // as bright as RGBM8 keeps: two hundred times the sky
constexpr double kLampEdge = 10.0;  // its half angle [deg]; soft over 4 degrees

double dot(const Direction& a, const Direction& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// In the plane of incidence, `angle_deg` from the normal on the side away from the eye.
Direction in_plane(double angle_deg) { return {-std::sin(angle_deg * kDegree), 0.0, std::cos(angle_deg * kDegree)}; }

/// A lamp in an even sky over a dark ground; the surface's normal is +Z.
Radiance sky_with_lamp(const Direction& lamp, double light = kLamp) {
    return [lamp, light](const Direction& l) {
        const double from_lamp_deg = std::acos(std::clamp(dot(l, lamp), -1.0, 1.0)) / kDegree;
        const double inside = std::clamp((kLampEdge + 2.0 - from_lamp_deg) / 4.0, 0.0, 1.0);
        return (l[2] > 0.0 ? kSky : kGround) + light * inside * inside * (3.0 - 2.0 * inside);
    };
}

/// Mean of `radiance` under the Phong lobe (r.l)^power: what a prefiltered cube holds. `steps` a side.
double smoothed(const Radiance& radiance, const Direction& r, double power, int steps = kLobeSteps) {
    const double across = std::hypot(r[0], r[2]);  // `up` and `side` lie across r
    const Direction up = across > 0.0 ? Direction{r[2] / across, 0.0, -r[0] / across} : Direction{1.0, 0.0, 0.0};
    const Direction side{r[1] * up[2], r[2] * up[0] - r[0] * up[2], -r[1] * up[0]};
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double cosine = std::pow((i + 0.5) / steps, 1.0 / (power + 1.0));
        const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
        for (int k = 0; k < steps; ++k) {
            const double turn = 2.0 * std::numbers::pi * (k + 0.5) / steps;
            const double x = sine * std::cos(turn), y = sine * std::sin(turn);
            sum += radiance({cosine * r[0] + x * up[0] + y * side[0], cosine * r[1] + x * up[1] + y * side[1],
                             cosine * r[2] + x * up[2] + y * side[2]});
        }
    }
    return sum / (double(steps) * steps);
}

double blinn_power(double smoothness) { return std::exp2(10.0 * smoothness + 1.0); }

double codes(double model, double truth) {
    return 255.0 * (reference::tone_curve(model) - reference::tone_curve(truth));
}

std::vector<ModelError> integral_errors(GlossyFresnel fresnel) {
    std::vector<ModelError> errors;
    for (int place = 0; place < 10; ++place) {
        const double view_deg = 8.0 * place;  // to 72 degrees
        const Direction to_eye{std::sin(view_deg * kDegree), 0.0, std::cos(view_deg * kDegree)};
        for (int step = 0; step <= 10; ++step) {
            const double smoothness = 0.1 * step, power = blinn_power(smoothness);
            for (const double beside_deg : {0.0, -12.0, -40.0}) {  // of the lamp from the mirror direction
                const Radiance radiance = sky_with_lamp(in_plane(view_deg + beside_deg));
                const double level = smoothed(radiance, in_plane(view_deg), content::phong_power(power));
                for (const double specular : {0.0437, 0.5, 1.0}) {
                    const double truth =
                        reference::reflected_light_ggx(radiance, to_eye, specular, 2.0 / (power + 2.0), kLobeSteps);
                    errors.push_back({{view_deg, smoothness, specular, beside_deg},
                                      codes(level * fresnel(specular, smoothness, to_eye[2]), truth)});
                }
            }
        }
    }
    return errors;
}

std::vector<ModelError> level_errors(LevelOfSmoothness level_of) {
    const std::vector<double> powers = content::blinn_powers(kCubeSize);
    const int roughest = content::roughest_level(kCubeSize);
    std::vector<ModelError> errors;
    for (int place = 0; place <= 16; ++place) {
        const double beside_deg = 3.0 * place;
        const Radiance radiance = sky_with_lamp(in_plane(beside_deg));
        const Direction r{0.0, 0.0, 1.0};
        std::vector<double> levels;
        for (int i = 0; i <= roughest; ++i) {
            levels.push_back(smoothed(radiance, r, content::phong_power(powers[static_cast<std::size_t>(i)])));
        }
        for (int step = 0; step <= 40; ++step) {
            const double smoothness = step / 40.0;
            const double level = level_of(smoothness, roughest);
            const auto below = static_cast<std::size_t>(std::min(std::floor(level), roughest - 1.0));
            const double part = level - static_cast<double>(below);
            const double mixed = levels[below] + (levels[below + 1] - levels[below]) * part;
            const double truth = smoothed(radiance, r, content::phong_power(blinn_power(smoothness)));
            errors.push_back({{beside_deg, smoothness}, codes(mixed, truth)});
        }
    }
    return errors;
}

/// What a level of a cube holds of `radiance`: kRoughSide texels a side.
std::vector<glm::vec3> smoothed_cube(const Radiance& radiance, double power) {
    std::vector<glm::vec3> texels;
    for (int i = 0; i < 6 * kRoughSide * kRoughSide; ++i) {
        const auto middle = [](int index) { return (2.0 * index + 1.0) / kRoughSide - 1.0; };
        const glm::dvec3 n = glm::normalize(
            face_direction(i / (kRoughSide * kRoughSide), middle(i % kRoughSide), middle(i / kRoughSide % kRoughSide)));
        texels.emplace_back(static_cast<float>(smoothed(radiance, {n.x, n.y, n.z}, power, kRoughSteps)));
    }
    return texels;
}

reference::RoughTerms first_channel(const ReflectionHarmonics& terms) {
    reference::RoughTerms result;
    for (std::size_t i = 0; i < result.nine.size(); ++i) result.nine[i] = terms[i].r;
    result.axis = {terms[kHarmonicsAxis].x, terms[kHarmonicsAxis].y, terms[kHarmonicsAxis].z};
    result.third = terms[kHarmonicsAxis + 1].r;
    result.fourth = terms[kHarmonicsAxis + 2].r;
    return result;
}

std::vector<ModelError> rough_errors(RoughReflection reflection, double lamp) {
    const std::vector<double> powers = content::blinn_powers(kCubeSize);
    const int roughest = content::roughest_level(kCubeSize);
    const auto cube_of_level = [&](const Radiance& radiance, int level) {
        return smoothed_cube(radiance, content::phong_power(powers[static_cast<std::size_t>(level)]));
    };
    std::vector<ModelError> errors;
    for (int place = 0; place <= 24; ++place) {
        const double beside_deg = 7.5 * place;
        const Radiance radiance = sky_with_lamp(in_plane(beside_deg), lamp);
        const std::vector<glm::vec3> fine = cube_of_level(radiance, roughest - 1), coarse = cube_of_level(radiance, roughest);
        for (int step = 0; step <= 20; ++step) {
            const double roughness = kRoughByVertex + (1.0 - kRoughByVertex) * step / 20.0;
            const double power = reference::power_from_roughness(roughness);
            const double level =
                reference::constant_reflection_level(reference::smoothness_from_power(power), roughest);
            std::vector<glm::vec3> cube = fine;
            for (std::size_t i = 0; i < cube.size(); ++i)
                cube[i] = glm::mix(fine[i], coarse[i], static_cast<float>(level - roughest + 1.0));
            const double model =
                reflection({0.0, 0.0, 1.0}, first_channel(reflection_harmonics(cube, kRoughSide)));
            const double truth = smoothed(radiance, {0.0, 0.0, 1.0}, content::phong_power(power), kLobeSteps);
            errors.push_back({{beside_deg, roughness}, codes(model, truth)});
        }
    }
    return errors;
}

}  // namespace

ModelEntry reflection_by_vertex(RoughReflection reflection) {
    return {.effect = "environment",
            .model = "reflection, by vertex",
            .truth = "the lobe of that roughness itself, on the same sky",
            .unit = "codes",
            .axes = {"lamp beside the mirror direction [deg]", "roughness"},
            .errors = [reflection] { return rough_errors(reflection, kLamp); },
            .largest = {3.2, "at roughness 0.75, the narrowest lobe, where it ends: 3.00; without bands 3 and 4 12.2"},
            .mean = {0.82, "0.78; without band 4 1.07, without both 2.2"}};
}

ModelEntry reflection_by_vertex_of_harsh_lamp(RoughReflection reflection) {
    ModelEntry entry = reflection_by_vertex(reflection);
    entry.model = "reflection, by vertex, a lamp of 200 skies";
    entry.truth = "the lobe of that roughness itself, on a sky of 0.3 with a lamp of 60, 20 degrees wide";
    entry.errors = [reflection] { return rough_errors(reflection, kHarshLamp); };
    entry.largest = {11.7, "behind the lamp at roughness 0.75: 11.1; without band 4 17.6, without bands 3 and 4 30.3"};
    entry.mean = {2.85, "2.71; without band 4 5.3, without both 6.1"};
    return entry;
}

ModelEntry reflection_of_integral(GlossyFresnel fresnel) {
    return {
        .effect = "environment",
        .model = "reflection, one level",
        .truth = "the integral of GGX, alpha^2 = 2 / (power + 2), over a sky of 0.3 with a lamp of 6, 20 degrees wide",
        .unit = "codes",
        .axes = {"view [deg]", "smoothness", "specular", "lamp beside the mirror direction [deg]"},
        .errors = [fresnel] { return integral_errors(fresnel); },
        .largest = {57.0,
                    "at 72 degrees the lobe of GGX stretches and gains, the level round the mirror direction does "
                    "neither: -56.2"},
        .mean = {9.9,
                 "9.62: rough surfaces gain, for the talk's Fresnel knows no masking (27 codes at smoothness 0); "
                 "smooth ones have 3"}};
}

ModelEntry reflection_between_levels(LevelOfSmoothness level) {
    return {.effect = "environment",
            .model = "reflection, between levels",
            .truth = "the lobe of that smoothness itself, on the same sky",
            .unit = "codes",
            .axes = {"lamp beside the mirror direction [deg]", "smoothness"},
            .errors = [level] { return level_errors(level); },
            .largest = {17.5, "a lamp just beside the lobe: the wider level lends the narrow one its flank: 16.9"},
            .mean = {1.62, "1.57; not bent it is 1.65, bent by 0.8 of f (1 - f) 1.9"}};
}

ModelEntry reflection_of_constant_smoothness(LevelOfSmoothness level) {
    ModelEntry entry = reflection_between_levels(level);
    entry.model = "reflection, a cube for one smoothness";
    entry.largest = {17.5, "17.0; to a quarter of a level 21.2, to half of one more"};
    entry.mean = {1.65, "1.62: an eighth of a level is 8 % of the width of a lobe at most; to a quarter it is 1.89"};
    return entry;
}

}  // namespace halfframe::accuracy
