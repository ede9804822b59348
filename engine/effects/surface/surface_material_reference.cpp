// glTF's material extensions in double.
#include "engine/effects/surface/surface_material_reference.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace halfframe::reference {

double dielectric_specular(double ior, double color, double share) {
    const double normal = ior == 0.0 ? 1.0 : std::pow((ior - 1.0) / (ior + 1.0), 2.0);
    return std::fmin(normal * color, 1.0) * share;
}

double albedo_beside(double diffuse, const std::array<double, 3>& specular) {
    return diffuse - diffuse * *std::max_element(specular.begin(), specular.end());
}

double occlusion_share(double texel, double strength) { return texel * strength + (1.0 - strength); }

double srgb_from_linear(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

std::array<double, 2> transformed_uv(const std::array<double, 2>& uv, const std::array<double, 2>& offset,
                                     const std::array<double, 2>& scale, double rotation_rad) {
    // With v upwards a counter-clockwise turn is a product of complex numbers.
    const std::complex<double> upwards(uv[0] * scale[0], -uv[1] * scale[1]);
    const std::complex<double> turned = upwards * std::polar(1.0, rotation_rad);
    return {turned.real() + offset[0], -turned.imag() + offset[1]};
}

}  // namespace halfframe::reference
