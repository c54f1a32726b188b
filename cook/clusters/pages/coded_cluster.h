// The vertices of a cluster as its page holds them: codes instead of floats, equal ones merged.
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

/// How the vertices of a mesh are coded: as coarse as Config allows and the values do.
uint32_t chooseLayout(const PreparedMesh& mesh, const Config& config);

/// Code a cluster, and fill in its record's box, cone and counts. Vertices whose codes are equal become one.
CodedCluster codeCluster(const PreparedMesh& mesh, const ClusterStore& store, const ClusterShape& shape,
                         uint32_t layout, formats::ClusterRecord& record);

} // namespace hearth::clusters
