// Bounds the local transform of a node over all clips at all times, their blends, and the rest pose.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/matrix_set.h"
#include "cook/animation_bounds/rotation_set.h"

#include <optional>
#include <vector>

namespace hearth::animation_bounds
{

/// Bounds of a node's translation, rotation and scale, each by itself. They contain the convex hull (for
/// rotations the cone of their quaternions) of all keys and splines, so they contain any blend of any number
/// of poses.
struct NodeMotion
{
    Box3d translations;
    RotationSet rotations;
    Box3d scales;
    /// set for a node with a matrix instead of translation, rotation and scale
    std::optional<Affine3d> fixed;

    /// True if any scale can be 0, or so near to 0 that division by it gives no useful bound.
    bool canBeSingular() const;

    /// True if the node can mirror, so that triangles are turned inside out.
    bool canMirror() const;

    /// Return an upper bound for the operator norm of the linear part at any time; inverseNorm: of the
    /// inverse, for a node that cannot be flat.
    double norm() const;
    double inverseNorm() const;
};

/// Compute the motion of each node.
std::vector<NodeMotion> nodeMotions(const formats::AnimationTables& tables);

/// Allowed distance between a set and the exact bounds.
struct Tolerance
{
    double linear = 0; ///< of the linear part, operator norm
    double shift = 0;  ///< metres in the target space of the transform; for an inverse, in its source space
};

/// Return the transforms from the node to its parent.
MatrixSet parentFromNode(const NodeMotion& motion, Tolerance tolerance);

/// Return the transforms from the parent to the node. The node must not be flat.
MatrixSet nodeFromParent(const NodeMotion& motion, Tolerance tolerance);

/// Return an upper bound for the number of matrices in either set. It may exceed the range of integers.
double hullSize(const NodeMotion& motion, Tolerance tolerance);

/// Return the ranges of a node's morph weights, one for each target: from 0 to 1 and all values in clips and
/// the rest pose.
/// targets  number of targets of the mesh
std::vector<Interval> morphWeightRanges(const formats::AnimationTables& tables, uint32_t node,
                                        size_t targets);

} // namespace hearth::animation_bounds
