// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/probes/sharp_mips.h"

#include <tbb/parallel_for.h>

namespace hearth::probes
{

namespace
{

using environment::Environment;
using environment::Layout;

// Points of a texel along each axis: a texel covers fewer than three of an environment with up to 4096
// columns.
constexpr uint32_t kPoints = 4;

Double3 averageTexel(const Environment& environment, uint32_t side, uint32_t face, uint32_t x, uint32_t y)
{
    Double3 sum{};
    for (uint32_t row = 0; row < kPoints; ++row)
        for (uint32_t column = 0; column < kPoints; ++column)
        {
            const double u = (x + (column + 0.5) / kPoints) / side, v = (y + (row + 0.5) / kPoints) / side;
            const Double3 direction = panelDirection(Layout::cube, face, {u, v});
            sum = sum + widen(environment.texels[findTexel(environment, direction)]);
        }
    return sum * (1.0 / (kPoints * kPoints));
}

} // namespace

uint32_t countSharpMips(const Environment& environment, uint32_t side, uint32_t max_side)
{
    const uint32_t own = environment.layout == Layout::cube ? environment.width : environment.width / 4;
    uint32_t mips = 0;
    while (side << (mips + 1) <= std::min(own, max_side))
        ++mips;
    return mips;
}

ProbeMip averageSharply(const Environment& environment, double scale, uint32_t side)
{
    ProbeMip mip{side, std::vector<Double3>(size_t{6} * side * side)};
    tbb::parallel_for(uint32_t{0}, 6 * side,
                      [&](uint32_t row)
                      {
                          for (uint32_t x = 0; x < side; ++x)
                              mip.texels[size_t{row} * side + x] =
                                  averageTexel(environment, side, row / side, x, row % side) * scale;
                      });
    return mip;
}

} // namespace hearth::probes
