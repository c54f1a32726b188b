// Gives meshes the UVs that baked light needs, where the source brings none.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/mesh/source_mesh.h"

namespace hearth::import
{

/// Make a UV set for the texels of receivers (cook/receivers/unwrap) in the first set that is free, unless
/// one of the mesh's own can be used: it lies in [0, 1] without overlaps.
/// Vertices at the borders of charts are doubled. Meshes that joints or morph targets deform stay as they
/// are, and so do those without a free set and those in too many loose pieces.
/// texel_size  metres of the mesh's space, above 0
void addReceiverUvs(mesh::SourceMesh& mesh, double texel_size);

} // namespace hearth::import
