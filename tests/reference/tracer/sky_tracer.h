// Ground truth of ambient occlusion: the part of the sky's light that reaches a point, by ray tracing of the
// real geometry.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/tracer/shaded_scene.h"

// Quantity that is compared with the runtime. The runtime's sky is not one radiance but three prefiltered
// forms of one gradient (background, reflection by roughness, irradiance), and its specular albedo is a fit.
// A tracer that integrated one of them would differ from the runtime by these approximations even without
// occlusion, and so measure them as well. The rays here therefore measure only the visibility, for each
// channel and for both lobes by the material's own distribution,
//     diffuse    irradiance(n)         * int V L cos / int L cos
//     specular   albedo(r) sky(R, r)   * int V L D G2 / int L D G2,
// with L the gradient whose integral is the runtime's irradiance (to 0.3 %, from straight below 2 %). Without
// occlusion both equal the runtime's values to the last bit: the two images differ by occlusion alone.
// `integrate` gives the plain integrals instead.

namespace hearth::reference
{

struct SkyTracing
{
    uint32_t rays = 0;      ///< sky rays of each sample for each of both lobes; 0: no occlusion
    uint32_t bounces = 0;   ///< diffuse bounces after the hit; 0: hit surfaces are black, as in the runtime
    bool integrate = false; ///< the sky's radiance itself instead of the runtime's prefiltered forms
    bool shadows = false;   ///< of the lights, on surfaces that bounced rays hit
};

/// Roughness at which the gradient stands for one sky: its irradiance is then the runtime's.
inline constexpr double kSkyRoughness = 0.2;

/// Part of the sky's light that reaches a point.
struct SkyAccess
{
    Double3 diffuse{1, 1, 1}, specular{1, 1, 1}; ///< visible light over all light, from 0
    Double3 irradiance, reflection; ///< visible light: over pi; reflected, with a Fresnel term of 1
    Double3 bounced_irradiance, bounced_reflection; ///< the same for light from surfaces that occlude the sky
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
