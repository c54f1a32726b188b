// Bounds a deformed cluster in the space of its main bone, over all poses.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/skinning/deformed_cluster.h"
#include "formats/records/deformation.h"

#include <optional>
#include <vector>

namespace hearth::skinning
{

/// Half the side of the box of a cluster without bounds: all its joints can be scaled to 0, so none has
/// bounds for the others. Nothing culls such a box, and single precision can still transform it to world
/// space.
inline constexpr float kUnbounded = 1e30f;

struct DeformedBounds
{
    formats::DeformedClusterRecord record; ///< without `joints`
    std::vector<uint32_t> joints;          ///< entries of chunk DJNT
};

/// Compute bounds of the clusters of one mesh. The main bone is the joint with the largest sum of weights,
/// unless another of the heaviest joints gives a smaller box; any joint of the skin if none of these gives a
/// box.
std::vector<DeformedBounds> computeClusterBounds(std::span<const DeformedCluster> clusters,
                                                 const Deformation& deformation);

} // namespace hearth::skinning
