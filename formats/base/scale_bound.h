// How much a transform stretches at most: what InstanceRecord::scale_max promises.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/math.h"

namespace hearth
{

/// At least the largest singular value of the linear part, and at most 1e-6 of it more.
float scaleBound(const Affine3& transform);

} // namespace hearth
