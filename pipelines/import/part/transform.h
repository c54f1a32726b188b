// Transforms of nodes, from glTF's numbers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/affine3d.h"

#include <array>
#include <span>

namespace hearth::import
{

using Transform = Affine3d;

/// translation * rotation (unit quaternion x y z w) * scale.
Transform transformFromTrs(const std::array<float, 3>& translation, const std::array<float, 4>& rotation,
                           const std::array<float, 3>& scale);

/// From glTF's 16 numbers, column by column; the last row is taken to be (0 0 0 1).
Transform transformFromColumns(std::span<const float, 16> columns);

/// Largest difference between two transforms' entries.
double distance(const Transform& a, const Transform& b);

/// Of the linear part: below 0 where the transform mirrors.
double determinant(const Transform& t);

} // namespace hearth::import
