// Taylor model of the slerp of two rotations that are functions of time.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/animation_bounds/taylor_model.h"
#include "cook/animation_bounds/time_curve.h"

namespace hearth::animation_bounds
{

/// Return the model of any rotation: each is within 1 of the quaternion 0.
inline TaylorModel<4> anyRotation()
{
    TaylorModel<4> any;
    any.remainder = 1;
    return any;
}

/// Coefficients c_k(v) of a series in z, with derivatives by v: c_0 = 1 and
/// c_(k+1) = c_k ((k + 1/2)^2 - v) / ((k + 1/2) (k + 1)), for v in [0, 1/4]. Computed on first use.
class SeriesCoefficients
{
public:
    struct Term
    {
        Four derivatives; ///< by v, of order 0 to 3; they alternate in sign
        double largest;   ///< maximum absolute value
    };
    static constexpr size_t kMaxTerms = 150;

    explicit SeriesCoefficients(double v);

    /// Return the term k, below kMaxTerms; all before must have been asked for.
    const Term& term(size_t k)
    {
        if (k == count_)
            addTerm();
        return terms_[k];
    }

private:
    void addTerm();

    double v_;
    size_t count_ = 1;
    std::array<Term, kMaxTerms> terms_;
};

/// Derivatives by v and z up to third order in total: at[i][j] is d^(i+j) / dv^i dz^j.
struct Derivatives
{
    double at[4][4] = {};
};

/// Sums over k of c_k(v) z^k, and the same divided by 2 k + 1, for z in [0, 1/2].
struct Series
{
    Derivatives cosines;
    Derivatives sines;
    double error; ///< maximum error of all of them
};

/// Range of weights with the numbers of slerpModel that depend on it alone.
struct BlendWeights
{
    /// Number of steps from z = 0 to 1/2 between which bounds are interpolated.
    static constexpr size_t kBoundSteps = 32;

    explicit BlendWeights(Interval range);

    Interval range;
    double center;   ///< of the range, minus 1/2
    double max_from; ///< maximum change of the blend, by the change of either end
    double max_to;
    SeriesCoefficients middle_series;           ///< at the center
    SeriesCoefficients bound_series;            ///< where derivatives are largest
    std::array<Series, kBoundSteps + 1> bounds; ///< of bound_series; valid where has_bounds is set
    std::array<bool, kBoundSteps + 1> has_bounds{};
};

/// Return the weights of a range. They are kept for the thread's later calls.
BlendWeights& blendWeights(Interval range);

/// Compute slerp(from, to, w) as a quaternion of length 1, with either sign. x0 is the time of `from`, x1 the
/// time of `to`, x2 goes from the low weight to the high one. Where the two may be half a turn apart, the
/// shorter arc is ambiguous; the result is then the nearer end, with a remainder as large as the weights
/// allow.
/// source  sines of fractions of the arc as hypergeometric series in the squared sine of half the arc. They
///         have no pole where the two rotations are equal; all coefficients have one sign, so derivatives are
///         largest at the far corner.
void slerpModel(const TimeCurve& from, const TimeCurve& to, BlendWeights& weights, TaylorModel<4>& model);

} // namespace hearth::animation_bounds
