// The vertices of a cluster as its page holds them: codes instead of floats, equal ones merged.
// See README.md, "Vertices".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/cluster.h"
#include "cook/clusters/hierarchy.h"

#include <span>
#include <vector>

namespace hearth::clusters
{

/// Geometry of a cluster, decoded: what formats/mesh.h says of a page, one cluster at its page_word.
struct CodedCluster
{
    std::vector<uint32_t> words;  ///< UV bases, then vertices
    std::vector<uint8_t> indices; ///< three for each triangle
    std::vector<uint32_t> morphs; ///< the morph section; empty in a mesh without targets
};

/// How the vertices of a mesh are coded: as coarse as Config allows and the values do.
uint32_t chooseLayout(const PreparedMesh& mesh, const Config& config);

/// Code a cluster, and fill in its record's box, cone and counts. Vertices whose codes are equal become one.
CodedCluster codeCluster(const PreparedMesh& mesh, const ClusterStore& store, const ClusterShape& shape,
                         uint32_t layout, formats::ClusterRecord& record);

} // namespace hearth::clusters
