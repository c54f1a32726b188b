// Where a scene is: the boxes of what it draws, as they stand in a pose. Plain data, no Vulkan.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/pose_player.h"

#include <vector>

namespace hearth::gpu
{

/// A box and what carries it to the world.
struct PlacedBox
{
    Box3 box;
    Affine3 world_from_box;
};

/// All instances of a pack.
formats::Range allInstances(const formats::PackView& pack);

/// Of each instance of the range that has clusters: around its source, or where it is deformed, around all its poses from
/// where its anchor stands.
std::vector<PlacedBox> instanceBoxes(const formats::PackView& pack, const pack::PosePlayer& player,
                                     formats::Range instances);

/// Of each cluster of the finest level of each instance: closer to round things. Where it is deformed, around its vertices
/// in the pose; of crowds, around all its poses from where its main bone stands.
std::vector<PlacedBox> clusterBoxes(const formats::PackView& pack, const pack::PosePlayer& player,
                                    formats::Range instances);

/// Around instanceBoxes; empty where there are none.
Box3 instanceBounds(const formats::PackView& pack, const pack::PosePlayer& player, formats::Range instances);

/// The same of all instances.
Box3 sceneBounds(const formats::PackView& pack, const pack::PosePlayer& player);

/// The same at rest.
Box3 sceneBounds(const formats::PackView& pack);

} // namespace hearth::gpu
