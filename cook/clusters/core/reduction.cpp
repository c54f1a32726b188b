// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/reduction.h"

#include "formats/base/assert.h"

#include <algorithm>

namespace hearth::clusters
{

LevelStep findGroupStep(const Reduction& reduction, uint32_t level, std::span<const uint32_t> materials)
{
    HEARTH_ASSERT(!materials.empty());
    LevelStep largest{0, 1};
    for (const uint32_t material : materials)
    {
        const auto own = reduction.curve_of_material.find(material);
        const LevelCurve& curve = own == reduction.curve_of_material.end() ? reduction.curve : own->second;
        HEARTH_ASSERT(!curve.empty());
        const LevelStep& step = curve[std::min<size_t>(level, curve.size() - 1)];
        largest.keep = std::max(largest.keep, step.keep);
        largest.error_weight = std::max(largest.error_weight, step.error_weight);
    }
    HEARTH_ASSERT(largest.keep > 0 && largest.error_weight >= 1);
    return largest;
}

} // namespace hearth::clusters
