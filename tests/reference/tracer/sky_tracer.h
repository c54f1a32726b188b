// The truth about occlusion: how much of the sky's light reaches a point, by rays against the real geometry.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/tracer/shaded_scene.h"

// What is compared with the runtime. Its sky is not one radiance but three prefiltered forms of one gradient (background,
// mirror image by roughness, irradiance), and its specular albedo is a fit. A tracer that integrated one of them would differ
// from the runtime by these approximations where nothing is occluded at all, and so measure them as well. Here rays therefore
// measure what visibility takes away, channel by channel and for both lobes by the material's own distribution,
//     diffuse    irradiance(n)         * int V L cos / int L cos
//     specular   albedo(r) sky(R, r)   * int V L D G2 / int L D G2,
// with L the gradient whose integral is the runtime's irradiance (to 0.3 %, from straight below 2 %). In the open both are the runtime's to the last
// bit: all that differs between the two pictures is occlusion. `integrate` gives the plain integrals for who wants those.

namespace hearth::reference
{

struct SkyTracing
{
    uint32_t rays = 0;      ///< to the sky, for each sample and each of both lobes; 0: the sky is everywhere
    uint32_t bounces = 0;   ///< diffuse ones that follow; 0: what is hit is black, as in the runtime
    bool integrate = false; ///< the sky's radiance itself, in place of the runtime's forms of it
    bool shadows = false;   ///< of suns and spots, on what bounces show
};

/// The blur at which the gradient is taken for one sky: its irradiance is then the runtime's.
inline constexpr double kSkyRoughness = 0.2;

/// What of a point's sky reaches it.
struct SkyAccess
{
    Double3 diffuse{1, 1, 1}, specular{1, 1, 1};    ///< visible over all, from 0
    Double3 irradiance, reflection;                 ///< visible: over pi; reflected, times Fresnel's 1
    Double3 bounced_irradiance, bounced_reflection; ///< from what hides the sky, alike
};

/// Deterministic: the same for the same arguments. seed: other numbers for another.
SkyAccess traceSky(const ShadedScene& scene, const ShadedPoint& point, Double3 view,
                   const SkyTracing& tracing, uint64_t seed);

/// What the surface sends back of the sky, and of what bounces. The occlusion texture stands for form that the mesh lacks: the
/// smaller of the two counts.
Double3 tracedSky(const ShadedScene& scene, const ShadedPoint& point, Double3 view, const SkyTracing& tracing,
                  uint64_t seed);

/// What the lights send to the eye. shadows: of suns and spots.
Double3 underLights(const ShadedScene& scene, const ShadedPoint& point, Double3 view, bool shadows);

} // namespace hearth::reference
