// How far from each node the vertices can be that it moves: what an error of the node comes to at them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/box.h"
#include "formats/scene/animation.h"

#include <span>
#include <vector>

namespace hearth::clips
{

/// Vertices that stand still in a node's space: a mesh of the node, or what one joint moves of a skinned one.
struct Carried
{
    uint32_t node = 0;
    Affine3d node_from_points; ///< of a joint: the inverse bind matrix
    motion::Box3d box;         ///< metres, holds the points; of morphing meshes with all weights of the clips
};

/// What holds for all clips.
struct SceneReach
{
    std::vector<uint32_t> parents_first;
    std::vector<double>
        own; ///< of each node: the farthest vertex that it carries itself, metres; below 0 if none
    std::vector<double>
        size; ///< longest side of the box of all that hangs on a node, metres in the world's rest pose
    double scene_size = 0;
};
SceneReach sceneReach(const formats::MotionTables& tables, std::span<const Carried> carried);

/// What holds for one clip of the source, at all times. One for each node.
struct ClipReach
{
    std::vector<double> scale;    ///< at least the largest singular value of the node's transform
    std::vector<double> farthest; ///< vertices that hang on it, in its space; below 0 if there are none
};
ClipReach clipReach(const formats::MotionTables& tables, const formats::AnimationRecord& animation,
                    const SceneReach& scene);

} // namespace hearth::clips
