// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/incomplete_cholesky.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace hearth::visibility
{

namespace
{

// Rows of a block, which one thread factorizes and solves.
constexpr size_t kRowsPerBlock = 2048;

// Minimum pivot, as a share of the diagonal: where large entries are left out, pivots become small, then
// negative, and later entries grow without bound.
constexpr double kMinPivot = 0.02;

// First increase of a block's diagonal after a pivot that is too small; doubled until it is enough. Entries
// are at most the root of their diagonals' product, so the diagonal times the number of entries in a row is
// always enough.
constexpr double kFirstShift = 0.01;

} // namespace

IncompleteCholesky::IncompleteCholesky(const SparseMatrix& matrix)
    : matrix_(matrix), rows_(matrix.rowCount()), factors_(matrix.values.size())
{
    tbb::parallel_for(size_t{0}, blockCount(), [&](size_t block) { factorize(block); });
}

size_t IncompleteCholesky::blockCount() const
{
    return (rows_.size() + kRowsPerBlock - 1) / kRowsPerBlock;
}

void IncompleteCholesky::factorize(size_t block)
{
    const size_t begin = block * kRowsPerBlock, end = std::min(rows_.size(), begin + kRowsPerBlock);
    for (size_t row = begin; row < end; ++row)
    {
        const auto at = [&](size_t column) { return matrix_.entryFrom(row, static_cast<uint32_t>(column)); };
        rows_[row] = {at(begin), at(row), at(end), 0};
    }
    double shift = 0;
    for (size_t row = begin; row < end;)
        if (factorizeRow(static_cast<uint32_t>(row), shift))
            ++row;
        else
        {
            shift = shift > 0 ? 2 * shift : kFirstShift;
            row = begin;
        }
}

bool IncompleteCholesky::factorizeRow(uint32_t row, double shift)
{
    Row& of_row = rows_[row];
    const std::vector<uint32_t>& columns = matrix_.columns;
    const double whole = matrix_.values[of_row.diagonal];
    // L D first: entry i needs the entries before it
    for (uint32_t i = of_row.first; i < of_row.diagonal; ++i)
    {
        const Row& other = rows_[columns[i]];
        double sum = matrix_.values[i];
        for (uint32_t a = of_row.first, b = other.first; a < i && b < other.diagonal;)
        {
            if (columns[a] == columns[b])
                sum -= factors_[a++] * factors_[b++];
            else
                ++(columns[a] < columns[b] ? a : b);
        }
        factors_[i] = sum;
    }
    double pivot = whole * (1 + shift);
    for (uint32_t i = of_row.first; i < of_row.diagonal; ++i)
    {
        const double factor = factors_[i] * rows_[columns[i]].inverse;
        pivot -= factor * factors_[i];
        factors_[i] = factor;
        factors_[matrix_.entryFrom(columns[i], row)] = factor;
    }
    of_row.inverse = 1 / pivot;
    return pivot >= kMinPivot * whole;
}

void IncompleteCholesky::applyToBlock(size_t block, const std::vector<Block4>& r,
                                      std::vector<Block4>& z) const
{
    const size_t begin = block * kRowsPerBlock, end = std::min(rows_.size(), begin + kRowsPerBlock);
    for (size_t row = begin; row < end; ++row)
    {
        Block4 sum = r[row];
        for (uint32_t i = rows_[row].first; i < rows_[row].diagonal; ++i)
            sum.addScaled(z[matrix_.columns[i]], -factors_[i]);
        z[row] = sum;
    }
    for (size_t row = end; row-- > begin;)
    {
        Block4 sum;
        sum.addScaled(z[row], rows_[row].inverse);
        for (uint32_t i = rows_[row].diagonal + 1; i < rows_[row].end; ++i)
            sum.addScaled(z[matrix_.columns[i]], -factors_[i]);
        z[row] = sum;
    }
}

Block4 IncompleteCholesky::apply(const std::vector<Block4>& r, std::vector<Block4>& z) const
{
    std::vector<Block4> sums(blockCount());
    tbb::parallel_for(size_t{0}, sums.size(),
                      [&](size_t block)
                      {
                          applyToBlock(block, r, z);
                          const size_t end = std::min(rows_.size(), (block + 1) * kRowsPerBlock);
                          for (size_t row = block * kRowsPerBlock; row < end; ++row)
                              sums[block].addProduct(r[row], z[row], 1);
                      });
    Block4 total;
    for (const Block4& sum : sums)
        total.addScaled(sum, 1);
    return total;
}

} // namespace hearth::visibility
