// Convex sets of affine transforms: bounds the motion of a joint relative to another joint.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/affine3d.h"

#include <vector>

namespace hearth::animation_bounds
{

/// Set of all transforms D = C + E with C in the convex hull of the matrices, and
/// |E x| <= linear_slack * |x - pivot| + point_slack for all points x.
struct MatrixSet
{
    std::vector<Affine3d> hull;
    double hull_norm = 1; ///< upper bound for the operator norm of each matrix of the hull
    double norm = 1;      ///< upper bound for the operator norm of each transform that the set must contain
    Double3 pivot;
    double linear_slack = 0;
    double point_slack = 0;
};

/// Return the set of one transform.
MatrixSet singletonSet(const Affine3d& transform);

/// Return the set of all products of a transform of `first`, then one of `second`. The pivot is the pivot of
/// `first`.
MatrixSet composeSets(const MatrixSet& second, const MatrixSet& first);

/// Set of one matrix with slack, a superset of a MatrixSet.
struct MatrixBall
{
    Affine3d center;
    Double3 pivot;
    double linear_slack = 0;
    double point_slack = 0;

    /// Return an upper bound for the distance between the images of a point under any transform of the set
    /// and under the center.
    double slackAt(Double3 point) const { return linear_slack * length(point - pivot) + point_slack; }
};
MatrixBall boundingBall(const MatrixSet& set);

/// Upper bound for the distance of a set's transforms D from the identity:
/// |D x - x| <= rotation * |x - pivot| + shift.
struct IdentityDeviation
{
    Double3 pivot;
    double rotation = 0; ///< operator norm of D's linear part minus the unit matrix
    double shift = 0;    ///< metres
};
IdentityDeviation computeIdentityDeviation(const MatrixSet& set);

} // namespace hearth::animation_bounds
