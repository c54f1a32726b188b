// Where a node can be in its parent: over all clips at all times, their blends, and the rest pose.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/matrix_set.h"
#include "cook/animation_bounds/rotation_set.h"

#include <optional>
#include <vector>

namespace hearth::motion
{

/// What a node's translation, rotation and scale can be, each by itself. They hold the convex hull (of rotations: the
/// cone of their quaternions) of all keys and splines, so any blend of any number of poses.
struct NodeMotion
{
    Box3d translations;
    RotationSet rotations;
    Box3d scales;
    std::optional<Affine3d> fixed; ///< a node with a matrix alone

    /// Whether any scale is 0, or so near to it that dividing by it says nothing.
    bool canBeFlat() const;

    /// Whether it can turn its inside out.
    bool canMirror() const;

    /// At least the operator norm of the linear part at any time; of its inverse, unless it can be flat.
    double norm() const;
    double inverseNorm() const;
};

/// One for each node.
std::vector<NodeMotion> nodeMotions(const formats::MotionTables& tables);

/// How much a set may leave what it is to hold.
struct Tolerance
{
    double linear = 0; ///< of the linear part, in the operator norm
    double shift = 0; ///< metres in the space that the transform leads to; for an inverse, that it comes from
};

/// Transforms from the node to its parent.
MatrixSet parentFromNode(const NodeMotion& motion, Tolerance tolerance);

/// Transforms from the parent to the node. The node cannot be flat.
MatrixSet nodeFromParent(const NodeMotion& motion, Tolerance tolerance);

/// At least the number of matrices in either set, perhaps beyond the range of an integer.
double hullSize(const NodeMotion& motion, Tolerance tolerance);

/// Morph weights of a node: one range for each target, from 0 to 1 and wherever the clips and the rest pose take them.
/// targets  as many as the mesh has
std::vector<Interval> morphWeightRanges(const formats::MotionTables& tables, uint32_t node, size_t targets);

} // namespace hearth::motion
