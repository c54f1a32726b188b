// Sets of affine transforms that are closed under taking averages: what one joint can do as another one sees it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/affine3d.h"

#include <vector>

namespace hearth::motion
{

/// All D = C + E with C in the convex hull of the matrices, and |E x| <= linear_slack * |x - pivot| + point_slack for
/// all points x.
struct MatrixSet
{
    std::vector<Affine3d> hull;
    double hull_norm = 1; ///< at least the operator norm of each matrix of the hull
    double norm = 1;      ///< at least that of each transform that the set is to hold
    Double3 pivot;
    double linear_slack = 0;
    double point_slack = 0;
};

/// The set of one.
MatrixSet only(const Affine3d& transform);

/// Everything that one of `second` does to what one of `first` did. The pivot is that of `first`.
MatrixSet composed(const MatrixSet& second, const MatrixSet& first);

/// A set of one matrix with slack that holds the set.
struct MatrixBall
{
    Affine3d center;
    Double3 pivot;
    double linear_slack = 0;
    double point_slack = 0;

    /// How far at most any transform of the set takes a point from where the center takes it.
    double slackAt(Double3 point) const { return linear_slack * length(point - pivot) + point_slack; }
};
MatrixBall ballAround(const MatrixSet& set);

/// How far the transforms D of a set are from doing nothing: |D x - x| <= rotation * |x - pivot| + shift.
struct Departure
{
    Double3 pivot;
    double rotation = 0; ///< operator norm of D's linear part less the unit matrix
    double shift = 0;    ///< metres
};
Departure departureOf(const MatrixSet& set);

} // namespace hearth::motion
