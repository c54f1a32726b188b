// Transforms a mesh into another space.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"
#include "pipelines/import/part/transform.h"

namespace hearth::import
{

/// Transform positions, normals and tangents. Reverse the winding of the triangles where the transform
/// mirrors, so that they face the same side. Return false and change nothing if the transform is singular or
/// a position leaves the range allowed for meshes (1e9).
bool bakeTransform(mesh::SourceMesh& mesh, const Transform& transform);

} // namespace hearth::import
