// Writes one level of a hierarchy as a file that any mesh viewer opens.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"
#include "formats/base/result.h"

#include <cstdint>
#include <string>

namespace hearth::clusters
{

/// Whether `path` ends as one of the formats of writeDebugMesh: .ply or .obj, in small or capital letters.
bool isDebugMeshPath(const std::string& path);

/// Write the clusters of a level, in the order of the table, whole or not at all. PLY: each cluster has vertices of its
/// own, coloured by a hash of its number in the mesh. OBJ: an object for the level and a group for each cluster, named
/// after its number and that of the group it is simplified in.
///
/// path    ends in .ply or .obj (asserted)
/// level   errors: usage where the hierarchy has no such level; cannot_write
Status writeDebugMesh(const Hierarchy& hierarchy, uint32_t level, const std::string& path);

} // namespace hearth::clusters
