// Computes the normal cone of a deformed cluster. It contains the triangles' normals in all poses.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/skinning/deformed_cluster.h"
#include "formats/records/mesh.h"

namespace hearth::skinning
{

/// Normal cone, encoded as in DeformedClusterRecord.
struct StoredCone
{
    uint16_t axis = 0;
    uint16_t cutoff = formats::kNoCone;
    float back = 0;
};

/// Compute the cone in the space of a joint.
/// main    joint for which all other joints of the cluster have bounds
/// middle  center of the cluster's box in the joint
StoredCone computeCone(uint32_t main, const DeformedCluster& cluster, const Deformation& deformation,
                       std::span<const MorphedVertex> vertices, Float3 middle);

} // namespace hearth::skinning
