// Affine transforms in double precision: a deep hierarchy far from the origin keeps its millimetres.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/double3.h"
#include "formats/base/math.h"

#include <array>
#include <optional>

namespace hearth
{

/// Affine transform, row-major 3x4, as Affine3. Named target_from_source.
struct Affine3d
{
    double m[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
    friend bool operator==(const Affine3d&, const Affine3d&) = default;
};

Affine3d operator*(const Affine3d& a, const Affine3d& b);

Double3 transformVector(const Affine3d& transform, Double3 vector);
Double3 transformPoint(const Affine3d& transform, Double3 point);

/// Transform the normal of a surface, by the cofactors of the linear part. Not unit; a mirroring transform
/// turns it round.
Double3 transformNormal(const Affine3d& transform, Double3 normal);

/// Return translation * rotation (unit quaternion x y z w) * scale.
Affine3d makeAffineFromTrs(Double3 translation, const std::array<double, 4>& rotation, Double3 scale);

/// Return the inverse; nullopt if the linear part is singular.
std::optional<Affine3d> inverted(const Affine3d& transform);

Affine3d widened(const Affine3& transform);

/// Return the bounding box of a transformed box, rounded outwards; finite, clamped to the range of floats. An
/// empty box stays empty.
Box3 transformBox(const Affine3d& transform, const Box3& box);

/// Convert to single precision; nullopt if a number does not fit.
std::optional<Affine3> narrowed(const Affine3d& transform);

} // namespace hearth
