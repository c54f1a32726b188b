// The normal cone of a deformed cluster: it holds the triangles' normals in all poses.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/skinning/deformed_cluster.h"
#include "formats/records/mesh.h"

namespace hearth::skinning
{

/// As DeformedClusterRecord has it.
struct StoredCone
{
    uint16_t axis = 0;
    uint16_t cutoff = formats::kNoCone;
    float back = 0;
};

/// main    all that moves the cluster has bounds as this joint sees it
/// middle  of the cluster's box in the joint
StoredCone coneIn(uint32_t main, const DeformedCluster& cluster, const Deformation& deformation,
                  std::span<const MorphedVertex> vertices, Float3 middle);

} // namespace hearth::skinning
