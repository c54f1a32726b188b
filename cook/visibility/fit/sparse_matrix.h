// Sparse matrix of the vertex fit.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/block4.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace hearth::visibility
{

/// Symmetric positive semidefinite matrix in compressed sparse row (CSR) form. Columns ascend in each row;
/// entries of the diagonal exist and are positive.
struct SparseMatrix
{
    std::vector<uint32_t> row_start; ///< first entry of each row, then the number of entries
    std::vector<uint32_t> columns;
    std::vector<double> values;

    size_t rowCount() const { return row_start.size() - 1; }

    /// Find the first entry of a row whose column is not less than `column`; the row's end if there is none.
    uint32_t entryFrom(size_t row, uint32_t column) const
    {
        const uint32_t* begin = columns.data() + row_start[row];
        const uint32_t* end = columns.data() + row_start[row + 1];
        return static_cast<uint32_t>(std::lower_bound(begin, end, column) - columns.data());
    }
};

} // namespace hearth::visibility
