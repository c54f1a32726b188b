// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_bounds/slerp_model.h"

#include "cook/animation_bounds/quaternion.h"

#include <array>
#include <cmath>
#include <map>
#include <numbers>

namespace hearth::animation_bounds
{

using namespace formats;

namespace
{

// Maximum squared sine of half the arc; 1/2 is for quaternions at a right angle, which are half a turn apart.
constexpr double kMaxSquaredSine = 0.495;

// Terms below which series end: for values, and for bounds of third derivatives, which are of order 1. The
// omitted rest counts as an error.
constexpr double kValueTerm = 1e-8;
constexpr double kBoundTerm = 1e-3;

// Upper bound for the error of an expansion, by that of its series: the factors of the latter sum to less for
// weights in [0, 1] and squared sines in [0, 1/2].
constexpr double kErrorGain = 8;

// Upper bound for rounding errors.
constexpr double kSlerpRounding = 1e-12;

constexpr size_t kMaxTerms = SeriesCoefficients::kMaxTerms;

/// Numbers of the term k that depend on k alone.
struct TermFactors
{
    double share;      ///< of the term in the sines
    double square;     ///< (k + 1/2)^2
    double inverse;    ///< 1 / ((k + 1/2) (k + 1))
    double falling[5]; ///< 1, k, k (k - 1), ..
};
constexpr std::array<TermFactors, kMaxTerms> termFactors()
{
    std::array<TermFactors, kMaxTerms> factors{};
    for (size_t k = 0; k < kMaxTerms; ++k)
    {
        const auto number = static_cast<double>(k);
        factors[k] = {1.0 / (2 * number + 1),
                      (number + 0.5) * (number + 0.5),
                      1 / ((number + 0.5) * (number + 1)),
                      {1}};
        for (size_t j = 0; j < 4; ++j)
            factors[k].falling[j + 1] = factors[k].falling[j] * (number - static_cast<double>(j));
    }
    return factors;
}
constexpr std::array<TermFactors, kMaxTerms> kTermFactors = termFactors();

/// Evaluate the series, with derivatives up to an order of 2 or 3.
/// last_term  maximum of the last term; the omitted rest is at most three times as large
template <size_t kOrder>
HEARTH_INLINE inline void sumSeries(SeriesCoefficients& coefficients, double z, double last_term, Series& sum)
{
    // derivatives by z; those by v are side by side
    Four cosines[kOrder + 1] = {}, sines[kOrder + 1] = {};
    double powers[4] = {1, 0, 0, 0}; // z^(k - j)
    for (size_t k = 0; k < kMaxTerms; ++k)
    {
        const TermFactors& factors = kTermFactors[k];
        const SeriesCoefficients::Term& c = coefficients.term(k);
        for (size_t j = 0; j <= kOrder; ++j)
        {
            const Four term = c.derivatives * (factors.falling[j] * powers[j]);
            cosines[j] += term;
            sines[j] += factors.share * term;
        }
        // from here on each term is less than three quarters of the previous one
        const auto number = static_cast<double>(k);
        const double largest = c.largest * factors.falling[4] * powers[3];
        sum.error = 3 * largest;
        if (k > 3 && z * (number + 1) < 0.75 * (number - 2) && largest < last_term)
            break;
        for (size_t j = 3; j > 0; --j)
            powers[j] = powers[j - 1];
        powers[0] *= z;
    }
    for (size_t j = 0; j <= kOrder; ++j)
        for (size_t i = 0; i + j <= kOrder; ++i)
        {
            sum.cosines.at[i][j] = cosines[j][i];
            sum.sines.at[i][j] = sines[j][i];
        }
}

/// Return upper bounds for the absolute values at a step of z.
const Series& boundsAt(BlendWeights& weights, size_t step)
{
    Series& series = weights.bounds[step];
    if (!weights.has_bounds[step])
    {
        weights.has_bounds[step] = true;
        const double z = 0.5 * static_cast<double>(step) / BlendWeights::kBoundSteps;
        sumSeries<3>(weights.bound_series, z, kBoundTerm, series);
        for (Derivatives* const derivatives : {&series.cosines, &series.sines})
            for (auto& row : derivatives->at)
                for (double& number : row)
                    number = std::abs(number) + series.error;
    }
    return series;
}

HEARTH_INLINE inline void interpolate(const Derivatives& a, const Derivatives& b, double share,
                                      Derivatives& result)
{
    for (size_t i = 0; i < 4; ++i)
        for (size_t j = 0; j < 4; ++j)
            result.at[i][j] = a.at[i][j] + share * (b.at[i][j] - a.at[i][j]);
}

/// Compute upper bounds for the absolute values. They are convex functions of z, because all coefficients
/// have one sign, so the chord between two steps is above them.
HEARTH_INLINE inline void interpolateBounds(BlendWeights& weights, double z, Series& series)
{
    const double at = 2 * BlendWeights::kBoundSteps * z;
    const size_t step = std::min(static_cast<size_t>(at), BlendWeights::kBoundSteps - 1);
    const double share = at - static_cast<double>(step);
    const Series &a = boundsAt(weights, step), &b = boundsAt(weights, step + 1);
    interpolate(a.cosines, b.cosines, share, series.cosines);
    interpolate(a.sines, b.sines, share, series.sines);
}

/// Function of u, with v = u^2, and z: derivatives up to second order, and bounds of third order derivatives.
struct Expansion
{
    double value, u, z, uu, uz, zz;
    double uuu, uuz, uzz, zzz;
};

/// Return the expansion of cos(u arc) / cos(arc / 2); z is the squared sine of half the arc.
Expansion cosines(double u, const Derivatives& s, double max_u, const Derivatives& most)
{
    const double v = u * u, max_v = max_u * max_u;
    return {s.at[0][0],
            2 * u * s.at[1][0],
            s.at[0][1],
            2 * s.at[1][0] + 4 * v * s.at[2][0],
            2 * u * s.at[1][1],
            s.at[0][2],
            max_u * (12 * most.at[2][0] + 8 * max_v * most.at[3][0]),
            2 * most.at[1][1] + 4 * max_v * most.at[2][1],
            2 * max_u * most.at[1][2],
            most.at[0][3]};
}

/// Return the expansion of sin(u arc) / sin(arc / 2) = 2 u sum.
Expansion sines(double u, const Derivatives& s, double max_u, const Derivatives& most)
{
    const double v = u * u, max_v = max_u * max_u;
    return {2 * u * s.at[0][0],
            2 * s.at[0][0] + 4 * v * s.at[1][0],
            2 * u * s.at[0][1],
            2 * u * (6 * s.at[1][0] + 4 * v * s.at[2][0]),
            2 * s.at[0][1] + 4 * v * s.at[1][1],
            2 * u * s.at[0][2],
            12 * most.at[1][0] + 48 * max_v * most.at[2][0] + 16 * max_v * max_v * most.at[3][0],
            2 * max_u * (6 * most.at[1][1] + 4 * max_v * most.at[2][1]),
            2 * most.at[0][2] + 4 * max_v * most.at[1][2],
            2 * max_u * most.at[0][3]};
}

/// Squared sine of half the arc as a polynomial in the two times.
struct SquaredSine
{
    double middle;
    double linear[2];
    double quadratic[2];
    double mixed;
    double remainder;

    double linearNorm() const { return std::abs(linear[0]) + std::abs(linear[1]); }
    double away() const
    {
        return linearNorm() + std::abs(quadratic[0]) + std::abs(quadratic[1]) + std::abs(mixed) + remainder;
    }
};

/// Compute the squared sine. `side` is the sign of `to`.
SquaredSine computeSquaredSine(const TimeCurve& from, const TimeCurve& to, double side)
{
    const auto& a = from.terms;
    const auto& b = to.terms;
    const double left_out = std::abs(dot(a[2], b[1])) + std::abs(dot(a[1], b[2])) + std::abs(dot(a[2], b[2]));
    // clamp: it is never negative for rotations, but may be for fits that are no rotations
    const double middle = 0.5 - 0.5 * side * dot(a[0], b[0]);
    return {std::max(middle, 0.0),
            {-0.5 * side * dot(a[1], b[0]), -0.5 * side * dot(a[0], b[1])},
            {-0.5 * side * dot(a[2], b[0]), -0.5 * side * dot(a[0], b[2])},
            -0.5 * side * dot(a[1], b[1]),
            0.5 * (left_out + from.remainder + to.remainder * (1 + from.remainder)) + std::max(-middle, 0.0) +
                kSlerpRounding};
}

/// Compose the expansion with u, which moves by half_u x2, and the polynomial z.
TaylorModel<1> composeExpansion(const Expansion& f, double half_u, const SquaredSine& z)
{
    const double l0 = z.linear[0], l1 = z.linear[1], linear = z.linearNorm(), away = z.away();
    TaylorModel<1> model;
    const auto set = [&](size_t term, double number) { model.terms[term][0] = number; };
    set(0, f.value);
    set(kFirstLinear, f.z * l0);
    set(kFirstLinear + 1, f.z * l1);
    set(kFirstLinear + 2, f.u * half_u);
    set(termIndex(0, 0), f.z * z.quadratic[0] + 0.5 * f.zz * l0 * l0);
    set(termIndex(1, 1), f.z * z.quadratic[1] + 0.5 * f.zz * l1 * l1);
    set(termIndex(2, 2), 0.5 * f.uu * half_u * half_u);
    set(termIndex(0, 1), f.z * z.mixed + f.zz * l0 * l1);
    set(termIndex(0, 2), f.uz * l0 * half_u);
    set(termIndex(1, 2), f.uz * l1 * half_u);
    model.remainder = std::abs(f.z) * z.remainder + std::abs(f.uz) * half_u * (away - linear) +
                      0.5 * std::abs(f.zz) * (away * away - linear * linear) +
                      f.zzz * away * away * away / 6 + 0.5 * f.uzz * half_u * away * away +
                      0.5 * f.uuz * half_u * half_u * away + f.uuu * half_u * half_u * half_u / 6 +
                      kSlerpRounding;
    return model;
}

/// Add the polynomial of the product, and its remainder.
HEARTH_INLINE inline void addProduct(const TaylorModel<1>& factor, const Four (&of)[kTerms],
                                     Four (&sum)[kTerms], double& remainder)
{
    const auto multiply = [&](size_t one, size_t other, Four& product) HEARTH_INLINE
    { product += factor.terms[one][0] * of[other]; };
    addProducts(multiply, sum);
    const DegreeNorms norms = degreeNorms(of);
    remainder += omittedTerms(degreeNorms(factor), norms) + factor.remainder * norms.all();
}

constexpr size_t kFromTerms[3] = {0, kFirstLinear, termIndex(0, 0)};
constexpr size_t kToTerms[3] = {0, kFirstLinear + 1, termIndex(1, 1)};

/// Set the model to the nearer end. The arc is never longer than a right angle.
void setNearEnd(const TimeCurve& from, const TimeCurve& to, Interval weights, TaylorModel<4>& model)
{
    const bool is_from = weights.high < 1 - weights.low;
    const TimeCurve& end = is_from ? from : to;
    model.terms = {};
    for (size_t degree = 0; degree < 3; ++degree)
        model.terms[is_from ? kFromTerms[degree] : kToTerms[degree]] = end.terms[degree];
    const double share = is_from ? weights.high : 1 - weights.low;
    model.remainder = end.remainder + 2 * std::sin(share * std::numbers::pi / 4) + kSlerpRounding;
}

/// Set the model to S (from + to) / 2 + D (to - from) / 2, at u = weight - 1/2: where the two are near each
/// other, D has a small factor.
HEARTH_INLINE inline void setSlerp(const TimeCurve& from, const TimeCurve& to, double side,
                                   const SquaredSine& square, BlendWeights& weights, TaylorModel<4>& model)
{
    const double u = weights.center, half_u = weights.range.half(), max_u = std::abs(u) + half_u;
    Series here, most;
    sumSeries<2>(weights.middle_series, square.middle, kValueTerm, here);
    interpolateBounds(weights, square.middle + square.away(), most);
    TaylorModel<1> s = composeExpansion(cosines(u, here.cosines, max_u, most.cosines), half_u, square);
    TaylorModel<1> d = composeExpansion(sines(u, here.sines, max_u, most.sines), half_u, square);
    s.remainder += kErrorGain * here.error;
    d.remainder += kErrorGain * here.error;
    Four sum[kTerms] = {}, difference[kTerms] = {}, product[kTerms] = {};
    for (size_t degree = 0; degree < 3; ++degree)
    {
        Four a, b;
        load(from.terms[degree], a);
        load(to.terms[degree], b);
        a *= 0.5;
        b *= 0.5 * side;
        sum[kFromTerms[degree]] += a;
        sum[kToTerms[degree]] += b;
        difference[kFromTerms[degree]] -= a;
        difference[kToTerms[degree]] += b;
    }
    model.remainder = 0;
    addProduct(s, sum, product, model.remainder);
    addProduct(d, difference, product, model.remainder);
    for (size_t term = 0; term < kTerms; ++term)
        store(product[term], model.terms[term]);
    model.remainder += weights.max_from * from.remainder + weights.max_to * to.remainder;
}

/// Return the least squared distance of a weight from 1/2.
double minSquare(Interval weights)
{
    const double least = std::max(0.0, std::abs(weights.middle() - 0.5) - weights.half());
    return least * least;
}

} // namespace

SeriesCoefficients::SeriesCoefficients(double v) : v_(v)
{
    terms_[0] = {Four{1, 0, 0, 0}, 1};
}

void SeriesCoefficients::addTerm()
{
    const Four& c = terms_[count_ - 1].derivatives;
    const TermFactors& factors = kTermFactors[count_ - 1];
    const double a = factors.square - v_;
    const double next[4] = {c[0] * (a * factors.inverse), (c[1] * a - c[0]) * factors.inverse,
                            (c[2] * a - 2 * c[1]) * factors.inverse, (c[3] * a - 3 * c[2]) * factors.inverse};
    terms_[count_++] = {Four{next[0], next[1], next[2], next[3]},
                        std::max({next[0], -next[1], next[2], -next[3]})};
}

// the factor of either end, sin(t arc) / sin(arc), is largest where the arc is a right angle; derivatives by
// v are largest where v is small
BlendWeights::BlendWeights(Interval range_of_weights)
    : range(range_of_weights),
      center(range.middle() - 0.5),
      max_from(std::sin((1 - range.low) * std::numbers::pi / 2)),
      max_to(std::sin(range.high * std::numbers::pi / 2)),
      middle_series(center * center),
      bound_series(minSquare(range))
{
}

BlendWeights& blendWeights(Interval range)
{
    // regions halve the weights a few times, so few ranges exist
    thread_local std::map<std::pair<double, double>, BlendWeights> known;
    return known.try_emplace({range.low, range.high}, range).first->second;
}

void slerpModel(const TimeCurve& from, const TimeCurve& to, BlendWeights& weights, TaylorModel<4>& model)
{
    const double side = dot(from.terms[0], to.terms[0]) < 0 ? -1 : 1;
    const SquaredSine square = computeSquaredSine(from, to, side);
    if (!(square.middle + square.away() < kMaxSquaredSine))
        setNearEnd(from, to, weights.range, model);
    else
        callWithWideVectors([&]() HEARTH_INLINE { setSlerp(from, to, side, square, weights, model); });
}

} // namespace hearth::animation_bounds
