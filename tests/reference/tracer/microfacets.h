// Samples directions that a GGX surface reflects to a view.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/reference/double3.h"

namespace hearth::reference
{

/// Axes about a normal, which is z.
struct Frame
{
    Double3 x, y, z;
    explicit Frame(Double3 n)
        : x(normalize(cross(n, std::abs(n.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0}))),
          y(cross(n, x)),
          z(n)
    {
    }
    Double3 local(Double3 v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
    Double3 world(Double3 v) const { return x * v.x + y * v.y + z * v.z; }
};

/// Sample the visible normals of GGX (E. Heitz, "Sampling the GGX distribution of visible normals", 2018).
/// `view` is in the frame of the normal; (u, v) in [0, 1)^2.
Double3 visibleNormal(Double3 view, double alpha, double u, double v);

/// G2 / G1(view), height-correlated: weight of a direction from visibleNormal.
/// nl, nv  cosines to the normal, above 0
double maskingWeight(double nl, double nv, double alpha);

/// Density, over solid angle, of the directions that visible normals reflect a view to.
/// nh  cosine between the normal and the half vector
double visibleDensity(double nh, double nv, double alpha);

} // namespace hearth::reference
