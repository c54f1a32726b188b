// Preconditions a linear system by an incomplete Cholesky factorization: factors only where the matrix has
// entries, block by block.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/sparse_matrix.h"

#include <vector>

namespace hearth::visibility
{

/// Preconditioner M = L D L^T, close to a matrix. Leaves out entries of Cholesky's factors where the matrix
/// has none, and entries that connect blocks of rows. M is positive definite for every matrix. The blocks,
/// and all results, are the same for any number of threads.
/// source  J. Meijerink, H. van der Vorst, "An iterative solution method for linear systems of which the
///         coefficient matrix is a symmetric M-matrix", 1977. Differs: our matrices are no M-matrices. The
///         diagonal of a block is increased where needed, as in T. Manteuffel, "An incomplete factorization
///         technique for positive definite linear systems", 1980
class IncompleteCholesky
{
public:
    /// Factorize the matrix. Time O(entries * entries of a row).
    /// matrix  must outlive this
    explicit IncompleteCholesky(const SparseMatrix& matrix);

    /// Compute z = M^-1 r.
    /// returns  r^T z, for each right-hand side
    Block4 apply(const std::vector<Block4>& r, std::vector<Block4>& z) const;

private:
    /// Entries of a row within its block: [first, diagonal) and (diagonal, end).
    struct Row
    {
        uint32_t first;
        uint32_t diagonal;
        uint32_t end;
        double inverse; ///< 1 / entry of D
    };

    size_t blockCount() const;
    void factorize(size_t block);
    /// Factorize a row, with its diagonal increased by `shift` times itself. True if the pivot is large
    /// enough.
    bool factorizeRow(uint32_t row, double shift);
    void applyToBlock(size_t block, const std::vector<Block4>& r, std::vector<Block4>& z) const;

    const SparseMatrix& matrix_;
    std::vector<Row> rows_;
    /// L, and L^T on the other side of the diagonal, at the entries of the matrix.
    std::vector<double> factors_;
};

} // namespace hearth::visibility
