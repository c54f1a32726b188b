// Makes a system well conditioned before it is solved: Cholesky's factors where the matrix itself has entries, block by
// block.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/sparse_matrix.h"

#include <vector>

namespace hearth::visibility
{

/// M = L D L^T, near to a matrix: what Cholesky's factors have beside its entries, and what connects blocks of rows, is left
/// out. M is positive definite whatever the matrix. Blocks are the same for any number of threads, and so is all else.
/// source  J. Meijerink, H. van der Vorst, "An iterative solution method for linear systems of which the coefficient
///         matrix is a symmetric M-matrix", 1977. Ours are none: the diagonal of a block is increased where that is needed, as
///         in T. Manteuffel, "An incomplete factorization technique for positive definite linear systems", 1980
class IncompleteCholesky
{
public:
    /// matrix  must outlive this. Time O(entries * entries of a row)
    explicit IncompleteCholesky(const SparseMatrix& matrix);

    /// z = M^-1 r.
    /// returns  r^T z, for each right-hand side
    Block4 apply(const std::vector<Block4>& r, std::vector<Block4>& z) const;

private:
    /// Entries of a row: [first, diagonal) and (diagonal, end) are those of its block.
    struct Row
    {
        uint32_t first;
        uint32_t diagonal;
        uint32_t end;
        double inverse; ///< of D
    };

    size_t blockCount() const;
    void factorize(size_t block);
    /// Whether the pivot is large enough, after the diagonal is increased by `shift` times itself.
    bool factorizeRow(uint32_t row, double shift);
    void applyTo(size_t block, const std::vector<Block4>& r, std::vector<Block4>& z) const;

    const SparseMatrix& matrix_;
    std::vector<Row> rows_;
    std::vector<double>
        factors_; ///< L, and L^T on the other side of the diagonal, where the matrix has its entries
};

} // namespace hearth::visibility
