// What water does to the light of a surface, in double: a film of water over a base whose pores are full of it. This is
// the layered model that the talk's three lines stand for. Colours are handled one channel at a time.
//
//   dry, porous share      grains in air, many times scattered                       Lambert
//   dry, closed share      a body under its own surface (index 1.53)                 Fresnel in, Fresnel out
//   wet, porous share      the same grains in water, which send light more forward   Twomey, Bohren and Mergenthaler
//   1986
//                          so that it dives deeper and more of it is absorbed;
//                          above them a film that mirrors part of it back inside     Angstrom 1925, Lekner and Dorf
//                          1988
//   wet, closed share      the body under two surfaces, water's and its own
//
// Wetness is the share of the area that is soaked and covered. The film is flat, clear and thick against a wavelength;
// its edges and the light that creeps from wet to dry places are left out, and so are metals, whose index is complex.
#pragma once

namespace halfframe::reference {

inline constexpr double kWaterIndex = 1.33;  ///< of refraction, at 20 degrees C and 550 nm
inline constexpr double kStoneIndex = 1.53;  ///< of the base: quartz sand 1.54, sRGB 59 at normal incidence is 1.53

/// Fresnel reflectance 0..1 of unpolarised light that comes from index 1 and meets `index` (> 0; below 1 there is total
/// reflection). cosine 0..1 of the angle of incidence.
[[nodiscard]] double dielectric_reflectance(double index, double cosine);

/// The same for light that arrives diffusely: the mean over a hemisphere, weighted with the cosine.
[[nodiscard]] double diffuse_reflectance(double index);

/// Mean cosine of the angle by which a large clear sphere of that relative index turns light: refraction and reflection
/// without diffraction, which close neighbours undo. A. Ashkin, Biophysical Journal 61 (1992), eq. 1 and 2: the sum
/// over all inner reflections, averaged over both polarisations and the sphere's disk.
[[nodiscard]] double sphere_asymmetry(double index);

/// Share 0..1 of diffuse light that comes back from a layer without end of particles: H. C. van de Hulst, Multiple
/// Light Scattering (1980), (1 - s)(1 - 0.139 s) / (1 + 1.17 s), s = sqrt((1 - a) / (1 - a g)), within 0.005.
/// `scattered` a 0..1: what one particle does not absorb; `asymmetry` g below 1.
[[nodiscard]] double layer_albedo(double scattered, double asymmetry);
/// The `scattered` of that albedo (0..1), found by halving.
[[nodiscard]] double scattered_share(double albedo, double asymmetry);

/// Albedo of grains whose dry albedo is `albedo` (0..1), with water in place of the air between them.
[[nodiscard]] double soaked_albedo(double albedo);

/// A surface under water: two interfaces, light going to and fro between them, incoherently.
struct Stack {
    double reflected = 0.0;    ///< share that never reaches the body
    double transmitted = 0.0;  ///< share that does
};
/// Of water on the base; `cosine` is that in air.
[[nodiscard]] Stack water_on_stone(double cosine);

/// Share of directed light that comes back diffusely, over that of the dry surface: what wetting multiplies an albedo
/// with. albedo 0..0.89 (bi-hemispherical, as the talk defines it; above it a closed base absorbs less than nothing),
/// porosity 0..1: the porous share, wetness 0..1, cosine 0..1 of the light's angle.
[[nodiscard]] double wet_diffuse_factor(double albedo, double porosity, double wetness, double cosine);

/// The same for the part of it that leaves towards one view: what wetting multiplies the diffuse radiance with.
[[nodiscard]] double wet_radiance_factor(double albedo, double porosity, double wetness, double n_l, double n_v);

/// Share of light that a wholly wet surface mirrors, off the water and off the base below it.
[[nodiscard]] inline double film_reflectance(double cosine) { return water_on_stone(cosine).reflected; }

}  // namespace halfframe::reference
