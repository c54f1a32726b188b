// Encodes the vertices of a cluster for its page: codes instead of floats, equal ones merged.
// See cook/clusters/README.md, "Vertices".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/core/cluster.h"
#include "cook/clusters/core/hierarchy.h"
#include "cook/pages/page_encode.h"

#include <span>

namespace hearth::clusters
{

using pages::CodedCluster;

/// Choose the coding of a mesh's vertices: as coarse as Config allows and the values permit.
uint32_t chooseLayout(const PreparedMesh& mesh, const Config& config);

/// Encode a cluster, and set its record's box, cone and counts. Vertices with equal codes are merged.
CodedCluster codeCluster(const PreparedMesh& mesh, const ClusterStore& store, const ClusterShape& shape,
                         uint32_t layout, formats::ClusterRecord& record);

} // namespace hearth::clusters
