// Compares the boundary that cook/topology finds with OpenMesh's.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

namespace hearth::test
{

/// Compare boundary loops, by edges and lengths, where the mesh has no complex edge; else count these.
/// OpenMesh walks along the loops of the surface that cook/topology judges.
void expectBoundaryOfOpenMesh(const mesh::SourceMesh& mesh);

} // namespace hearth::test
