// Spheres of the groups of a deformed mesh, in one joint: its anchor.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/skinning/deformed_cluster.h"
#include "formats/records/mesh.h"

namespace hearth::skinning
{

/// A mesh's hierarchy, as the clusters part has it; first_* are the numbers of the first group and cluster.
struct MeshHierarchy
{
    std::span<const formats::GroupRecord> groups;
    std::span<const formats::ClusterRecord> clusters;
    uint32_t first_group = 0;
    uint32_t first_cluster = 0;
};

struct AnchoredBounds
{
    uint32_t anchor = 0;
    Box3 box;                    ///< of the whole mesh
    std::vector<Sphere> spheres; ///< one for each group
};

/// The spheres contain their groups' clusters in all poses, and the spheres of the groups that those were made from; the
/// groups of a set share one. Of the joints that could be the anchor, it is the one with the smallest bounds.
///
/// clusters  one for each of the hierarchy's
/// reach     of each joint, as SkinMotion has it; empty without a skin
AnchoredBounds anchoredBounds(const MeshHierarchy& hierarchy, std::span<const DeformedCluster> clusters,
                              const Deformation& deformation, std::span<const motion::Box3d> reach);

} // namespace hearth::skinning
