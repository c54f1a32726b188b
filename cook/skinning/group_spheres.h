// Bounding spheres of the groups of a deformed mesh, in the space of one joint: its anchor.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/skinning/deformed_cluster.h"
#include "formats/records/mesh.h"

namespace hearth::skinning
{

/// Hierarchy of a mesh in the clusters part; first_* are the indices of its first group and cluster.
struct MeshHierarchy
{
    std::span<const formats::GroupRecord> groups;
    std::span<const formats::ClusterRecord> clusters;
    uint32_t first_group = 0;
    uint32_t first_cluster = 0;
};

/// Bounds of a mesh in the space of its anchor joint.
struct AnchoredBounds
{
    uint32_t anchor = 0;
    Box3 box;                    ///< of the whole mesh
    std::vector<Sphere> spheres; ///< one for each group
};

/// Compute the spheres. A sphere contains its group's clusters in all poses, and the spheres of the groups
/// that these clusters were simplified from. Groups of a set share one sphere. The anchor is the candidate
/// joint with the smallest bounds.
///
/// clusters  one for each cluster of the hierarchy
/// reach     for each joint, as in SkinMotion; empty without a skin
AnchoredBounds computeAnchoredBounds(const MeshHierarchy& hierarchy,
                                     std::span<const DeformedCluster> clusters,
                                     const Deformation& deformation,
                                     std::span<const animation_bounds::Box3d> reach);

} // namespace hearth::skinning
