// Bounds the distance of the vertices that a node moves from the node: the factor from the node's error to
// theirs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/box.h"
#include "formats/scene/animation.h"

#include <span>
#include <vector>

namespace hearth::animation_compression
{

/// Vertices that are fixed in a node's space: a mesh of the node, or the vertices that one joint of a skin
/// moves.
struct AttachedVertices
{
    uint32_t node = 0;
    Affine3d node_from_points; ///< for a joint: the inverse bind matrix
    animation_bounds::Box3d
        box; ///< metres, contains the points; for morphing meshes with all weights of the clips
};

/// Data of a scene that is common to all clips.
struct SceneReach
{
    std::vector<uint32_t> parents_first;
    /// by node: distance of the farthest vertex that the node itself carries, metres; below 0 if none
    std::vector<double> own;
    /// by node: longest side of the box around the vertices of it and its descendants, metres in the world's
    /// rest pose
    std::vector<double> size;
    double scene_size = 0;
};
SceneReach computeSceneReach(const formats::AnimationTables& tables,
                             std::span<const AttachedVertices> carried);

/// Reach of all nodes in one clip of the source, at all times. One entry for each node.
struct ClipReach
{
    std::vector<double> scale; ///< upper bound for the largest singular value of the node's transform
    /// distance of the farthest vertex of it or its descendants, in its space; below 0 if there are none
    std::vector<double> farthest;
};
ClipReach computeClipReach(const formats::AnimationTables& tables, const formats::AnimationRecord& animation,
                           const SceneReach& scene);

} // namespace hearth::animation_compression
