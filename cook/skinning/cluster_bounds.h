// Where a deformed cluster can be in all poses, as its main bone sees it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/skinning/deformed_cluster.h"
#include "formats/records/deformation.h"

#include <optional>
#include <vector>

namespace hearth::skinning
{

/// Half the side of the box of what has no bounds: where no joint sees all that moves a cluster, because all can be
/// scaled to 0. Nothing culls such a box, and single precision can still carry it into the world.
inline constexpr float kUnbounded = 1e30f;

struct DeformedBounds
{
    formats::DeformedClusterRecord record; ///< but for `joints`
    std::vector<uint32_t> joints;          ///< that move a vertex, the main bone first; none without a skin
};

/// Bounds of the clusters of one mesh. The main bone is the joint with the largest sum of weights, unless another of the
/// heaviest joints gives a smaller box; any joint of the skin where none of those gives one.
std::vector<DeformedBounds> boundsOf(std::span<const DeformedCluster> clusters,
                                     const Deformation& deformation);

/// The box with this joint as the main bone, before it is rounded; nothing where it has no bounds.
std::optional<motion::Box3d> boxIn(uint32_t main, const DeformedCluster& cluster,
                                   const Deformation& deformation, std::span<const MorphedVertex> vertices);

} // namespace hearth::skinning
