// Hausdorff distances by CGAL within a limit of time: of a sample where the whole takes longer.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/support/surfaces/certified_distance.h"

#include <optional>

namespace hearth::bench
{

struct LimitedDistance
{
    double distance = 0; ///< off by at most the error
    /// Each so many triangles, one was measured; 1: all.
    size_t stride = 1;
};

/// Return the largest distance of a point of `from` to `to`, off by at most `error`. Where that takes more
/// than `seconds` of processor, it is the distance of every tenth triangle, and so on, so that it is a lower
/// bound; nullopt if a single triangle takes as long. Forks: CGAL cannot be interrupted.
std::optional<LimitedDistance> measureDistance(const TriangleSurface& from, const TriangleSurface& to,
                                               double error, unsigned seconds);

} // namespace hearth::bench
