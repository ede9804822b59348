// Metallic-roughness of glTF 2.0, the talk's model, and their hemispherical sums, in double.
#include "engine/effects/surface/surface_model_reference.h"

#include <cmath>
#include <numbers>

#include "engine/effects/surface/surface_reference.h"

namespace halfframe::reference {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kHeights = 256, kTurns = 64;  // turns of half a circle: the other half is its mirror image

double fifth_power(double x) { return x * x * x * x * x; }

/// Smith's height-correlated masking and shadowing over 4 n.l n.v, as appendix B writes it.
double visibility(double alpha, double n_l, double n_v) {
    const double rest = 1.0 - alpha * alpha;
    const double view = n_l * std::sqrt(n_v * n_v * rest + alpha * alpha);
    const double light = n_v * std::sqrt(n_l * n_l * rest + alpha * alpha);
    return 0.5 / (view + light);
}

/// Sums over half vectors whose squared cosine with n is squared_cosine(u), u even in 0..1. weight(at) is brdf n.l over
/// the density of the light directions, without its Fresnel factor.
template <typename SquaredCosine, typename Weight>
SplitSum summed(double n_v, SquaredCosine squared_cosine, Weight weight) {
    const double sine = std::sqrt(1.0 - n_v * n_v);
    SplitSum sum{0.0, 0.0};
    for (int i = 0; i < kHeights; ++i) {
        const double n_h = std::sqrt(squared_cosine((i + 0.5) / kHeights));
        const double across = std::sqrt(std::fmax(1.0 - n_h * n_h, 0.0));
        for (int j = 0; j < kTurns; ++j) {
            const double l_h = sine * across * std::cos((j + 0.5) / kTurns * kPi) + n_v * n_h;
            const double n_l = 2.0 * l_h * n_h - n_v;
            if (l_h <= 0.0 || n_l <= 0.0) continue;
            const double share = weight(Cosines{n_l, n_v, n_h, l_h}) / (kHeights * kTurns);
            const double grazing = fifth_power(1.0 - l_h);
            sum.scale += share * (1.0 - grazing);
            sum.bias += share * grazing;
        }
    }
    return sum;
}

double gltf_specular(double base, double metallic) { return 0.04 + (base - 0.04) * metallic; }

}  // namespace

double gltf_brdf(double base, double metallic, double roughness, const Cosines& at) {
    const double alpha = roughness * roughness;
    const double fresnel = fresnel_schlick(gltf_specular(base, metallic), at.l_h);
    const double width = at.n_h * at.n_h * (alpha * alpha - 1.0) + 1.0;
    const double density = alpha * alpha / (kPi * width * width);
    const double diffuse = base * (1.0 - metallic) / kPi;
    return (1.0 - fresnel) * diffuse + fresnel * density * visibility(alpha, at.n_l, at.n_v);
}

double talk_brdf(double albedo, double specular, double power, const Cosines& at) {
    const double lobe = (power + 2.0) / 8.0 * std::pow(at.n_h, power);
    return (albedo + fresnel_schlick(specular, at.l_h) * lobe) / kPi;
}

double mapped_albedo(double base, double metallic) { return base * (1.0 - metallic); }

double mapped_specular(double base, double metallic) {
    const double dielectric = std::pow((59.0 / 255.0 + 0.055) / 1.055, 2.4);  // IEC 61966-2-1
    return dielectric + (base - dielectric) * metallic;
}

SplitSum split_sum_ggx(double alpha, double n_v) {
    return summed(
        n_v, [&](double u) { return (1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u); },
        [&](const Cosines& at) { return visibility(alpha, at.n_l, at.n_v) * at.n_l * 4.0 * at.l_h / at.n_h; });
}

SplitSum split_sum_blinn(double power, double n_v) {
    // Half vectors as dense as (n.h)^(power + 1): the lobe over that density is n.l l.h / n.h.
    return summed(
        n_v, [&](double u) { return std::pow(u, 2.0 / (power + 2.0)); },
        [](const Cosines& at) { return at.n_l * at.l_h / at.n_h; });
}

SplitSum split_sum_lambert(double n_v) {
    const double sine = std::sqrt(1.0 - n_v * n_v);
    SplitSum sum{0.0, 0.0};
    for (int i = 0; i < kHeights; ++i) {
        const double n_l = std::sqrt((i + 0.5) / kHeights);
        const double across = std::sqrt(1.0 - n_l * n_l);
        for (int j = 0; j < kTurns; ++j) {
            const double l_v = sine * across * std::cos((j + 0.5) / kTurns * kPi) + n_v * n_l;
            const double grazing = fifth_power(1.0 - std::sqrt(std::fmax(0.5 * (1.0 + l_v), 0.0)));
            sum.scale += (1.0 - grazing) / (kHeights * kTurns);
            sum.bias += grazing / (kHeights * kTurns);
        }
    }
    return sum;
}

double gltf_reflectance(double base, double metallic, const SplitSum& ggx, const SplitSum& lambert) {
    const double specular = gltf_specular(base, metallic);
    return base * (1.0 - metallic) * (1.0 - lambert.of(specular)) + ggx.of(specular);
}

}  // namespace halfframe::reference
