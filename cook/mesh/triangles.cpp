// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/mesh/triangles.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hearth::mesh
{

namespace
{

/// True if the sum of the numbers is exactly zero. Adds them one by one to an expansion of non-overlapping
/// parts (J. R. Shewchuk, "Adaptive precision floating-point arithmetic", 1997, Grow-Expansion).
template <size_t N>
bool sumIsZero(const std::array<double, N>& numbers)
{
    std::array<double, N> parts{};
    size_t part_count = 0;
    for (double carry : numbers)
    {
        size_t kept = 0;
        for (size_t i = 0; i < part_count; ++i)
        {
            // two-sum: sum + rest is exactly carry + parts[i]
            const double sum = carry + parts[i];
            const double virtual_part = sum - carry;
            const double rest = (carry - (sum - virtual_part)) + (parts[i] - virtual_part);
            if (rest != 0)
                parts[kept++] = rest;
            carry = sum;
        }
        if (carry != 0)
            parts[kept++] = carry;
        part_count = kept;
    }
    return part_count == 0;
}

/// True if the signed area of the triangle in the plane of two coordinates is zero. The six products of two
/// floats are exact doubles, without overflow or underflow.
bool areaIsZero(double ax, double ay, double bx, double by, double cx, double cy)
{
    return sumIsZero<6>({ax * by, -ay * bx, bx * cy, -by * cx, cx * ay, -cy * ax});
}

/// True if u1 * v2 - u2 * v1 is certainly not zero, despite the rounding of its inputs and result.
bool isCertainlyNonzero(double u1, double v2, double u2, double v1)
{
    // at most 8 roundings of relative size 2^-53 on each product
    constexpr double kRounding = 8.0 / 9007199254740992.0;
    const double first = u1 * v2;
    const double second = u2 * v1;
    return std::abs(first - second) > kRounding * (std::abs(first) + std::abs(second));
}

} // namespace

bool isDegenerate(Float3 a, Float3 b, Float3 c)
{
    const double ux = double{b.x} - a.x, uy = double{b.y} - a.y, uz = double{b.z} - a.z;
    const double vx = double{c.x} - a.x, vy = double{c.y} - a.y, vz = double{c.z} - a.z;
    if (isCertainlyNonzero(ux, vy, uy, vx) || isCertainlyNonzero(uy, vz, uz, vy) ||
        isCertainlyNonzero(uz, vx, ux, vz))
        return false;
    return areaIsZero(a.x, a.y, b.x, b.y, c.x, c.y) && areaIsZero(a.y, a.z, b.y, b.z, c.y, c.z) &&
           areaIsZero(a.z, a.x, b.z, b.x, c.z, c.x);
}

std::vector<OpenEdge> openEdges(std::span<const uint32_t> positions)
{
    struct Use
    {
        uint64_t edge; ///< smaller position id in the high half
        int32_t direction;
    };
    std::vector<Use> uses;
    uses.reserve(positions.size());
    for (size_t t = 0; t + 2 < positions.size(); t += 3)
        for (size_t k = 0; k < 3; ++k)
        {
            const uint32_t from = positions[t + k];
            const uint32_t to = positions[t + (k + 1) % 3];
            const auto [low, high] = std::minmax(from, to);
            uses.push_back({uint64_t{low} << 32 | high, from < to ? 1 : -1});
        }
    std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) { return a.edge < b.edge; });

    std::vector<OpenEdge> open;
    for (size_t i = 0; i < uses.size();)
    {
        const uint64_t edge = uses[i].edge;
        int32_t surplus = 0;
        for (; i < uses.size() && uses[i].edge == edge; ++i)
            surplus += uses[i].direction;
        const auto low = static_cast<uint32_t>(edge >> 32);
        const auto high = static_cast<uint32_t>(edge);
        if (surplus > 0)
            open.push_back({low, high, surplus});
        else if (surplus < 0)
            open.push_back({high, low, -surplus});
    }
    std::sort(open.begin(), open.end());
    return open;
}

} // namespace hearth::mesh
