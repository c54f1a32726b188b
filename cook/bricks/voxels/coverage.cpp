// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/coverage.h"

#include <limits>

namespace hearth::bricks
{

namespace
{

constexpr double kRow = kSamplesPerEdge;

} // namespace

uint64_t coveredSamples(const Polygon& piece, const Cell& cell, int axis)
{
    const int u_axis = uAxis(axis), v_axis = vAxis(axis);
    const double u0 = cell[static_cast<size_t>(u_axis)], v0 = cell[static_cast<size_t>(v_axis)];
    // index of the first sample at or above a coordinate
    const auto firstFrom = [](double place)
    { return static_cast<int>(std::clamp(std::ceil(place * kRow - 0.5), 0.0, kRow)); };
    const std::array<double, 2> rows = piece.span(v_axis);
    uint64_t coverage = 0;
    for (int row = firstFrom(rows[0] - v0); row < firstFrom(rows[1] - v0); ++row)
    {
        const double v = v0 + (row + 0.5) / kRow;
        double min_u = std::numeric_limits<double>::infinity(), max_u = -min_u;
        for (uint32_t i = 0; i < piece.count; ++i)
        {
            const Double3& p = piece.points[i];
            const Double3& q = piece.points[i + 1 < piece.count ? i + 1 : 0];
            const bool p_below = coordinate(p, v_axis) <= v;
            if (p_below == (coordinate(q, v_axis) <= v))
                continue;
            const Double3& low = p_below ? p : q;
            const Double3& high = p_below ? q : p;
            const double t =
                (v - coordinate(low, v_axis)) / (coordinate(high, v_axis) - coordinate(low, v_axis));
            const double u =
                coordinate(low, u_axis) + (coordinate(high, u_axis) - coordinate(low, u_axis)) * t;
            min_u = std::min(min_u, u);
            max_u = std::max(max_u, u);
        }
        if (!(min_u < max_u))
            continue;
        const int first = firstFrom(min_u - u0), end = firstFrom(max_u - u0);
        const uint64_t run = ((uint64_t{1} << end) - 1) & ~((uint64_t{1} << first) - 1);
        coverage |= run << (row * static_cast<int>(kSamplesPerEdge));
    }
    return coverage;
}

} // namespace hearth::bricks
