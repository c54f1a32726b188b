// Sets of rotations that are closed under blending, and convex hulls of their matrices.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/box.h"
#include "cook/animation_bounds/key_hull.h"
#include "cook/animation_bounds/symmetric.h"

#include <span>
#include <vector>

namespace hearth::animation_bounds
{

/// Number of directions, up to sign, of the slabs that bound a patch: 3 axes, 6 face diagonals and 4 space
/// diagonals.
inline constexpr size_t kSlabCount = 13;

/// Rotations frame * (u, 1) for vectors u inside of slabs. u is the gnomonic projection of a quaternion
/// relative to the frame: tan(angle / 2) * axis of the rotation relative to the frame.
struct RotationPatch
{
    formats::Quaternion frame;
    std::array<Double3, 3> axes; ///< orthonormal coordinate axes of the slabs
    std::array<Interval, kSlabCount> slabs;
};

/// Matrices whose convex hull contains all matrices of a set, up to `slack` in the operator norm.
struct RotationHull
{
    std::vector<Matrix3> matrices;
    double slack = 0;
};

/// Set of rotations that contains all blends of its members.
class RotationSet
{
public:
    /// Return the set of all blends, with any weights and repeated any number of times, of rotations on the
    /// arcs between the points. At least one point.
    static RotationSet around(const RotationPoints& points);

    /// Return a convex hull of the set's matrices. It exceeds the set by about the tolerance at most, in the
    /// operator norm, through slack or control points outside. A larger tolerance gives fewer matrices.
    RotationHull hull(double tolerance) const;

    /// Return an upper bound for the number of matrices of that hull. For a tolerance near 0 it exceeds the
    /// range of integers, and hull() must not be called.
    double hullSize(double tolerance) const;

    /// True if the set contains any rotation.
    bool unbounded() const { return patches_.empty(); }

    std::span<const RotationPatch> patches() const { return patches_; }

private:
    std::vector<RotationPatch> patches_; ///< none: all rotations
};

} // namespace hearth::animation_bounds
