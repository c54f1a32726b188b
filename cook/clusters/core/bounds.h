// Bounding boxes, spheres and normal cones that contain what they claim, after rounding to floats.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"
#include "formats/records/mesh.h"

#include <cstdint>
#include <span>

namespace hearth::clusters
{

/// The factor by which a group's sphere and error exceed what they contain, so that the runtime's float arithmetic
/// cannot see them inverted (design notes, RUNTIME 2.1).
inline constexpr double kMonotoneSlack = 1.0 + 1.0 / 262144.0;

/// `value`, at least 0, as a float that is not smaller; the largest finite float if it is beyond them.
float roundUp(double value);

/// A sphere around the points, at most a few per cent larger than the smallest.
/// source  J. Ritter, "An efficient bounding sphere", 1990, then steps towards the farthest point as in M. Badoiu,
///         K. L. Clarkson, "Smaller core-sets for balls", 2003
Sphere sphereOfPoints(std::span<const Float3> points);

/// A sphere around the spheres: their centers' sphere, or the one given as a start, whichever needs less radius.
Sphere sphereOfSpheres(std::span<const Sphere> spheres, const Sphere& start);

/// Make the radius, but for the slack, large enough for the points.
void growToHold(Sphere& sphere, std::span<const Float3> points);

/// Cone of the triangles' normals; its apex stands behind `middle`. The runtime may skip the triangles when the eye sees
/// the cone from behind: dot(normalize(apex - eye), axis) >= cutoff.
struct NormalCone
{
    uint32_t axis = 0; ///< formats::NormalCode<8>
    double cutoff = 1; ///< sine of the half-angle with a margin; 1: never skip
    double back = 0;   ///< apex = middle - back * axis
};

/// places  three for each triangle, finite
NormalCone coneOfTriangles(std::span<const Float3> places, Float3 middle);

/// The box and the normal cone of a cluster, as its record holds them.
///
/// points  its vertices, on the grid, at least one
/// places  three for each triangle
/// wide    its offsets need 32 bits for another reason than the size of its box
void setBounds(formats::ClusterRecord& record, double grid_step, std::span<const Float3> points,
               std::span<const Float3> places, bool wide);

} // namespace hearth::clusters
