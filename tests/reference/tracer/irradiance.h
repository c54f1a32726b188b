// Ground truth of global illumination: the light that arrives at a surface after all bounces, by path tracing
// of the real geometry.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/tracer/shaded_scene.h"

namespace hearth::reference
{

/// Irradiance over pi at a point, for its smooth normal without normal map.
struct SurfaceLight
{
    Double3 direct;   ///< from the lights
    Double3 indirect; ///< from all else: sky, emissive and lit surfaces
};

/// Normal on the visible side of the surface.
Double3 litNormal(const ShadedPoint& point);

/// Direct light of the scene's lights, each with its shadow.
Double3 directLight(const ShadedScene& scene, const ShadedPoint& point);

/// Trace the light at a point. Deterministic: same arguments, same result. Paths are diffuse and end when
/// they are absorbed or after 32 bounces.
/// paths  at least 1
SurfaceLight traceSurfaceLight(const ShadedScene& scene, const ShadedPoint& point, uint32_t paths,
                               uint64_t seed);

} // namespace hearth::reference
