// Last resort of simplification: merges positions by grid cells, whatever connects them (vertex clustering).
// See cook/clusters/README.md, "Simplifying".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/simplify/simplify.h"

#include <cstddef>

namespace hearth::clusters
{

/// Merge positions by cells of the finest grid that leaves at most `target_triangles`, or as many as locked
/// positions force. Positions near a locked one move to it. Sheets and shells may touch and close, but no
/// edge opens: triangles are removed only if two of their corners meet, or in pairs of opposite orientation.
/// J. Rossignac, P. Borrel, "Multi-resolution 3D approximations for rendering complex scenes", 1993
void mergeByCells(const GroupMesh& group, size_t target_triangles, SimplifiedGroup& simplified);

} // namespace hearth::clusters
