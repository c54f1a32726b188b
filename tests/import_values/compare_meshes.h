// Compares the corners of every triangle of a mesh with those of its import part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"
#include "tests/import_values/comparison.h"
#include "tests/import_values/source_primitives.h"

namespace hearth::test
{

/// Compare corner by corner, whatever vertices share them. Triangles come in the order of the pieces.
/// is_skinned  a node draws the mesh of the part by a skin; else it has no joints
void compareMesh(const std::vector<SourcePiece>& pieces, const mesh::SourceMesh& part, bool is_skinned,
                 Comparison& comparison);

} // namespace hearth::test
