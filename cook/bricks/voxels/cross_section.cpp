// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/cross_section.h"

#include <limits>

namespace hearth::bricks
{

namespace
{

constexpr double kRow = kSampleRow;

} // namespace

uint64_t hiddenSamples(const Polygon& piece, const Cell& cell, int axis)
{
    const int u_axis = uAxis(axis), v_axis = vAxis(axis);
    const double u0 = cell[static_cast<size_t>(u_axis)], v0 = cell[static_cast<size_t>(v_axis)];
    // index of the first sample at or above a coordinate
    const auto firstFrom = [](double place)
    { return static_cast<int>(std::clamp(std::ceil(place * kRow - 0.5), 0.0, kRow)); };
    const std::array<double, 2> rows = piece.span(v_axis);
    uint64_t hidden = 0;
    for (int row = firstFrom(rows[0] - v0); row < firstFrom(rows[1] - v0); ++row)
    {
        const double v = v0 + (row + 0.5) / kRow;
        double least = std::numeric_limits<double>::infinity(), most = -least;
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
            least = std::min(least, u);
            most = std::max(most, u);
        }
        if (!(least < most))
            continue;
        const int first = firstFrom(least - u0), end = firstFrom(most - u0);
        const uint64_t run = ((uint64_t{1} << end) - 1) & ~((uint64_t{1} << first) - 1);
        hidden |= run << (row * static_cast<int>(kSampleRow));
    }
    return hidden;
}

} // namespace hearth::bricks
