// Transforms of nodes in double precision: a deep hierarchy far from the origin keeps its millimetres.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/math.h"

#include <array>
#include <optional>
#include <span>

namespace hearth::import
{

/// Affine, row-major 3x4, as Affine3.
struct Transform
{
    double m[3][4] = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};
};

Transform operator*(const Transform& a, const Transform& b);

/// Nothing where the linear part is flat.
std::optional<Transform> inverted(const Transform& transform);

/// translation * rotation (unit quaternion x y z w) * scale.
Transform transformFromTrs(const std::array<float, 3>& translation, const std::array<float, 4>& rotation,
                           const std::array<float, 3>& scale);

/// From glTF's 16 numbers, column by column; the last row is taken to be (0 0 0 1).
Transform transformFromColumns(std::span<const float, 16> columns);

/// In single precision, or nothing where a number does not fit.
std::optional<Affine3> narrowed(const Transform& transform);

/// Largest difference between two transforms' entries.
double distance(const Transform& a, const Transform& b);

} // namespace hearth::import
