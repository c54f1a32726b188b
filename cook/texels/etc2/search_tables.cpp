// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/etc2/search_tables.h"

#include "formats/base/assert.h"
#include "formats/texels/etc2_tables.h"

#include <algorithm>

namespace hearth::texels
{

SearchTables::SearchTables(ColorWeights channel_weights)
    : weights(channel_weights), weight_sum(weights[0] + weights[1] + weights[2])
{
    for (const uint8_t weight : weights)
        HEARTH_ASSERT(weight >= 1 && weight <= kMaxWeight);
    const auto count = static_cast<size_t>(255 * weight_sum + 1);
    halves.resize(count);
    lines.resize(count);
    for (size_t gray = 0; gray < count; ++gray)
        for (size_t t = 0; t < 8; ++t)
        {
            const auto change = [&](int32_t modifier)
            { return weight_sum * modifier * modifier - 2 * modifier * static_cast<int32_t>(gray); };
            halves[gray][t] =
                std::min(change(formats::kEtcDistances[t][0]), change(formats::kEtcDistances[t][1]));
            lines[gray][t] = std::min(0, change(formats::kEtcPaintDistances[t]));
        }
}

} // namespace hearth::texels
