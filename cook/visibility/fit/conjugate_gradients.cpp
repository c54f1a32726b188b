// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/conjugate_gradients.h"

#include "cook/visibility/fit/incomplete_cholesky.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <tbb/parallel_for.h>

namespace hearth::visibility
{

namespace
{

// Rows that one task sums in sequence. The sums of blocks are added in the order of the blocks.
constexpr size_t kRowsPerTask = 2048;

/// Sum over all rows: `term(row, sum)` adds the term of a row.
template <typename Term>
Block4 sumRows(size_t rows, const Term& term)
{
    const size_t blocks = (rows + kRowsPerTask - 1) / kRowsPerTask;
    std::vector<Block4> sums(blocks);
    tbb::parallel_for(size_t{0}, blocks,
                      [&](size_t block)
                      {
                          Block4 sum;
                          const size_t end = std::min(rows, (block + 1) * kRowsPerTask);
                          for (size_t row = block * kRowsPerTask; row < end; ++row)
                              term(row, sum);
                          sums[block] = sum;
                      });
    Block4 total;
    for (const Block4& sum : sums)
        total.addScaled(sum, 1);
    return total;
}

Block4 rowTimes(const SparseMatrix& matrix, size_t row, const std::vector<Block4>& x)
{
    Block4 sum;
    for (uint32_t i = matrix.row_start[row]; i < matrix.row_start[row + 1]; ++i)
        sum.addScaled(x[matrix.columns[i]], matrix.values[i]);
    return sum;
}

/// Tridiagonal Lanczos matrix of the iterations. Its eigenvalues lie within the range of the preconditioned
/// matrix's eigenvalues, and its extreme ones soon approach the extreme ones there.
class Lanczos
{
public:
    void add(double step, double beta)
    {
        diagonal_.push_back(1 / step + carry_);
        off_diagonal2_.push_back(beta / (step * step));
        carry_ = beta / step;
    }

    double condition() const
    {
        if (diagonal_.empty())
            return 1;
        double high = 0; // all eigenvalues are positive and no greater
        for (size_t i = 0; i < diagonal_.size(); ++i)
            high = std::max(high, diagonal_[i] + std::sqrt(off_diagonal2_[i]) +
                                      (i > 0 ? std::sqrt(off_diagonal2_[i - 1]) : 0));
        const double min_eigenvalue = eigenvalue(1, high),
                     max_eigenvalue = eigenvalue(diagonal_.size(), high);
        return min_eigenvalue > 0 ? max_eigenvalue / min_eigenvalue : std::numeric_limits<double>::infinity();
    }

private:
    /// Count the eigenvalues below x, by the signs of the pivots of T - x (Sturm sequence).
    size_t countBelow(double x) const
    {
        size_t count = 0;
        double pivot = 1;
        for (size_t i = 0; i < diagonal_.size(); ++i)
        {
            pivot = diagonal_[i] - x - (i > 0 ? off_diagonal2_[i - 1] / pivot : 0);
            if (pivot == 0)
                pivot = std::numeric_limits<double>::min();
            count += pivot < 0;
        }
        return count;
    }

    /// Compute the number-th smallest eigenvalue, by bisection to a thousandth.
    double eigenvalue(size_t number, double high) const
    {
        double low = 0;
        for (int i = 0; i < 200 && high - low > 1e-3 * low; ++i)
        {
            const double middle = (low + high) / 2;
            (countBelow(middle) >= number ? high : low) = middle;
        }
        return (low + high) / 2;
    }

    std::vector<double> diagonal_;
    std::vector<double> off_diagonal2_; ///< squares of the entries beside the diagonal
    double carry_ = 0;
};

bool allDone(const std::array<bool, 4>& active)
{
    return std::none_of(active.begin(), active.end(), [](bool a) { return a; });
}

} // namespace

SolveStatistics solve(const SparseMatrix& matrix, const std::vector<Block4>& b, std::vector<Block4>& x,
                      double tolerance, uint32_t max_iterations)
{
    const size_t rows = matrix.rowCount();
    HEARTH_ASSERT(b.size() == rows && x.size() == rows);
    const IncompleteCholesky preconditioner(matrix);
    std::vector<Block4> r(rows), z(rows), q(rows);
    double reference = 0;
    for (const double norm : preconditioner.apply(b, z).v)
        reference += norm;
    const double enough = tolerance * tolerance * reference;

    tbb::parallel_for(size_t{0}, rows,
                      [&](size_t i)
                      {
                          r[i] = b[i];
                          r[i].addScaled(rowTimes(matrix, i, x), -1);
                      });
    Block4 rz = preconditioner.apply(r, z);
    std::vector<Block4> p = z;
    SolveStatistics statistics;
    std::array<Lanczos, 4> lanczos;
    std::array<bool, 4> active;
    for (size_t k = 0; k < 4; ++k)
        active[k] = rz.v[k] > enough;
    while (!allDone(active) && statistics.iterations < max_iterations)
    {
        ++statistics.iterations;
        const Block4 pq = sumRows(rows,
                                  [&](size_t i, Block4& sum)
                                  {
                                      q[i] = rowTimes(matrix, i, p);
                                      sum.addProduct(p[i], q[i], 1);
                                  });
        Block4 step;
        for (size_t k = 0; k < 4; ++k)
        {
            active[k] = active[k] && pq.v[k] > 0; // the remainder is rounding: nothing to gain
            step.v[k] = active[k] ? rz.v[k] / pq.v[k] : 0;
        }
        tbb::parallel_for(size_t{0}, rows,
                          [&](size_t i)
                          {
                              x[i].addProduct(p[i], step, 1);
                              r[i].addProduct(q[i], step, -1);
                          });
        const Block4 next = preconditioner.apply(r, z);
        Block4 beta;
        for (size_t k = 0; k < 4; ++k)
        {
            if (!active[k])
                continue;
            beta.v[k] = next.v[k] / rz.v[k];
            lanczos[k].add(step.v[k], beta.v[k]);
            rz.v[k] = next.v[k];
            active[k] = rz.v[k] > enough;
        }
        tbb::parallel_for(size_t{0}, rows,
                          [&](size_t i)
                          {
                              for (size_t k = 0; k < 4; ++k)
                                  p[i].v[k] = z[i].v[k] + beta.v[k] * p[i].v[k];
                          });
    }
    for (size_t k = 0; k < 4; ++k)
    {
        statistics.condition = std::max(statistics.condition, lanczos[k].condition());
        if (reference > 0)
            statistics.residual = std::max(statistics.residual, std::sqrt(rz.v[k] / reference));
    }
    statistics.converged = statistics.residual <= tolerance;
    return statistics;
}

} // namespace hearth::visibility
