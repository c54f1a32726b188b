// Work on the vertices of a SourceMesh, whatever format it came from.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

#include <span>
#include <vector>

namespace hearth::import
{

/// Make vertex i a copy of the old vertex old_from_new[i], with all attributes, influences and morph targets.
/// The indices are the caller's to change.
void gatherVertices(mesh::SourceMesh& mesh, std::span<const uint32_t> old_from_new);

/// One mesh from several, in their order. An attribute that only some have is filled with its default in the
/// others: white, UV (0, 0), a tangent across the normal, joint 0, no movement.
/// Every piece with vertices has normals, or none has.
mesh::SourceMesh mergedPieces(std::vector<mesh::SourceMesh> pieces);

/// Give vertices whose normal is zero the area-weighted average of their triangles.
void fillZeroNormals(mesh::SourceMesh& mesh);

/// A unit vector at right angles to the unit vector `normal`.
Float3 anyTangent(Float3 normal);

} // namespace hearth::import
