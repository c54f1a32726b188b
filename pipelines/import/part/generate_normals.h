// Generates the normals that a source leaves out.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

namespace hearth::import
{

/// Generate area-weighted smooth normals with a crease angle. Vertices are split where needed, with all
/// attributes, influences and morph targets; vertices that no triangle uses are removed.
void generateNormals(mesh::SourceMesh& mesh, float crease_angle_rad);

} // namespace hearth::import
