// Decodes the clusters of a deformed mesh from the pages of a clusters part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/skinning/deformed_cluster.h"
#include "formats/pack/pack_view.h"

namespace hearth::skinning
{

/// Read all clusters of a mesh, in the order of the table.
/// joint_count  of the mesh's skin; 0 without one
/// errors: errors of PackView::decodePage; meaning_range, meaning_reference and meaning_geometry where
/// tables, joints or indices are out of range.
Result<std::vector<DeformedCluster>> readClusters(const formats::PackView& part, uint32_t mesh,
                                                  uint32_t joint_count);

} // namespace hearth::skinning
