// Hausdorff distances by CGAL, to compare certified_distance.h with.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/surfaces/certified_distance.h"

namespace hearth
{

/// Return the largest distance of a point of `from` to `to`, off by at most `error`. Triangles without area
/// are left out of both: 0 if `from` has no others, while `to` must have some. Takes minutes where `error` is
/// far below the size of triangles.
double cgalDistance(const TriangleSurface& from, const TriangleSurface& to, double error);

} // namespace hearth
