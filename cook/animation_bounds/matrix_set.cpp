// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/animation_bounds/matrix_set.h"

#include "cook/animation_bounds/box.h"
#include "cook/animation_bounds/symmetric.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hearth::animation_bounds
{

namespace
{

Affine3d difference(const Affine3d& a, const Affine3d& b)
{
    Affine3d d;
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 4; ++j)
            d.m[i][j] = a.m[i][j] - b.m[i][j];
    return d;
}

/// Return the middle of the bounding box, in twelve dimensions, of the matrices.
Affine3d boxCenter(const std::vector<Affine3d>& matrices)
{
    Affine3d middle;
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 4; ++j)
        {
            Interval range;
            for (const Affine3d& matrix : matrices)
                range.add(matrix.m[i][j]);
            middle.m[i][j] = range.middle();
        }
    return middle;
}

/// Limit the slack by `norm`: no member of a set has a larger operator norm. Where linear_slack exceeds it,
/// replace the matrices by the constant image of the pivot, with a ball of that slack around it.
void limitSlack(MatrixSet& set)
{
    if (set.linear_slack <= set.norm)
        return;
    for (Affine3d& matrix : set.hull)
    {
        const Double3 place = transformPoint(matrix, set.pivot);
        matrix = {{{0, 0, 0, place.x}, {0, 0, 0, place.y}, {0, 0, 0, place.z}}};
    }
    set.linear_slack = set.norm;
    set.hull_norm = 0;
}

/// Return the point for which the matrices' squared displacements have the smallest sum, or the set's pivot.
Double3 leastMovedPoint(const MatrixSet& set)
{
    // solve sum of A^T (A x + b) = 0 for the matrices minus the unit matrix, with linear part A and
    // translation b
    Affine3d normal{};
    for (auto& row : normal.m)
        std::fill(std::begin(row), std::end(row), 0.0);
    for (const Affine3d& matrix : set.hull)
    {
        const Affine3d d = difference(matrix, Affine3d{});
        for (size_t i = 0; i < 3; ++i)
            for (size_t j = 0; j < 4; ++j)
                for (size_t k = 0; k < 3; ++k)
                    normal.m[i][j] += d.m[k][i] * d.m[k][j];
    }
    // regularise: rotations about one axis leave a line unmoved; choose its point nearest to the pivot
    double trace = 0;
    for (size_t i = 0; i < 3; ++i)
        trace += normal.m[i][i];
    const double hold = 1e-6 * trace;
    const double pivot[3] = {set.pivot.x, set.pivot.y, set.pivot.z};
    for (size_t i = 0; i < 3; ++i)
    {
        normal.m[i][i] += hold;
        normal.m[i][3] -= hold * pivot[i];
    }
    const std::optional<Affine3d> solution = inverted(normal);
    return solution ? Double3{solution->m[0][3], solution->m[1][3], solution->m[2][3]} : set.pivot;
}

double shiftAt(const MatrixSet& set, Double3 point)
{
    double shift = 0;
    for (const Affine3d& matrix : set.hull)
        shift = std::max(shift, length(transformPoint(matrix, point) - point));
    return shift + set.linear_slack * length(point - set.pivot) + set.point_slack;
}

} // namespace

MatrixSet singletonSet(const Affine3d& transform)
{
    const double norm = operatorNorm(transform);
    return {{transform}, norm, norm, {}, 0, 0};
}

MatrixSet composeSets(const MatrixSet& second, const MatrixSet& first)
{
    MatrixSet set;
    set.hull.reserve(second.hull.size() * first.hull.size());
    for (const Affine3d& after : second.hull)
        for (const Affine3d& before : first.hull)
            set.hull.push_back(after * before);
    set.norm = second.norm * first.norm;
    set.hull_norm = second.hull_norm * first.hull_norm;
    set.pivot = first.pivot;
    double away = 0; // from the second pivot to the image of the first pivot
    for (const Affine3d& before : first.hull)
        away = std::max(away, length(transformPoint(before, first.pivot) - second.pivot));
    // D2 D1 x = C2 C1 x + E2 (C1 x) + D2 E1 x, for members D = C + E
    set.linear_slack = second.linear_slack * first.hull_norm + second.norm * first.linear_slack;
    set.point_slack = second.linear_slack * away + second.point_slack + second.norm * first.point_slack;
    limitSlack(set);
    return set;
}

MatrixBall boundingBall(const MatrixSet& set)
{
    MatrixBall ball{boxCenter(set.hull), set.pivot, 0, 0};
    for (const Affine3d& matrix : set.hull)
    {
        const Affine3d away = difference(matrix, ball.center);
        ball.linear_slack = std::max(ball.linear_slack, operatorNorm(away));
        ball.point_slack = std::max(ball.point_slack, length(transformPoint(away, set.pivot)));
    }
    ball.linear_slack += set.linear_slack;
    ball.point_slack += set.point_slack;
    return ball;
}

IdentityDeviation computeIdentityDeviation(const MatrixSet& set)
{
    IdentityDeviation departure;
    for (const Affine3d& matrix : set.hull)
        departure.rotation = std::max(departure.rotation, operatorNorm(difference(matrix, Affine3d{})));
    departure.rotation += set.linear_slack;
    const Double3 still = leastMovedPoint(set);
    const double shift_of_still = shiftAt(set, still);
    const double shift_of_pivot = shiftAt(set, set.pivot);
    departure.pivot = shift_of_still < shift_of_pivot ? still : set.pivot;
    departure.shift = std::min(shift_of_still, shift_of_pivot);
    return departure;
}

} // namespace hearth::animation_bounds
