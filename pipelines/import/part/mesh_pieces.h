// Operations on the vertices of a SourceMesh, independent of the source format.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

#include <span>
#include <vector>

namespace hearth::import
{

/// Make vertex i a copy of the old vertex old_from_new[i], with all attributes, influences and morph targets.
/// The caller updates the indices.
void gatherVertices(mesh::SourceMesh& mesh, std::span<const uint32_t> old_from_new);

/// Merge meshes into one, in their order. An attribute that only some pieces have is filled with its default
/// in the others: white, UV (0, 0), a tangent perpendicular to the normal, joint 0, no morph displacement.
/// Either every piece with vertices has normals, or none has.
mesh::SourceMesh mergePieces(std::vector<mesh::SourceMesh> pieces);

/// Set each zero normal to the area-weighted average of the normals of its triangles.
void fillZeroNormals(mesh::SourceMesh& mesh);

/// Return a unit vector perpendicular to the unit vector `normal`.
Float3 anyTangent(Float3 normal);

} // namespace hearth::import
