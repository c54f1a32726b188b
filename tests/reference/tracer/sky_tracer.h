// Ground truth of ambient occlusion: the part of the sky's light that reaches a point, by ray tracing of the
// real geometry.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/tracer/shaded_scene.h"

// Rays measure the part of the sky's light that arrives, for each channel and for each lobe by the
// material's own distribution,
//     diffuse    irradiance(n) * int V L cos / int L cos
//     specular   mean(lobe)    * int V L D G2 / int L D G2,
// and for sheen and clear coat as for specular,
// with L the sky's radiance. The first factors are integrals without rays, so that an open surface has no
// noise.

namespace hearth::reference
{

struct SkyTracing
{
    uint32_t rays = 0;    ///< sky rays of each sample for each lobe; 0: no occlusion
    uint32_t bounces = 0; ///< diffuse bounces after the hit; 0: hit surfaces are black, as in the runtime
    bool shadows = false; ///< of the lights, on surfaces that bounced rays hit
};

/// Part of the sky's light that reaches a point.
struct SkyAccess
{
    Double3 diffuse{1, 1, 1}, specular{1, 1, 1}; ///< visible light over all light, from 0
    Double3 sheen{1, 1, 1}, clearcoat{1, 1, 1};
    Double3 irradiance, reflection; ///< visible light: over pi; reflected, with a Fresnel term of 1
    Double3 bounced_irradiance, bounced_reflection; ///< the same for light from surfaces that occlude the sky
    Double3 bounced_sheen, bounced_clearcoat;
};

/// Trace the sky at a point. Deterministic: same arguments, same result. Another seed gives other random
/// numbers.
SkyAccess traceSky(const ShadedScene& scene, const ShadedPoint& point, Double3 view,
                   const SkyTracing& tracing, uint64_t seed);

/// Light of the sky and of bounces that the surface reflects. The occlusion texture stands for detail that
/// the mesh lacks: the smaller of texture and traced visibility counts.
Double3 tracedSky(const ShadedScene& scene, const ShadedPoint& point, Double3 view, const SkyTracing& tracing,
                  uint64_t seed);

/// Light of the light sources that the surface reflects to the eye.
Double3 underLights(const ShadedScene& scene, const ShadedPoint& point, Double3 view, bool shadows);

} // namespace hearth::reference
