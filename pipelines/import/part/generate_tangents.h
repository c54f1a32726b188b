// Generates the tangents that a source leaves out.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

#include <cstdint>

namespace hearth::import
{

/// Generate tangents from UV set `uv_set` (v runs down the image) for a mesh that has normals (asserted).
/// Vertices are split where the UVs are mirrored.
void generateTangents(mesh::SourceMesh& mesh, uint32_t uv_set);

} // namespace hearth::import
