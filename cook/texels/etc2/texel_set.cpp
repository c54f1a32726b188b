// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/etc2/texel_set.h"

#include <algorithm>

namespace hearth::texels
{

TexelSet::TexelSet(const Block8& block, TexelMask mask, const SearchTables& tables)
{
    for (size_t t = 0; t < 16; ++t)
    {
        if ((mask >> t & 1) == 0)
            continue;
        int32_t gray = 0;
        for (size_t c = 0; c < 3; ++c)
        {
            const int32_t code = block[t][c];
            sums[c] += code;
            gray += tables.weights[c] * code;
            squares += tables.weights[c] * code * code;
        }
        min_gray = count == 0 ? gray : std::min(min_gray, gray);
        max_gray = count == 0 ? gray : std::max(max_gray, gray);
        grays[static_cast<size_t>(count++)] = gray;
    }
}

} // namespace hearth::texels
