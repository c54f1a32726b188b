// Searches the modes T and H of ETC2: two colours of any distance, and a distance in gray.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/texels/etc2/paints.h"
#include "cook/texels/etc2/texel_set.h"

#include <array>
#include <cstdint>

namespace hearth::texels
{

/// Two colours and the distance.
struct PaintSolution
{
    int32_t error = INT32_MAX;
    bool is_h = false;          ///< both colours at the distance on either side; else T: the first alone, the
                                ///< second by itself and at the distance on either side
    std::array<Rgb, 2> codes{}; ///< 4 bits
    uint8_t distance = 0;       ///< index of kEtcPaintDistances

    Paints paints() const;
};

/// Find colours of little error.
/// limit  error that is of use: solutions far above are not refined
PaintSolution searchPaints(const Block8& block, const SearchTables& tables, Effort effort, int32_t limit);

} // namespace hearth::texels
