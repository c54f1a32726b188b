// Transforms that depend on the parameters of a region of poses, and chains of them.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/pose_regions.h"
#include "formats/base/affine3d.h"

#include <optional>

namespace hearth::motion
{

/// A linear part that is a rotation, or nearly so. Quaternions say that with a quarter of the numbers' products, and what
/// they leave out is an eighth of what products of matrices do.
struct RigidModel
{
    TaylorModel<4> rotation;
    DegreeNorms norms;  ///< of the rotation
    double stretch = 0; ///< operator norm of what the linear part differs from a rotation by
};

/// x comes to linear (x - pivot) + place.
struct TransformModel
{
    MatrixModel linear;
    DegreeNorms norms; ///< at least the operator norms of linear's terms
    std::optional<RigidModel> rigid;
    Double3 pivot;
    VectorModel place;
    double norm = 1; ///< at least the operator norm of the linear part of each transform that is to be held

    /// How far at most a transform takes a point from where the polynomials take it.
    double slackAt(Double3 point) const { return linear.remainder * length(point - pivot) + place.remainder; }
};

/// One that does nothing.
TransformModel unmoved();

/// One that stays.
TransformModel exactly(const Affine3d& transform);

/// From a node to its parent. Where it is rigid, the linear part is not filled in: `compose` does without.
TransformModel parentFromNode(const NodeModel& node);

/// From the parent to the node, in the same way; nothing where a scale can be 0.
std::optional<TransformModel> nodeFromParent(const NodeModel& node);

/// First `first`, then `second`, of which all is filled in, as it is of the result; of `first` where that takes it. The pivot is that of `first`.
void compose(const TransformModel& second, TransformModel& first, TransformModel& result);

} // namespace hearth::motion
