// Sets of rotations that hold all blends of their members, and their matrices as a convex hull.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/box.h"
#include "cook/animation_bounds/key_hull.h"
#include "cook/animation_bounds/symmetric.h"

#include <span>
#include <vector>

namespace hearth::motion
{

/// Directions, up to their sign, of the slabs that bound a patch: 3 axes, then 6 diagonals of its faces and 4 of space.
inline constexpr size_t kSlabCount = 13;

/// Rotations frame * (u, 1) for vectors u inside of slabs. u, the gnomonic projection of a quaternion from the frame,
/// is tan(angle / 2) * axis of the rotation from there on.
struct RotationPatch
{
    formats::Quaternion frame;
    std::array<Double3, 3> axes; ///< orthonormal: the slabs' coordinates
    std::array<Interval, kSlabCount> slabs;
};

/// Matrices whose convex hull, up to `slack` in the operator norm, holds all of a set.
struct RotationHull
{
    std::vector<Matrix3> matrices;
    double slack = 0;
};

class RotationSet
{
public:
    /// All that can be blended, with any weights and any number of times, out of the rotations on the arcs between the
    /// points. At least one point.
    static RotationSet around(const RotationPoints& points);

    /// A hull of the set's matrices that leaves it by no more than about the tolerance in the operator norm, in slack or
    /// where control points stand out; the coarser, the fewer matrices.
    RotationHull hull(double tolerance) const;

    /// At least the number of matrices of that hull: beyond the range of an integer for a tolerance near 0, which hull()
    /// cannot be asked for.
    double hullSize(double tolerance) const;

    /// Whether it can be any rotation.
    bool unbounded() const { return patches_.empty(); }

    std::span<const RotationPatch> patches() const { return patches_; }

private:
    std::vector<RotationPatch> patches_; ///< none: all rotations
};

} // namespace hearth::motion
