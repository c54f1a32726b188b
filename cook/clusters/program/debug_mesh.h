// Writes one level of a hierarchy as a mesh file for viewers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/hierarchy.h"
#include "formats/base/result.h"

#include <cstdint>
#include <string>

namespace hearth::clusters
{

/// True if `path` ends in a format of writeDebugMesh: .ply or .obj, in lower or upper case.
bool isDebugMeshPath(const std::string& path);

/// Write the clusters of a level, in the order of the table, atomically. PLY: each cluster has separate
/// vertices, coloured by a hash of its number in the mesh. OBJ: an object for the level and a group for each
/// cluster, named after its number and that of its group.
///
/// path    ends in .ply or .obj (asserted)
/// level   errors: usage if the hierarchy has no such level; cannot_write
Status writeDebugMesh(const Hierarchy& hierarchy, uint32_t level, const std::string& path);

} // namespace hearth::clusters
