// Evaluates the metallic-roughness material of glTF 2.0, appendix B, its sky light, and the tone curve.
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
    Double3 emitted;
    Double3 normal;
};

/// BRDF of appendix B.3: GGX, height-correlated Smith, Schlick. Radiance per irradiance, cosine included.
/// `view` and `light` are unit and point away from the surface.
Double3 reflected(const Coating& coating, Double3 view, Double3 light);

/// Reflectance under constant light, by lobe: B. Karis' fit of the specular albedo, "Physically based shading
/// on mobile", 2014.
struct SkyAlbedo
{
    Double3 diffuse, specular;
};
SkyAlbedo skyAlbedo(const Coating& coating, Double3 view);

/// Light that a surface under the open sky reflects, by lobe, from the sky's irradiance and its reflection.
/// Without the coating's occlusion.
struct SkyResponse
{
    Double3 diffuse, specular;
};
SkyResponse underSky(const Coating& coating, const SceneLighting& lighting, Double3 view);

/// Display-linear value of a radiance. J. Hejl and R. Burgess-Dawson, 2010; their curve includes a gamma of
/// 2.2, which is removed here.
double filmic(double radiance);

} // namespace hearth::reference
