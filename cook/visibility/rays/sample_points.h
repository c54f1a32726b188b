// Where the rays of a surface sample start.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/rays/surface_samples.h"

namespace hearth::visibility
{

/// Of one sample, in the world.
struct SamplePoint
{
    Float3 position; ///< metres
    Float3 normal;   ///< unit: of the triangle, on the side from which its corners run counter-clockwise
    /// Metres along the normal by which rays start above the surface, no more than arithmetic needs: the sum of the bounds
    /// of what rounding does to the position, to the triangle's corners in the world, to rays on their way into an
    /// instance's space, and to Embree's own test of the ray against the triangle.
    float lift;
};

/// Mirrored and skewed transforms keep the side that is in front, as in glTF.
///
/// positions, corners, samples  as surfaceSamples was given and has made them: in the space of the mesh
/// world_from_mesh              invertible; exactly the identity for what the rays meet as it is, without an instance
/// source  M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th edition, 6.8: bounds of rounding errors.
///         Differs: of Embree's arithmetic; one length along the normal for a box
std::vector<SamplePoint> samplePoints(std::span<const Float3> positions, std::span<const uint32_t> corners,
                                      std::span<const SurfaceSample> samples,
                                      const Affine3& world_from_mesh = {});

} // namespace hearth::visibility
