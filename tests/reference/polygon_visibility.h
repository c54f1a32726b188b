// Visibility of the hemisphere at a point beside polygons, in closed form: the reference of baked visibility.
// Shares nothing with the cooker.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/double3.h"

#include <span>
#include <vector>

namespace hearth::reference
{

/// Corners of a planar convex polygon, in either order.
using Polygon = std::vector<Double3>;

/// Moments of the visible part of a hemisphere: the solid angle, in [0, 2 pi], and the integral of the
/// direction. dot(m1, normal) / pi is the ambient occlusion.
struct HemisphereMoments
{
    double m0 = 0;
    Double3 m1;
};

/// Return the moments of the hemisphere about `normal` (unit) without the polygons, which block from both
/// sides. Seen from the point, none may cover a part of another. The point may not lie on a polygon; parts
/// below the horizon count for nothing.
/// source  J. H. Lambert's vector irradiance of a polygon, as in J. Arvo, "Analytic methods for simulated
///         light transport", 1995, chapter 4; solid angle: A. Van Oosterom, J. Strackee, "The solid angle of
///         a plane triangle", 1983
HemisphereMoments visibleBesidePolygons(Double3 point, Double3 normal, std::span<const Polygon> polygons);

} // namespace hearth::reference
