// Turns the triangles of a surface so that neighbours agree, and shells face outwards.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/proxy/surface/surface.h"

#include <cstdint>

namespace hearth::proxy
{

struct OrientationStatistics
{
    uint32_t shells = 0;            ///< pieces that edges of two triangles connect
    uint32_t flipped_shells = 0;    ///< shells that were turned as a whole, or for the most part
    uint32_t flipped_triangles = 0; ///< triangles that were turned, in all shells
    uint32_t twisted_edges = 0;     ///< edges of shells that have no two sides, as a Moebius strip
};

/// Turn triangles so that the two at an edge pass it in opposite directions, wherever their shell has two
/// sides. Shells that are closed, and open ones whose triangles did not agree, face the side from which
/// more rays leave the mesh; where rays do not tell, and for all other shells, the greater part of the
/// area stays as it was. Deterministic on processors of one class.
OrientationStatistics orientShells(Surface& surface);

} // namespace hearth::proxy
