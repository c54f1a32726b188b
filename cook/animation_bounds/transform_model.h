// Affine transforms as Taylor models over the parameters of a pose region, and their composition.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/pose_regions.h"
#include "formats/base/affine3d.h"

#include <optional>

namespace hearth::animation_bounds
{

/// Linear part that is a rotation, or nearly so, as a quaternion. Quaternion products need a quarter of the
/// multiplications of matrix products, and the error of their omitted terms is an eighth.
struct RigidModel
{
    TaylorModel<4> rotation;
    DegreeNorms norms;  ///< norms of the rotation's terms
    double stretch = 0; ///< operator norm of the difference between the linear part and a rotation
};

/// Transform that maps x to linear (x - pivot) + place.
struct TransformModel
{
    MatrixModel linear;
    DegreeNorms norms; ///< upper bounds for the operator norms of linear's terms
    std::optional<RigidModel> rigid;
    Double3 pivot;
    VectorModel place;
    /// upper bound for the operator norm of the linear part of each transform that the model must contain
    double norm = 1;

    /// Return an upper bound for the distance between a point's image and the image by the polynomials.
    double slackAt(Double3 point) const { return linear.remainder * length(point - pivot) + place.remainder; }
};

/// Return the identity.
TransformModel identityModel();

/// Return a constant transform.
TransformModel constantModel(const Affine3d& transform);

/// Compute the transform from a node to its parent. If it is rigid, `linear` is not filled in; `compose` does
/// not need it.
void setParentFromNode(const NodeModel& node, TransformModel& transform);

/// Compute the transform from the parent to the node, filled in likewise; false if a scale can be 0.
bool setNodeFromParent(const NodeModel& node, TransformModel& transform);

/// Compute result = `first`, then `second`. `second` must be filled in completely; `result` is. Fills in the
/// linear part of `first` where it is needed. The pivot is the pivot of `first`.
void compose(const TransformModel& second, TransformModel& first, TransformModel& result);

} // namespace hearth::animation_bounds
