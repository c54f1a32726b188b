// The truth about the light that arrives at a surface: all of its bounces, by paths against the real geometry.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/tracer/shaded_scene.h"

namespace hearth::reference
{

/// Irradiance over pi at a point, of its smooth normal: no normal map.
struct SurfaceLight
{
    Double3 direct;   ///< of the lights
    Double3 indirect; ///< of all else: the sky, what shines, what is lit
};

/// The side of the surface that was seen.
Double3 litNormal(const ShadedPoint& point);

/// Of the scene's lights, each with its shadow.
Double3 directLight(const ShadedScene& scene, const ShadedPoint& point);

/// Deterministic: the same for the same arguments. Paths are diffuse and end when they are lost or after 32 bounces.
/// paths  at least 1
SurfaceLight traceSurfaceLight(const ShadedScene& scene, const ShadedPoint& point, uint32_t paths,
                               uint64_t seed);

} // namespace hearth::reference
