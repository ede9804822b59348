// The layered model of wet surfaces against photons: films, grains and layers traced one ray at a time, by Snell and
// Fresnel alone and with none of the closed sums.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <initializer_list>
#include <numbers>
#include <random>

#include "engine/effects/wet_surface/wet_surface_model_reference.h"

namespace halfframe {
namespace {

constexpr double kPi = std::numbers::pi;

/// Even numbers of a fixed seed: std::uniform_real_distribution differs from library to library.
class Dice {
public:
    explicit Dice(std::uint64_t seed) : engine_(seed) {}
    double operator()() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

private:
    std::mt19937_64 engine_;
};

/// Amplitudes of the two polarisations, from the angles: Fresnel's sines and tangents (1823). Beyond the critical angle
/// all is reflected.
double reflectance(double index, double cosine, bool along) {
    const double outside = std::acos(cosine), sine = std::sin(outside) / index;
    if (sine >= 1.0) return 1.0;
    if (outside < 1e-6) return std::pow((index - 1.0) / (index + 1.0), 2.0);
    const double inside = std::asin(sine);
    const double amplitude = along ? std::tan(outside - inside) / std::tan(outside + inside)
                                   : std::sin(outside - inside) / std::sin(outside + inside);
    return amplitude * amplitude;
}

double refracted(double index, double cosine) { return std::sqrt(1.0 - (1.0 - cosine * cosine) / (index * index)); }

/// Follows one photon from air to a Lambertian body under flat layers of `indices` (the last one is the body's side),
/// until it is out again or absorbed. True where it came back diffusely. Polarisation is kept between the layers and
/// lost in the body.
bool comes_back(std::initializer_list<double> indices, double body, double cosine, Dice& dice) {
    const double* index = indices.begin();
    const int layers = static_cast<int>(indices.size());
    int layer = 0;  // 0 is air; index[layer - 1] that of a layer
    bool down = true, along = dice() < 0.5, was_below = false;
    const auto index_of = [&](int at) { return at == 0 ? 1.0 : index[at - 1]; };
    for (;;) {
        if (down && layer == layers) {
            if (dice() >= body) return false;
            was_below = true;
            down = false;
            cosine = std::sqrt(dice());
            along = dice() < 0.5;
        }
        const int next = down ? layer + 1 : layer - 1;
        if (next < 0) return was_below;
        const double relative = index_of(next) / index_of(layer);
        if (dice() < reflectance(relative, cosine, along)) {
            down = !down;
            if (layer == 0) return was_below;  // mirrored off the top: never was in
        } else {
            cosine = refracted(relative, cosine);
            layer = next;
            if (layer == 0) return was_below;
        }
    }
}

double share_back(std::initializer_list<double> indices, double body, double cosine, std::uint64_t seed) {
    constexpr int kPhotons = 200'000;
    Dice dice(seed);
    int back = 0;
    for (int photon = 0; photon < kPhotons; ++photon) back += comes_back(indices, body, cosine, dice) ? 1 : 0;
    return static_cast<double>(back) / kPhotons;
}

/// Four standard deviations of a share of 200 000 photons at its worst (one half).
constexpr double kPhotonNoise = 4.0 * 0.5 / 447.0;

TEST(WetModel, AFilmOverSoakedGrainsIsWhatPhotonsSay) {
    for (const double albedo : {0.1, 0.4, 0.8}) {
        for (const double degrees : {0.0, 50.0, 80.0}) {
            const double cosine = std::cos(degrees * kPi / 180.0);
            const double found = albedo * reference::wet_diffuse_factor(albedo, 1.0, 1.0, cosine);
            const double traced = share_back({reference::kWaterIndex}, reference::soaked_albedo(albedo), cosine, 11);
            EXPECT_NEAR(found, traced, kPhotonNoise) << albedo << " " << degrees;
        }
    }
}

TEST(WetModel, WaterOverAClosedBodyIsWhatPhotonsSay) {
    for (const double body : {0.2, 0.6, 0.95}) {
        // The albedo that such a body shows in diffuse light, itself from photons.
        constexpr int kPhotons = 200'000;
        Dice dice(5);
        int back = 0;
        for (int photon = 0; photon < kPhotons; ++photon) {
            const double cosine = std::sqrt(dice());
            back += comes_back({reference::kStoneIndex}, body, cosine, dice) ? 1 : 0;
        }
        const double albedo = static_cast<double>(back) / kPhotons;
        for (const double degrees : {0.0, 50.0, 80.0}) {
            const double cosine = std::cos(degrees * kPi / 180.0);
            const double dry = share_back({reference::kStoneIndex}, body, cosine, 7);
            const double wet = share_back({reference::kWaterIndex, reference::kStoneIndex}, body, cosine, 13);
            // Twice the noise: two of these shares are divided, and the third has made the body.
            EXPECT_NEAR(dry * reference::wet_diffuse_factor(albedo, 0.0, 1.0, cosine), wet, 2.0 * kPhotonNoise)
                << body << " " << degrees;
        }
    }
}

TEST(WetModel, WaterOnStoneMirrorsWhatPhotonsSay) {
    for (const double degrees : {0.0, 50.0, 70.0, 85.0}) {
        const double cosine = std::cos(degrees * kPi / 180.0);
        // A white body whose light all comes back diffusely: the rest was mirrored.
        const double traced = 1.0 - share_back({reference::kWaterIndex, reference::kStoneIndex}, 1.0, cosine, 17);
        EXPECT_NEAR(reference::film_reflectance(cosine), traced, kPhotonNoise) << degrees;
        const reference::Stack stack = reference::water_on_stone(cosine);
        EXPECT_NEAR(stack.reflected + stack.transmitted, 1.0, 1e-12) << "nothing is absorbed in clear water";
    }
}

TEST(WetModel, GrainsTurnLightAsTracedRaysDo) {
    for (const double index : {reference::kStoneIndex, reference::kStoneIndex / reference::kWaterIndex}) {
        double turned = 0.0;
        constexpr int kRays = 2000;
        for (int ray = 0; ray < kRays; ++ray) {
            const double outside = std::asin(std::sqrt((ray + 0.5) / kRays)),
                         inside = std::asin(std::sin(outside) / index);
            for (const bool along : {false, true}) {
                const double reflected = reflectance(index, std::cos(outside), along);
                turned += 0.5 * reflected * std::cos(kPi - 2.0 * outside) / kRays;
                // Into the sphere, turned by outside - inside; each inner reflection turns by pi - 2 inside more.
                double left = (1.0 - reflected) * (1.0 - reflected), angle = 2.0 * (outside - inside);
                while (left > 1e-12) {
                    turned += 0.5 * left * std::cos(angle) / kRays;
                    left *= reflected;
                    angle += kPi - 2.0 * inside;
                    if (reflected >= 1.0) break;
                }
            }
        }
        EXPECT_NEAR(reference::sphere_asymmetry(index), turned, 1e-3) << index;  // 1e-3: 2000 rays at the sphere's rim
    }
}

/// Share of diffuse light that a layer without end sends back: photons that turn after Henyey and Greenstein (1941).
double layer_by_photons(double scattered, double asymmetry) {
    constexpr int kPhotons = 40'000;
    Dice dice(23);
    double back = 0.0;
    for (int photon = 0; photon < kPhotons; ++photon) {
        double depth = 0.0, cosine = std::sqrt(dice()), weight = 1.0;  // cosine > 0 leads down
        while (weight > 1e-4) {
            depth -= cosine * std::log(1.0 - dice());
            if (depth < 0.0) {
                back += weight;
                break;
            }
            weight *= scattered;
            const double g = asymmetry, part = (1.0 - g * g) / (1.0 - g + 2.0 * g * dice());
            const double turn = (1.0 + g * g - part * part) / (2.0 * g);
            const double across = std::sqrt(std::max((1.0 - turn * turn) * (1.0 - cosine * cosine), 0.0));
            cosine = std::clamp(cosine * turn + across * std::cos(2.0 * kPi * dice()), -1.0, 1.0);
        }
    }
    return back / kPhotons;
}

TEST(WetModel, ALayerOfGrainsSendsBackWhatPhotonsSay) {
    for (const double scattered : {0.5, 0.9, 0.98}) {
        for (const double asymmetry : {0.642, 0.907}) {
            // 0.012: van de Hulst's formula within 0.005, 40 000 photons within 0.007
            EXPECT_NEAR(reference::layer_albedo(scattered, asymmetry), layer_by_photons(scattered, asymmetry), 0.012)
                << scattered << " " << asymmetry;
        }
    }
}

TEST(WetModel, RadianceToAllViewsAddsUpToTheWhole) {
    const double whole = 1.0 - reference::diffuse_reflectance(reference::kStoneIndex);
    for (const double porosity : {0.0, 1.0}) {
        double sum = 0.0;
        constexpr int kViews = 4000;
        for (int view = 0; view < kViews; ++view) {
            const double n_v = std::sqrt((view + 0.5) / kViews);
            // What a closed dry body sends to a view follows its own surface; grains send the same to all.
            const double closed = (1.0 - reference::dielectric_reflectance(reference::kStoneIndex, n_v)) / whole;
            const double dry = porosity == 0.0 ? closed : 1.0;
            sum += dry * reference::wet_radiance_factor(0.3, porosity, 1.0, 0.6, n_v) / kViews;
        }
        EXPECT_NEAR(sum, reference::wet_diffuse_factor(0.3, porosity, 1.0, 0.6), 1e-3) << porosity;
    }
}

TEST(WetModel, KnownEnds) {
    EXPECT_NEAR(reference::dielectric_reflectance(1.33, 1.0), std::pow(0.33 / 2.33, 2.0), 1e-15);
    EXPECT_EQ(reference::dielectric_reflectance(1.33, 0.0), 1.0);
    EXPECT_EQ(reference::dielectric_reflectance(1.0 / 1.33, 0.5), 1.0) << "past the critical angle";
    // Two published means: water from outside 0.066, from inside 0.472 (Lekner and Dorf 1988 use both).
    EXPECT_NEAR(reference::diffuse_reflectance(1.33), 0.066, 5e-4);
    EXPECT_NEAR(reference::diffuse_reflectance(1.0 / 1.33), 0.472, 5e-4);
    EXPECT_EQ(reference::layer_albedo(1.0, 0.9), 1.0) << "nothing absorbs";
    EXPECT_EQ(reference::layer_albedo(0.0, 0.6), 0.0) << "nothing is scattered: s is 1";
    for (const double albedo : {0.02, 0.3, 0.85}) {
        EXPECT_NEAR(reference::layer_albedo(reference::scattered_share(albedo, 0.64), 0.64), albedo, 1e-12);
        EXPECT_LT(reference::soaked_albedo(albedo), albedo);
        EXPECT_EQ(reference::wet_diffuse_factor(albedo, 0.7, 0.0, 0.5), 1.0) << "dry";
        EXPECT_LT(reference::wet_diffuse_factor(albedo, 1.0, 1.0, 0.5), 0.75) << "pores darken";
        EXPECT_GT(reference::wet_diffuse_factor(albedo, 0.0, 1.0, 0.5), 1.0) << "a closed surface does not";
    }
}

}  // namespace
}  // namespace halfframe
