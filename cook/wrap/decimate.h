// Decimates a wrap by the edge collapses of the cluster builder, as far as it stays a wrap.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/wrap/source_tree.h"

#include <cstdint>
#include <optional>

namespace hearth::wrap
{

struct DecimationLimits
{
    double error_m =
        0; ///< distance of corners, and of middles of edges and triangles, from the wrap, at most
    /// Triangles to reach, at most, if need be farther from the wrap.
    uint64_t triangles = UINT64_MAX;
    double step_m = 0; ///< by which triangles that break a promise are first pushed away from the source
    double max_seconds = 0;
};

/// Decimate a wrap to about the fewest triangles with which it has no fault (findFault). It stays as it is if
/// none of the tries with fewer is without.
/// wrap     without a fault
/// returns  nullopt if it takes more than max_seconds of this thread's processor time
std::optional<Surface> decimateWrap(const Surface& wrap, const SourceTree& source,
                                    const DecimationLimits& limits);

} // namespace hearth::wrap
