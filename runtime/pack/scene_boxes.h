// Positions of vertices, and bounding boxes of a scene's instances and clusters, in a pose.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/pose_player.h"

#include <vector>

namespace hearth::pack
{

/// Box with its transform to world space.
struct TransformedBox
{
    Box3 box;
    Affine3 world_from_box;
};

/// Return the position in the world of a vertex of a deformed instance.
Double3 posedPosition(const formats::ClusterGeometry& geometry, uint32_t vertex, const PosedInstance& pose);

/// Return the range of all instances of a pack.
formats::Range allInstances(const formats::PackView& pack);

/// Return one box per instance of the range that has clusters: around its source, or for a deformed instance
/// around all its poses, relative to its anchor.
std::vector<TransformedBox> instanceBoxes(const formats::PackView& pack, const PosePlayer& player,
                                          formats::Range instances);

/// Return one box per cluster of the finest level of each instance: tighter for round shapes. For deformed
/// instances, around the posed vertices; for crowds, around all poses, relative to the main joint of the
/// cluster.
std::vector<TransformedBox> clusterBoxes(const formats::PackView& pack, const PosePlayer& player,
                                         formats::Range instances);

/// Bounds of instanceBoxes; empty if there are none.
Box3 instanceBounds(const formats::PackView& pack, const PosePlayer& player, formats::Range instances);

/// Bounds of all instances.
Box3 sceneBounds(const formats::PackView& pack, const PosePlayer& player);

/// Bounds of all instances at rest.
Box3 sceneBounds(const formats::PackView& pack);

} // namespace hearth::pack
