// Generates the normals that a source leaves out.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

namespace hearth::import
{

/// Generate area-weighted smooth normals with a crease angle (vertices are split where
/// needed, all attributes, influences and morph targets with them; vertices that no triangle uses are left out).
void generateNormals(mesh::SourceMesh& mesh, float crease_angle_rad);

} // namespace hearth::import
