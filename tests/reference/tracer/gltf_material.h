// The metallic-roughness material of glTF 2.0, appendix B, its light from the sky, and the tone curve.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/tracer/scene_lighting.h"

namespace hearth::reference
{

/// The material's values at a point.
struct Coating
{
    Double3 base;
    double metallic, roughness;
    double occlusion;
    Double3 emitted;
    Double3 normal;
};

/// Appendix B.3: GGX, height-correlated Smith, Schlick; radiance per irradiance, cosine included.
/// `view` and `light` are unit and point away from the surface.
Double3 reflected(const Coating& coating, Double3 view, Double3 light);

/// What a surface sends back of constant light, by lobe: B. Karis' fit of the specular albedo, "Physically based shading
/// on mobile", 2014.
struct SkyAlbedo
{
    Double3 diffuse, specular;
};
SkyAlbedo skyAlbedo(const Coating& coating, Double3 view);

/// What a surface under the open sky sends back, by lobe: those with the sky's irradiance and mirror image. The
/// coating's occlusion is not in it.
struct SkyResponse
{
    Double3 diffuse, specular;
};
SkyResponse underSky(const Coating& coating, const SceneLighting& lighting, Double3 view);

/// Display-linear value of a radiance. J. Hejl and R. Burgess-Dawson, 2010; their curve is meant for a 2.2 gamma
/// display, which is taken out again.
double filmic(double radiance);

} // namespace hearth::reference
