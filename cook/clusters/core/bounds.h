// Bounding boxes, spheres and normal cones; conservative after rounding to floats.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"
#include "formats/base/rounding.h"
#include "formats/records/mesh.h"

#include <cstdint>
#include <span>

namespace hearth::clusters
{

/// Factor by which a group's sphere and error exceed their contents, so that float arithmetic in the runtime
/// cannot see a parent below its child.
inline constexpr double kMonotoneSlack = 1.0 + 1.0 / 262144.0;

/// Compute a bounding sphere of the points, at most a few per cent larger than the smallest.
/// source  J. Ritter, "An efficient bounding sphere", 1990, then steps towards the farthest point as in M.
///         Badoiu, K. L. Clarkson, "Smaller core-sets for balls", 2003
Sphere sphereOfPoints(std::span<const Float3> points);

/// Compute a bounding sphere of the spheres: around their centers' sphere or around `start`, whichever needs
/// less radius.
Sphere sphereOfSpheres(std::span<const Sphere> spheres, const Sphere& start);

/// Enlarge the radius, slack included, to contain the points.
void growToContain(Sphere& sphere, std::span<const Float3> points);

/// Normal cone of triangles; its apex lies behind `middle`. The runtime may cull the triangles when the eye
/// sees the cone from behind: dot(normalize(apex - eye), axis) >= cutoff.
struct NormalCone
{
    uint32_t axis = 0; ///< formats::NormalCode<8>
    double cutoff = 1; ///< sine of the half-angle with a margin; 1: never skip
    double back = 0;   ///< apex = middle - back * axis
};

/// corners  positions, three for each triangle, finite
NormalCone computeNormalCone(std::span<const Float3> corners, Float3 middle);

/// Set the box and the normal cone of a cluster's record.
///
/// points  positions of its vertices, on the grid, at least one
/// corners  positions, three for each triangle
/// wide    its offsets need 32 bits for a reason other than the size of its box
void setBounds(formats::ClusterRecord& record, double grid_step, std::span<const Float3> points,
               std::span<const Float3> corners, bool wide);

} // namespace hearth::clusters
