// Wet materials as the talk defines them, in double: what wet_surface.glsl is measured against. Shares no code with it.
#pragma once

#include <array>

namespace halfframe::reference {

/// A material in the talk's parameters. Linear, every value 0..1.
struct MaterialValues {
    std::array<double, 3> albedo{};
    std::array<double, 3> specular{};
    double smoothness = 0.0;
};
using DryMaterial = MaterialValues;
using WetMaterial = MaterialValues;

/// The share of a material that takes up water, 0..1: rough dielectrics do, metals and smooth ones do not. From a
/// smoothness of 0.5 (none) to 0.1 (all), faded out over a mean specular of 0.4 to 0.6, smoothly. The talk writes the
/// last as a step 0.001 wide, which half cannot hold.
[[nodiscard]] double porosity(const std::array<double, 3>& specular, double smoothness);

/// The talk's ProcessWetSurfaces (S. Lagarde and L. Harduin, GDC Europe 2013): a fully porous albedo falls to a fifth,
/// smoothness goes two fifths of the way to 1, specular stays. `wetness` 0..1, of the diffuse and of the specular part.
[[nodiscard]] WetMaterial wet_material(const DryMaterial& dry, double wetness);
[[nodiscard]] WetMaterial wet_material(const DryMaterial& dry, double diffuse_wetness, double specular_wetness);

/// What is left of water `since_s` seconds after the rain, 0..1: 1 at 0 s, 0 from `dry_s` on, a logistic curve between
/// whose middle lies at half of `dry_s` for the diffuse part and at a quarter for the specular one.
[[nodiscard]] double diffuse_water_left(double since_s, double dry_s);
[[nodiscard]] double specular_water_left(double since_s, double dry_s);

}  // namespace halfframe::reference
