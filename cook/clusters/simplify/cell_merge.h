// The last resort of simplification: positions that lie in one cell become one, whatever connects them.
// See cook/clusters/README.md, "Simplifying".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/simplify/simplify.h"

#include <cstddef>

namespace hearth::clusters
{

/// Merge positions by cells of a grid, the finest that leaves at most `target_triangles`, or as many as locked positions
/// force. Positions near a locked one go there. Sheets and shells may touch and close; no edge comes open: triangles go
/// only where two of their corners meet, or in pairs that run against each other.
/// J. Rossignac, P. Borrel, "Multi-resolution 3D approximations for rendering complex scenes", 1993
void mergeByCells(const GroupMesh& group, size_t target_triangles, Simplified& simplified);

} // namespace hearth::clusters
