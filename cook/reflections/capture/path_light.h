// Light that reaches a point from a direction, by paths: emission, sky, lamps with their shadows, and
// diffuse bounces. Reflections count as diffuse light, as for bricks.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/reflections/capture/surfaces.h"
#include "formats/scene/radiance_transfer.h"
#include "formats/scene/scene_lighting.h"

namespace hearth::reflections
{

/// Paths that go on from a point which a ray from the probe meets.
inline constexpr uint32_t kPathsOfHit = 8;

/// Light that a surface sends back, exposed: its radiance is shown + albedo * bounced.
struct LeavingLight
{
    Float3 shown; ///< radiance: emission, and light of lamps and shining surfaces without a bounce before
    Float3 albedo;
    Float3 bounced; ///< arriving irradiance over pi of all else, with the noise of few paths
};

/// Light of a scene. Use from many threads; the surfaces must outlive it.
class PathLight
{
public:
    PathLight(const Surfaces& surfaces, const shared::SceneLighting& lighting);

    /// Return the light that a surface sends back along a ray.
    /// footprint  metres of the surface that the ray stands for
    /// seed       of the ray
    LeavingLight leaving(const SurfaceHit& hit, float footprint, uint64_t seed) const;

    /// Return the harmonics (shared::evaluateHarmonics) of the light that lamps but suns send to a
    /// position without a bounce, as radiance from their directions: its luminance, exposed.
    std::array<float, formats::kLightHarmonics> lampHarmonics(Float3 position) const;

private:
    Float3 arriving(SurfaceHit from, uint32_t path, uint64_t seed) const;
    Float3 direct(const receivers::DirectLight& light, const SurfaceHit& hit, uint64_t seed) const;

    const Surfaces& surfaces_;
    shared::SceneLighting lighting_;
    receivers::BakeScene lights_;  ///< lamps, and one mesh light of all triangles that shine
    receivers::DirectLight first_; ///< at what the probe sees
    receivers::DirectLight later_; ///< at later bounces: one ray for all triangles
};

} // namespace hearth::reflections
