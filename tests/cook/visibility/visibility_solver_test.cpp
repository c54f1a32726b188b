// Compares incomplete factors, and the solver that uses them, with dense and band matrices.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/fit/conjugate_gradients.h"
#include "cook/visibility/fit/incomplete_cholesky.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <tbb/global_control.h>

namespace hearth::visibility
{

namespace
{

/// block rows of the factors: entries that connect such blocks are dropped
constexpr uint32_t kBlockRows = 2048;

/// Band matrix: `diagonal` on the diagonal, `beside[i]` i + 1 places to both sides of it; zeros are not
/// stored.
SparseMatrix bandMatrix(uint32_t rows, double diagonal, const std::vector<double>& beside)
{
    SparseMatrix matrix;
    const auto width = static_cast<int64_t>(beside.size());
    matrix.row_start.push_back(0);
    for (int64_t row = 0; row < rows; ++row)
    {
        for (int64_t column = std::max<int64_t>(0, row - width);
             column <= std::min<int64_t>(rows - 1, row + width); ++column)
        {
            const int64_t distance = std::abs(row - column);
            const double value = distance == 0 ? diagonal : beside[static_cast<size_t>(distance - 1)];
            if (value == 0)
                continue;
            matrix.columns.push_back(static_cast<uint32_t>(column));
            matrix.values.push_back(value);
        }
        matrix.row_start.push_back(static_cast<uint32_t>(matrix.columns.size()));
    }
    return matrix;
}

/// Sum of squares, each of four neighbours with signs, plus a small multiple of the identity. Incomplete
/// factorization drops most entries of its factors.
SparseMatrix squares(uint32_t size)
{
    std::vector<std::map<uint32_t, double>> rows(size);
    std::mt19937 random(5);
    for (uint32_t i = 0; i < size; ++i)
        rows[i][i] += 1e-2;
    for (uint32_t i = 0; i + 60 < size; ++i)
    {
        std::array<uint32_t, 4> places;
        std::array<double, 4> factors;
        for (size_t k = 0; k < 4; ++k)
        {
            places[k] = i + static_cast<uint32_t>(random() % 60);
            factors[k] = random() % 2 == 0 ? 1 : -1;
        }
        for (size_t k = 0; k < 4; ++k)
            for (size_t j = 0; j < 4; ++j)
                rows[places[k]][places[j]] += factors[k] * factors[j];
    }
    SparseMatrix matrix;
    matrix.row_start.push_back(0);
    for (const auto& row : rows)
    {
        for (const auto& [column, value] : row)
        {
            matrix.columns.push_back(column);
            matrix.values.push_back(value);
        }
        matrix.row_start.push_back(static_cast<uint32_t>(matrix.columns.size()));
    }
    return matrix;
}

std::vector<Block4> numbers(size_t rows)
{
    std::vector<Block4> b(rows);
    for (size_t i = 0; i < rows; ++i)
        for (size_t k = 0; k < 4; ++k)
            b[i].v[k] = std::sin(static_cast<double>(i * 4 + k) * 1.7);
    return b;
}

std::vector<Block4> product(const SparseMatrix& matrix, const std::vector<Block4>& x)
{
    std::vector<Block4> b(x.size());
    for (size_t row = 0; row < x.size(); ++row)
        for (uint32_t i = matrix.row_start[row]; i < matrix.row_start[row + 1]; ++i)
            b[row].addScaled(x[matrix.columns[i]], matrix.values[i]);
    return b;
}

double largestDifference(const std::vector<Block4>& a, const std::vector<Block4>& b)
{
    double most = 0;
    for (size_t i = 0; i < a.size(); ++i)
        for (size_t k = 0; k < 4; ++k)
            most = std::max(most, std::abs(a[i].v[k] - b[i].v[k]));
    return most;
}

} // namespace

TEST(IncompleteCholesky, isExactWhereNothingIsLeftOut)
{
    const SparseMatrix matrix = bandMatrix(kBlockRows, 2.1, {-1});
    const std::vector<Block4> x = numbers(matrix.rowCount()), r = product(matrix, x);
    std::vector<Block4> z(r.size());
    const Block4 rz = IncompleteCholesky(matrix).apply(r, z);
    EXPECT_LT(largestDifference(x, z), 1e-12);
    for (size_t k = 0; k < 4; ++k)
    {
        double sum = 0;
        for (size_t i = 0; i < r.size(); ++i)
            sum += r[i].v[k] * x[i].v[k];
        EXPECT_NEAR(rz.v[k], sum, 1e-9 * sum);
    }
}

TEST(IncompleteCholesky, isPositiveDefinite)
{
    const SparseMatrix matrix = squares(400);
    const IncompleteCholesky preconditioner(matrix);
    std::vector<Block4> z(matrix.rowCount());
    for (size_t i = 0; i < z.size(); ++i)
    {
        std::vector<Block4> r(z.size());
        r[i].v[0] = 1;
        r[i * 7 % z.size()].v[0] -= 0.5;
        const double rz = preconditioner.apply(r, z).v[0];
        EXPECT_GT(rz, 0);
        EXPECT_LT(rz, 1e3) << "the inverse's greatest eigenvalue";
    }
}

TEST(Solve, isRightOverSeveralBlocksAndWithFill)
{
    for (const SparseMatrix& matrix : {bandMatrix(3 * kBlockRows + 5, 2.1, {-1}), squares(900)})
    {
        const std::vector<Block4> wanted = numbers(matrix.rowCount());
        std::vector<Block4> x(wanted.size());
        const SolveStatistics statistics = solve(matrix, product(matrix, wanted), x, 1e-12, 500);
        EXPECT_TRUE(statistics.converged);
        EXPECT_LT(largestDifference(x, wanted), 1e-7);
    }
}

TEST(Solve, ofThreeBlocksTakesAFewSteps)
{
    // factors that are exact but for two entries, which change two pairs of eigenvalues
    const SparseMatrix matrix = bandMatrix(3 * kBlockRows, 2.1, {-1});
    const std::vector<Block4> wanted = numbers(matrix.rowCount());
    std::vector<Block4> x(wanted.size());
    EXPECT_LE(solve(matrix, product(matrix, wanted), x, 1e-8, 500).iterations, 5u);
}

TEST(Solve, hasTheSameBitsForAnyNumberOfThreads)
{
    const SparseMatrix matrix = squares(4 * kBlockRows);
    const std::vector<Block4> b = numbers(matrix.rowCount());
    std::vector<std::vector<Block4>> results;
    for (const size_t threads : {1u, 3u})
    {
        const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
        results.emplace_back(b.size());
        solve(matrix, b, results.back(), 1e-8, 500);
    }
    EXPECT_EQ(largestDifference(results[0], results[1]), 0);
}

} // namespace hearth::visibility
