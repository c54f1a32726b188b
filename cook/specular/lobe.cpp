// Integrates a GGX lobe over a cone in slope space. A half-vector h along p = (x, y, 1) has the slope (x, y).
// Mirroring the view at h gives a direction in the cone about d if
// 2 (V.p) (p.d) >= (V.d + cos half_angle) p.p: at a fixed y a quadratic inequality for x. So the integral
// over slopes runs over intervals with closed ends, and its outer integral breaks only where these ends meet.
// Gauss-Legendre quadrature integrates both to six digits with a few hundred points, however narrow the lobe.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/specular/lobe.h"

#include "cook/specular/gauss_legendre.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numbers>
#include <optional>

namespace hearth::specular
{

namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Interval
{
    double low;
    double high;
};

/// Disjoint intervals, ascending; empty ones have low >= high.
using Intervals = std::array<Interval, 2>;

Interval overlap(Interval a, Interval b)
{
    return {std::max(a.low, b.low), std::min(a.high, b.high)};
}

/// Solve a x^2 + 2 b x + c >= 0.
Intervals solveNotNegative(double a, double b, double c)
{
    constexpr Interval kEmpty{0, 0};
    constexpr Interval kAllReals{-kInfinity, kInfinity};
    const double discriminant = b * b - a * c;
    if (discriminant <= 0)
        return {a > 0 || (a == 0 && c >= 0) ? kAllReals : kEmpty, kEmpty};
    // the form without cancellation
    const double sum = -(b + std::copysign(std::sqrt(discriminant), b));
    const double first = c / sum;
    if (a == 0)
        return {b > 0 ? Interval{first, kInfinity} : Interval{-kInfinity, first}, kEmpty};
    const double second = sum / a;
    const Interval between{std::min(first, second), std::max(first, second)};
    if (a < 0)
        return {between, kEmpty};
    return {Interval{-kInfinity, between.low}, Interval{between.high, kInfinity}};
}

/// Lobe in slope space: y = alpha tan(tau), x = alpha tan(s) / cos(tau), which turns GGX's density into
/// cos(tau) cos(s)^2 / pi.
class SlopeLobe
{
public:
    explicit SlopeLobe(const Lobe& lobe)
        : alpha_(lobe.roughness * lobe.roughness),
          view_x_(-std::sin(lobe.theta_o)),
          view_z_(std::max(std::cos(lobe.theta_o), 0.0)),
          masking_(lobe.masking)
    {
        const double tangent = -view_x_ / view_z_; // may be infinite
        view_masking_ = 0.5 + 0.5 * std::sqrt(1 + alpha_ * alpha_ * tangent * tangent);
    }

    double alpha() const { return alpha_; }
    /// Return Schlick's Fresnel term without f0 at a slope: (1 - V.h)^5.
    double schlick(double x, double y) const
    {
        return std::pow(std::max(1 - (view_x_ * x + view_z_) / std::sqrt(x * x + y * y + 1), 0.0), 5);
    }
    /// Return the direction of light that a slope reflects to the view.
    Double3 light(double x, double y) const
    {
        const double twice = 2 * (view_x_ * x + view_z_) / (x * x + y * y + 1);
        return {twice * x - view_x_, twice * y, twice - view_z_};
    }
    /// Return what turns an integral of weight() into a share of the light: pi cos(V) (1 + Lambda(V)), in a
    /// form that stays finite at grazing views.
    double norm() const
    {
        const double stretched = std::sqrt(view_z_ * view_z_ + alpha_ * alpha_ * view_x_ * view_x_);
        return std::numbers::pi * 0.5 * (view_z_ + stretched);
    }
    double viewX() const { return view_x_; }
    double viewZ() const { return view_z_; }

    /// Return the slopes whose mirror direction is above the horizon; |y| is at most 1 / viewZ().
    Interval aboveHorizon(double y) const
    {
        const double root = std::sqrt(std::max(1 - view_z_ * view_z_ * y * y, 0.0));
        return {(view_x_ - root) / view_z_, view_z_ * (1 - y * y) / (root - view_x_)};
    }

    /// Compute the weight of a slope above the horizon: (V.h) / cos(theta_h) G2 / G1(V).
    double weight(double x, double y) const
    {
        const double facing = view_x_ * x + view_z_;
        const double cosine = 2 * facing / (x * x + y * y + 1) - view_z_;
        if (!(facing > 0) || !(cosine > 0))
            return 0; // ends of an interval are rounded
        const double cosine2 = cosine * cosine;
        const double stretched = std::sqrt(cosine2 + alpha_ * alpha_ * std::max(1 - cosine2, 0.0));
        if (masking_ == Masking::separable)
            return facing * 2 * cosine / (cosine + stretched);
        const double shadowing = (stretched - cosine) / (2 * cosine);
        return facing / (1 + shadowing / view_masking_);
    }

private:
    double alpha_;
    double view_x_;
    double view_z_;
    double view_masking_; ///< 1 + Lambda(V)
    Masking masking_;
};

/// Cone in slope space.
class SlopeCone
{
public:
    SlopeCone(const SlopeLobe& lobe, const Double3& axis, double half_angle)
        : view_x_(lobe.viewX()),
          view_z_(lobe.viewZ()),
          axis_(axis),
          cosine_(std::cos(half_angle)),
          level_(view_x_ * axis.x + view_z_ * axis.z + cosine_)
    {
    }

    Intervals slopes(double y) const
    {
        const double across = axis_.y * y + axis_.z;
        return solveNotNegative(2 * view_x_ * axis_.x - level_, view_x_ * across + view_z_ * axis_.x,
                                2 * view_z_ * across - level_ * (1 + y * y));
    }

    /// Return each y at which intervals appear, vanish or meet, or at which the cone's edge crosses the
    /// horizon.
    std::vector<double> breaks() const
    {
        std::vector<double> found;
        const double turned = view_x_ * axis_.z - view_z_ * axis_.x;
        const double rest = level_ * (2 * view_x_ * axis_.x - level_);
        // the discriminant of slopes(y) is a quadratic in y: its sign changes at the ends of these intervals
        const Intervals real = solveNotNegative(view_x_ * view_x_ * axis_.y * axis_.y + rest,
                                                view_x_ * axis_.y * turned + level_ * view_z_ * axis_.y,
                                                turned * turned + 2 * level_ * view_z_ * axis_.z + rest);
        for (const Interval& interval : real)
            found.insert(found.end(), {interval.low, interval.high});
        const double level_length2 = axis_.x * axis_.x + axis_.y * axis_.y;
        const double away2 = level_length2 - cosine_ * cosine_;
        if (away2 > 0 && view_z_ > 0)
        {
            const double along = axis_.y * cosine_ / level_length2;
            const double side = axis_.x * std::sqrt(away2) / level_length2;
            found.insert(found.end(), {(along + side) / view_z_, (along - side) / view_z_});
        }
        return found;
    }

private:
    double view_x_;
    double view_z_;
    Double3 axis_;
    double cosine_;
    double level_;
};

class Quadrature
{
public:
    Quadrature(const SlopeLobe& lobe, QuadratureOrder order)
        : lobe_(lobe), outer_(gaussLegendre(order.outer)), inner_(gaussLegendre(order.inner))
    {
    }

    double total() const
    {
        return total([&](double x, double y) { return lobe_.weight(x, y); });
    }

    template <typename Weight>
    double total(const Weight& weight) const
    {
        const double end = slopeAngle(1 / lobe_.viewZ());
        return 2 * piece(
                       0, end,
                       [&](double y) {
                           return Intervals{lobe_.aboveHorizon(y), Interval{0, 0}};
                       },
                       weight);
    }

    double inside(const SlopeCone& cone, bool symmetric) const
    {
        const double end = slopeAngle(1 / lobe_.viewZ());
        const double start = symmetric ? 0 : -end;
        std::vector<double> ends{start, end};
        for (const double y : cone.breaks())
            if (const double tau = slopeAngle(y); tau > start && tau < end)
                ends.push_back(tau);
        std::sort(ends.begin(), ends.end());
        const auto intervalsAt = [&](double y)
        {
            const Interval horizon = lobe_.aboveHorizon(y);
            Intervals intervals = cone.slopes(y);
            for (Interval& interval : intervals)
                interval = overlap(interval, horizon);
            return intervals;
        };
        double sum = 0;
        for (size_t i = 0; i + 1 < ends.size(); ++i)
            sum += piece(ends[i], ends[i + 1], intervalsAt,
                         [&](double x, double y) { return lobe_.weight(x, y); });
        return symmetric ? 2 * sum : sum;
    }

private:
    double slopeAngle(double y) const { return std::atan(y / lobe_.alpha()); }

    /// Integrate over tau in [low, high]. Intervals that appear or vanish at its ends do so as square roots:
    /// substituting a sine, with its flat ends, makes them smooth.
    template <typename IntervalsAt, typename Weight>
    double piece(double low, double high, const IntervalsAt& intervalsAt, const Weight& weight) const
    {
        const double middle = (low + high) / 2;
        const double half = (high - low) / 2;
        double sum = 0;
        for (const QuadraturePoint& point : outer_)
        {
            const double angle = std::numbers::pi / 2 * point.at;
            const double tau = middle + half * std::sin(angle);
            const double y = lobe_.alpha() * std::tan(tau);
            const double scale = lobe_.alpha() / std::cos(tau);
            double row = 0;
            for (const Interval& interval : intervalsAt(y))
                if (interval.low < interval.high)
                    row += along(std::atan(interval.low / scale), std::atan(interval.high / scale),
                                 [&](double tangent) { return weight(scale * tangent, y); });
            sum += point.weight * std::numbers::pi / 2 * std::cos(angle) * std::cos(tau) * row;
        }
        return half * sum;
    }

    template <typename Weight>
    double along(double low, double high, const Weight& weight) const
    {
        const double middle = (low + high) / 2;
        const double half = (high - low) / 2;
        double sum = 0;
        for (const QuadraturePoint& point : inner_)
        {
            const double tangent = std::tan(middle + half * point.at);
            sum += point.weight * weight(tangent) / (1 + tangent * tangent);
        }
        return half * sum;
    }

    const SlopeLobe& lobe_;
    std::vector<QuadraturePoint> outer_;
    std::vector<QuadraturePoint> inner_;
};

} // namespace

void computeOcclusions(const Lobe& lobe, const Double3& axis, std::span<const double> half_angles,
                       std::span<double> out, QuadratureOrder order)
{
    HEARTH_ASSERT(half_angles.size() == out.size());
    const SlopeLobe slopes(lobe);
    const Quadrature quadrature(slopes, order);
    const double total = quadrature.total();
    for (size_t i = 0; i < out.size(); ++i)
    {
        const double inside = quadrature.inside(SlopeCone(slopes, axis, half_angles[i]), axis.y == 0);
        out[i] = std::clamp(inside / total, 0.0, 1.0);
    }
}

double computeOcclusion(const Lobe& lobe, const Cone& cone, QuadratureOrder order)
{
    double share = 0;
    computeOcclusions(lobe, cone.axis, {&cone.half_angle, 1}, {&share, 1}, order);
    return share;
}

LobeMoments computeMoments(const Lobe& lobe, QuadratureOrder order)
{
    const SlopeLobe slopes(lobe);
    const Quadrature quadrature(slopes, order);
    const auto integrate = [&](auto&& factor)
    { return quadrature.total([&](double x, double y) { return slopes.weight(x, y) * factor(x, y); }); };
    const double all = quadrature.total();
    const double bias = integrate([&](double x, double y) { return slopes.schlick(x, y); });
    const double along = integrate([&](double x, double y) { return slopes.light(x, y).x; });
    const double up = integrate([&](double x, double y) { return slopes.light(x, y).z; });
    return {(all - bias) / slopes.norm(), bias / slopes.norm(), {along / all, 0, up / all}};
}

} // namespace hearth::specular
