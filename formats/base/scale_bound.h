// Bounds the largest stretch of a transform, for InstanceRecord::scale_max.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

namespace hearth
{

/// Return an upper bound of the largest singular value of the linear part, at most 1e-6 of it too large.
float scaleBound(const Affine3& transform);

} // namespace hearth
