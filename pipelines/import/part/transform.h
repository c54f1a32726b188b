// Node transforms from the numbers of a glTF file.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/affine3d.h"

#include <array>
#include <span>

namespace hearth::import
{

using Transform = Affine3d;

/// Return translation * rotation (unit quaternion x y z w) * scale.
Transform transformFromTrs(const std::array<float, 3>& translation, const std::array<float, 4>& rotation,
                           const std::array<float, 3>& scale);

/// Return the transform of glTF's 16 numbers, column by column; the last row is assumed to be (0 0 0 1).
Transform transformFromColumns(std::span<const float, 16> columns);

/// Return the largest difference between the entries of two transforms.
double distance(const Transform& a, const Transform& b);

/// Return the determinant of the linear part: below 0 if the transform mirrors.
double determinant(const Transform& t);

} // namespace hearth::import
