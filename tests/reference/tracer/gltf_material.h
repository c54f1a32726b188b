// Evaluates the metallic-roughness material of glTF 2.0, appendix B, with energy compensation, its layers by
// KHR_materials_ior, _specular, _sheen and _clearcoat, its sky light, and the tone curve.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/tracer/scene_lighting.h"

namespace hearth::reference
{

/// Material values at a point.
struct Coating
{
    Double3 base;
    double metallic, roughness;
    double occlusion;
    Double3 emitted; ///< after exposure, without the clear coat on top
    Double3 normal;
    /// Fresnel term of the dielectric part: at normal incidence, and at grazing angles.
    Double3 dielectric_f0{0.04, 0.04, 0.04};
    double dielectric_f90 = 1;
    Double3 sheen{}; ///< colour
    double sheen_roughness = 1;
    double clearcoat = 0, clearcoat_roughness = 1;
    Double3 clearcoat_normal{};
};

/// Directional albedos of the lobes, each under the layers above it, which add up to 1 for a white surface.
struct Albedo
{
    Double3 diffuse, specular, sheen;
    double clearcoat = 0;
};
/// Integrate the lobe of appendix B.3 numerically, scaled for several scatterings (E. Turquin, "Practical
/// multiple scattering compensation for microfacet models", 2019); the diffuse lobe gets what is left.
Albedo albedo(const Coating& coating, Double3 view);

/// BRDF: the lobe of appendix B.3 (GGX, height-correlated Smith, Schlick) scaled for several scatterings, and
/// Lambert's law with the diffuse albedo. Radiance per irradiance, cosine included.
/// `view` and `light` are unit and point away from the surface.
Double3 reflected(const Coating& coating, Double3 view, Double3 light);

/// Return the light that a surface emits to a view, which a clear coat dims.
Double3 emitted(const Coating& coating, Double3 view);

/// Return distribution times visibility of white sheen: its share of light, without the cosine. The lobe's
/// albedo is at most 1.
double sheenLobe(double roughness, Double3 normal, Double3 view, Double3 light);

/// Light that a surface under the open sky reflects, by lobe: the albedos times the means of the sky's
/// radiance over the lobes. Without the coating's occlusion.
struct SkyResponse
{
    Double3 diffuse, specular, sheen, clearcoat;
};
SkyResponse underSky(const Coating& coating, const SceneLighting& lighting, Double3 view);

/// Display-linear value of a radiance. J. Hejl and R. Burgess-Dawson, 2010; their curve includes a gamma of
/// 2.2, which is removed here.
double filmic(double radiance);
/// Radiance that the tone curve shows as a value, which is limited to 0.999.
double invertFilmic(double shown);

} // namespace hearth::reference
