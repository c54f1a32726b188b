// Pairs the half-edges of a triangulated surface with their opposites.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/index_types.h"

#include <cstddef>

namespace hearth::clusters
{

/// Return the opposite half-edge of each half-edge: the one that runs the other way between the same
/// positions. kInvalid at a border, and where more than two half-edges lie between two positions.
///
/// positions  below `position_count`
IdVector<HalfEdgeId, HalfEdgeId> findOppositeHalfEdges(CornerSpan<const PositionId> positions,
                                                       size_t position_count);

} // namespace hearth::clusters
