// The matrix of the fit.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/block4.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace hearth::visibility
{

/// Symmetric, positive semidefinite, in compressed rows: columns ascend in each row, the diagonal is there and
/// positive.
struct SparseMatrix
{
    std::vector<uint32_t> row_start; ///< of each row, and the end
    std::vector<uint32_t> columns;
    std::vector<double> values;

    size_t rowCount() const { return row_start.size() - 1; }

    /// The first entry of a row whose column is not before `column`; the row's end, if there is none.
    uint32_t entryFrom(size_t row, uint32_t column) const
    {
        const uint32_t* begin = columns.data() + row_start[row];
        const uint32_t* end = columns.data() + row_start[row + 1];
        return static_cast<uint32_t>(std::lower_bound(begin, end, column) - columns.data());
    }
};

} // namespace hearth::visibility
