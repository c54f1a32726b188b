// Taylor models: functions of three parameters, each from -1 to 1, as a polynomial of second degree with a
// remainder, an upper bound for the distance between the function and the polynomial.
// source  M. Berz, K. Makino, "Verified integration of ODEs and flows using differential algebraic methods on
//         high-order Taylor models", 1998; here with a fixed order and with a ball as the remainder
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/box.h"
#include "cook/animation_bounds/four.h"

#include <array>
#include <cmath>

namespace hearth::animation_bounds
{

/// Number of terms: 1; x0, x1, x2; x0^2, x1^2, x2^2; x0 x1, x0 x2, x1 x2.
inline constexpr size_t kTerms = 10;
inline constexpr size_t kFirstLinear = 1;
inline constexpr size_t kFirstQuadratic = 4;

/// Return the term of the product of two parameters, 0 to 2.
constexpr size_t termIndex(size_t a, size_t b)
{
    return a == b ? kFirstQuadratic + a : kFirstQuadratic + 2 + a + b;
}

/// Product of two terms, of at most second degree: the term `product` receives one times other.
struct TermProduct
{
    size_t one;
    size_t other;
    size_t product;
};
inline constexpr size_t kTermProducts = 28;
constexpr std::array<TermProduct, kTermProducts> termProducts()
{
    std::array<TermProduct, kTermProducts> products{};
    size_t count = 0;
    for (size_t term = 0; term < kTerms; ++term)
        products[count++] = {0, term, term};
    for (size_t term = 1; term < kTerms; ++term)
        products[count++] = {term, 0, term};
    for (size_t a = 0; a < 3; ++a)
        for (size_t b = 0; b < 3; ++b)
            products[count++] = {kFirstLinear + a, kFirstLinear + b, termIndex(a, b)};
    return products;
}
inline constexpr std::array<TermProduct, kTermProducts> kProducts = termProducts();

/// Parameters of the quadratic terms: term kFirstQuadratic + i is their product.
inline constexpr std::array<std::array<size_t, 2>, 6> kQuadraticParameters{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};

/// Add the product of two polynomials of four numbers, in the order of kProducts.
/// multiply  (one, other, sum): adds the product of a term of either factor to a sum
template <typename Multiply>
HEARTH_INLINE inline void addProducts(const Multiply& multiply, Four (&sums)[kTerms])
{
    for (size_t term = 0; term < kTerms; ++term)
    {
        Four sum = sums[term];
        multiply(0, term, sum);
        if (term > 0)
            multiply(term, 0, sum);
        if (term >= kFirstQuadratic)
        {
            const auto [a, b] = kQuadraticParameters[term - kFirstQuadratic];
            multiply(kFirstLinear + a, kFirstLinear + b, sum);
            if (a != b)
                multiply(kFirstLinear + b, kFirstLinear + a, sum);
        }
        sums[term] = sum;
    }
}

/// Taylor model of N numbers: a vector, or a 3 x 3 matrix row by row.
template <size_t N>
struct TaylorModel
{
    std::array<std::array<double, N>, kTerms> terms{};
    double remainder = 0; ///< Euclidean length for a vector, operator norm for a matrix
};
using VectorModel = TaylorModel<3>;
using MatrixModel = TaylorModel<9>;

/// Norms of a model's terms (for matrices the Frobenius norm), summed by degree.
struct DegreeNorms
{
    double constant = 0;
    double linear = 0;
    double quadratic = 0;

    double all() const { return constant + linear + quadratic; }
};

inline DegreeNorms sumByDegree(const std::array<double, kTerms>& lengths)
{
    return {lengths[0], lengths[1] + lengths[2] + lengths[3],
            lengths[4] + lengths[5] + lengths[6] + lengths[7] + lengths[8] + lengths[9]};
}

template <size_t N>
HEARTH_INLINE inline DegreeNorms degreeNorms(const TaylorModel<N>& model)
{
    std::array<double, kTerms> lengths;
    for (size_t term = 0; term < kTerms; ++term)
    {
        double square = 0;
        for (const double number : model.terms[term])
            square += number * number;
        lengths[term] = std::sqrt(square);
    }
    return sumByDegree(lengths);
}

inline DegreeNorms degreeNorms(const TaylorModel<1>& model)
{
    std::array<double, kTerms> lengths;
    for (size_t term = 0; term < kTerms; ++term)
        lengths[term] = std::abs(model.terms[term][0]);
    return sumByDegree(lengths);
}

/// Dot products of three vectors a, b, c of four numbers: ab, ac, bc, and aa + bb + cc.
HEARTH_INLINE inline void computeDots(const Four& a, const Four& b, const Four& c, Four& dots)
{
    Four columns[4];
    transpose(a * b, a * c, b * c, a * a + b * b + c * c, columns);
    dots = (columns[0] + columns[1]) + (columns[2] + columns[3]);
}

/// Return the norms of terms of four numbers: the largest lengths over all parameters, which are at corners.
HEARTH_INLINE inline DegreeNorms degreeNorms(const Four (&terms)[kTerms])
{
    // |a +- b +- c|^2 for linear terms and for products of two parameters
    const auto largest = [](const Four& dots) HEARTH_INLINE
    {
        const double same = dots[0] + dots[1] + dots[2];
        return dots[3] +
               2 * std::max(std::max(same, same - 2 * (dots[1] + dots[2])),
                            std::max(same - 2 * (dots[0] + dots[2]), same - 2 * (dots[0] + dots[1])));
    };
    Four linear, squares, mixed;
    computeDots(terms[1], terms[2], terms[3], linear);
    computeDots(terms[7], terms[8], terms[9], mixed);
    computeDots(terms[4], terms[5], terms[6], squares);
    const Four constant = terms[0] * terms[0];
    // squares of parameters are at least 0: negative products do not count
    const double of_squares =
        squares[3] + 2 * (std::max(squares[0], 0.0) + std::max(squares[1], 0.0) + std::max(squares[2], 0.0));
    Four lengths{constant[0] + constant[1] + constant[2] + constant[3], largest(linear), of_squares,
                 largest(mixed)};
    setSquareRoot(lengths);
    return {lengths[0], lengths[1], lengths[2] + lengths[3]};
}

/// Return an upper bound for the omitted terms of third and fourth degree of a product.
inline double omittedTerms(const DegreeNorms& a, const DegreeNorms& b)
{
    return a.linear * b.quadratic + a.quadratic * (b.linear + b.quadratic);
}

/// Return the polynomial of the product of two models, without a remainder: matrix times matrix, or matrix
/// times vector.
template <size_t N>
HEARTH_INLINE inline TaylorModel<N> productTerms(const MatrixModel& a, const TaylorModel<N>& b)
{
    constexpr size_t kColumns = N / 3;
    TaylorModel<N> result;
    for (const TermProduct& product : kProducts)
    {
        const std::array<double, 9>& one = a.terms[product.one];
        const std::array<double, N>& other = b.terms[product.other];
        std::array<double, N>& sum = result.terms[product.product];
        for (size_t row = 0; row < 3; ++row)
            for (size_t k = 0; k < 3; ++k)
                for (size_t column = 0; column < kColumns; ++column)
                    sum[row * kColumns + column] += one[row * 3 + k] * other[k * kColumns + column];
    }
    return result;
}

/// Return the range of a polynomial with one component.
inline Interval polynomialRange(const std::array<double, kTerms>& terms)
{
    Interval range{terms[0], terms[0]};
    for (size_t i = 0; i < 3; ++i)
    {
        const double linear = terms[kFirstLinear + i], square = terms[kFirstQuadratic + i];
        Interval along{square - std::abs(linear), square + std::abs(linear)};
        if (2 * std::abs(square) > std::abs(linear))
            along.add(-0.25 * linear * linear / square);
        range.low += along.low;
        range.high += along.high;
    }
    range.grow(std::abs(terms[7]) + std::abs(terms[8]) + std::abs(terms[9]));
    return range;
}

} // namespace hearth::animation_bounds
