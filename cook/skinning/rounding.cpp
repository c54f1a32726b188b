// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/skinning/rounding.h"

#include "formats/base/rounding.h"

namespace hearth::skinning
{

namespace
{

// Relative margin for some 30 roundings: transforms of a few joints, their products with weights, and the
// sum.
constexpr double kSingleMargin = 2e-6;

} // namespace

Box3 roundOutwards(const animation_bounds::Box3d& box)
{
    double farthest = 0;
    for (const animation_bounds::Interval& axis : box)
        farthest = std::max(farthest, axis.magnitude());
    Box3 rounded;
    for (size_t axis = 0; axis < 3; ++axis)
    {
        rounded.min[static_cast<int>(axis)] = -roundUp(kSingleMargin * farthest - box[axis].low);
        rounded.max[static_cast<int>(axis)] = roundUp(kSingleMargin * farthest + box[axis].high);
    }
    return rounded;
}

} // namespace hearth::skinning
