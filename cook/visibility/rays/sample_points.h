// Computes the ray origins of surface samples.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/rays/surface_samples.h"

namespace hearth::visibility
{

/// Surface sample in the world.
struct SamplePoint
{
    Float3 position; ///< metres
    Float3 normal;   ///< unit, of the triangle: on the side from which its corners run counter-clockwise
    /// Offset of ray origins from the surface along the normal, in metres. No more than arithmetic needs: the
    /// sum of the bounds of rounding errors in the position, in the triangle's corners in the world, in the
    /// transform of rays into an instance's space, and in Embree's own test of the ray against the triangle.
    float lift;
};

/// Transform samples to the world and compute their lift. Mirrored and skewed transforms keep the front side,
/// as in glTF.
///
/// positions, corners, samples  input and result of surfaceSamples, in the space of the mesh
/// world_from_mesh              invertible; exactly the identity if rays hit the mesh without an instance
/// source  M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th edition, 6.8: bounds of
///         rounding errors.
///         Differs: bounds for Embree's arithmetic; one length along the normal instead of a box
std::vector<SamplePoint> samplePoints(std::span<const Float3> positions, std::span<const uint32_t> corners,
                                      std::span<const SurfaceSample> samples,
                                      const Affine3& world_from_mesh = {});

} // namespace hearth::visibility
