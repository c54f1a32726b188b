// Evaluates the metallic-roughness material of glTF 2.0, appendix B, with energy compensation, its sky light,
// and the tone curve.
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
    Double3 emitted; ///< after exposure
    Double3 normal;
};

/// Directional albedos of both lobes, which add up to 1 for a white surface.
struct Albedo
{
    Double3 diffuse, specular;
};
/// Integrate the lobe of appendix B.3 numerically, scaled for several scatterings (E. Turquin, "Practical
/// multiple scattering compensation for microfacet models", 2019); the diffuse lobe gets what is left.
Albedo albedo(const Coating& coating, Double3 view);

/// BRDF: the lobe of appendix B.3 (GGX, height-correlated Smith, Schlick) scaled for several scatterings, and
/// Lambert's law with the diffuse albedo. Radiance per irradiance, cosine included.
/// `view` and `light` are unit and point away from the surface.
Double3 reflected(const Coating& coating, Double3 view, Double3 light);

/// Light that a surface under the open sky reflects, by lobe: both albedos times the means of the sky's
/// radiance over the lobes. Without the coating's occlusion.
struct SkyResponse
{
    Double3 diffuse, specular;
};
SkyResponse underSky(const Coating& coating, const SceneLighting& lighting, Double3 view);

/// Display-linear value of a radiance. J. Hejl and R. Burgess-Dawson, 2010; their curve includes a gamma of
/// 2.2, which is removed here.
double filmic(double radiance);

} // namespace hearth::reference
