// Moves a mesh into another space.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"
#include "pipelines/import/part/transform.h"

namespace hearth::import
{

/// Move positions, normals and tangents; triangles of a mirrored mesh turn over, so that they face the same side. False,
/// and nothing done, where the transform is flat or a position leaves the range that meshes may have (1e9).
bool bakeTransform(mesh::SourceMesh& mesh, const Transform& transform);

} // namespace hearth::import
