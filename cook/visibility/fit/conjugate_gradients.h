// Solves a sparse linear system for four right-hand sides at once by the conjugate gradient method,
// preconditioned by an incomplete Cholesky factorization.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/visibility/fit/sparse_matrix.h"

#include <cstdint>
#include <vector>

namespace hearth::visibility
{

struct SolveStatistics
{
    uint32_t iterations = 0;
    /// Condition number of M^-1 A as far as the right-hand sides reveal it: the ratio of the extreme Lanczos
    /// eigenvalues.
    double condition = 1;
    double residual = 0; ///< largest remaining residual, relative to the right-hand sides
    bool converged = true;
};

/// Solve A x = b, starting from x. Ends when the residual r of every right-hand side has sqrt(r^T M^-1 r) <=
/// tolerance sqrt(b^T M^-1 b), with M the preconditioner and b all right-hand sides together: they have one
/// unit, and a right-hand side near 0 need not be solved to its own last bits. If the matrix is singular but
/// the system is consistent, x keeps the null-space component of the start. Sums have a fixed order: the same
/// bits for any number of threads. Time O(iterations * entries).
/// source  M. Hestenes, E. Stiefel, 1952; eigenvalues of the Lanczos matrix as in G. Golub, C. Van Loan,
///         "Matrix Computations", 10.2
SolveStatistics solve(const SparseMatrix& matrix, const std::vector<Block4>& b, std::vector<Block4>& x,
                      double tolerance, uint32_t max_iterations);

} // namespace hearth::visibility
