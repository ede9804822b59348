// Fresnel, grains and films of water, in double. Every hemisphere is a midpoint sum over the squared sine.
#include "engine/effects/wet_surface/wet_surface_model_reference.h"

#include <cmath>
#include <initializer_list>

namespace halfframe::reference {
namespace {

constexpr int kSteps = 4096;  // over a hemisphere: 1e-4 where the grazing end is steepest

struct Interface {
    double across = 1.0, along = 1.0;  ///< reflectance of the two polarisations
    double cosine_inside = 0.0;        ///< of the refracted ray; 0 where all is reflected
};

Interface meet(double index, double cosine) {
    const double squared_sine = (1.0 - cosine * cosine) / (index * index);
    if (squared_sine >= 1.0) return {};
    const double inside = std::sqrt(1.0 - squared_sine);
    const double across = (cosine - index * inside) / (cosine + index * inside);
    const double along = (index * cosine - inside) / (index * cosine + inside);
    return {across * across, along * along, inside};
}

/// Mean of f(cosine) over a hemisphere, weighted with the cosine.
template <typename Function>
double hemisphere_mean(Function f) {
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) sum += f(std::sqrt((i + 0.5) / kSteps));
    return sum / kSteps;
}

/// Diffuse light that comes back through a surface which lets `entering` in and reflects `inner` of what comes from
/// below, from a body of that albedo: all the ways to and fro added up (J. L. Saunderson 1942).
double through(double entering, double inner, double body) {
    return entering * (1.0 - inner) * body / (1.0 - inner * body);
}

/// What a surface reflects of diffuse light from below, where `outer` is reflected from above: radiance grows with the
/// square of the index, so only 1 / index^2 of it can leave.
double inner_reflectance(double outer, double index) { return 1.0 - (1.0 - outer) / (index * index); }

/// Constants of the two bases; each costs a hemisphere of sums.
struct Bases {
    double stone = diffuse_reflectance(kStoneIndex);  ///< outer reflectances of diffuse light
    double water = diffuse_reflectance(kWaterIndex);
    double both = hemisphere_mean([](double cosine) { return water_on_stone(cosine).reflected; });
    double dry_asymmetry = sphere_asymmetry(kStoneIndex);
    double soaked_asymmetry = sphere_asymmetry(kStoneIndex / kWaterIndex);
};

const Bases& bases() {
    static const Bases all;
    return all;
}

/// Wet over dry of directed light that comes back diffusely, of the two kinds of base under a whole film.
struct Factors {
    double porous = 1.0, closed = 1.0;
};

Factors factors(double albedo, double cosine) {
    if (albedo <= 0.0) return {};
    const Bases& base = bases();
    // Closed: the body whose albedo under its own surface is the one that was measured.
    const double inner = inner_reflectance(base.stone, kStoneIndex);
    const double body = albedo / ((1.0 - base.stone) * (1.0 - inner) + inner * albedo);
    const double dry = through(1.0 - dielectric_reflectance(kStoneIndex, cosine), inner, body);
    const double wet = through(water_on_stone(cosine).transmitted, inner_reflectance(base.both, kStoneIndex), body);
    // Porous: a film over grains in water.
    const double soaked = through(1.0 - dielectric_reflectance(kWaterIndex, cosine),
                                  inner_reflectance(base.water, kWaterIndex), soaked_albedo(albedo));
    return {soaked / albedo, dry > 0.0 ? wet / dry : 1.0};
}

double mixed(const Factors& at, double porosity, double wetness) {
    return 1.0 + wetness * (porosity * at.porous + (1.0 - porosity) * at.closed - 1.0);
}

}  // namespace

double dielectric_reflectance(double index, double cosine) {
    const Interface at = meet(index, cosine);
    return 0.5 * (at.across + at.along);
}

double diffuse_reflectance(double index) {
    return hemisphere_mean([index](double cosine) { return dielectric_reflectance(index, cosine); });
}

double sphere_asymmetry(double index) {
    return hemisphere_mean([index](double cosine) {
        const Interface at = meet(index, cosine);
        const double twice_outside = 2.0 * std::acos(cosine), twice_inside = 2.0 * std::acos(at.cosine_inside);
        double mean = 0.0;
        for (const double reflected : {at.across, at.along}) {
            const double passed = (1.0 - reflected) * (1.0 - reflected);
            const double turned = std::cos(twice_outside - twice_inside) + reflected * std::cos(twice_outside);
            mean += 0.5 * (passed * turned / (1.0 + reflected * reflected + 2.0 * reflected * std::cos(twice_inside)) -
                           reflected * std::cos(twice_outside));
        }
        return mean;
    });
}

double layer_albedo(double scattered, double asymmetry) {
    const double s = std::sqrt((1.0 - scattered) / (1.0 - scattered * asymmetry));
    return (1.0 - s) * (1.0 - 0.139 * s) / (1.0 + 1.17 * s);
}

double scattered_share(double albedo, double asymmetry) {
    double low = 0.0, high = 1.0;
    for (int halving = 0; halving < 52; ++halving) {
        const double middle = 0.5 * (low + high);
        (layer_albedo(middle, asymmetry) < albedo ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double soaked_albedo(double albedo) {
    return layer_albedo(scattered_share(albedo, bases().dry_asymmetry), bases().soaked_asymmetry);
}

Stack water_on_stone(double cosine) {
    const Interface top = meet(kWaterIndex, cosine);
    const Interface below = meet(kStoneIndex / kWaterIndex, top.cosine_inside);
    Stack stack;
    const double pairs[2][2] = {{top.across, below.across}, {top.along, below.along}};
    for (const auto& [first, second] : pairs) {
        const double to_and_fro = 1.0 - first * second;
        stack.reflected += 0.5 * (first + (1.0 - first) * (1.0 - first) * second / to_and_fro);
        stack.transmitted += 0.5 * (1.0 - first) * (1.0 - second) / to_and_fro;
    }
    return stack;
}

double wet_diffuse_factor(double albedo, double porosity, double wetness, double cosine) {
    return mixed(factors(albedo, cosine), porosity, wetness);
}

double wet_radiance_factor(double albedo, double porosity, double wetness, double n_l, double n_v) {
    const Bases& base = bases();
    Factors at = factors(albedo, n_l);
    // What a diffuse body sends up leaves by the same ways as light comes in; over their mean it is 1 on average.
    at.porous *= (1.0 - dielectric_reflectance(kWaterIndex, n_v)) / (1.0 - base.water);
    const double dry = (1.0 - dielectric_reflectance(kStoneIndex, n_v)) / (1.0 - base.stone);
    if (dry > 0.0) at.closed *= water_on_stone(n_v).transmitted / (1.0 - base.both) / dry;
    return mixed(at, porosity, wetness);
}

}  // namespace halfframe::reference
