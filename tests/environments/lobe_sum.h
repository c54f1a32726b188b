// Obvious sums that judge the mips of probes: no tree, every texel, many points.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/probes/prefilter.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace hearth::test
{

/// Return the direction of texel i of a mip.
inline Double3 texelDirection(const probes::ProbeMip& mip, size_t i)
{
    const auto face = static_cast<uint32_t>(i / mip.side / mip.side);
    const double x = static_cast<double>(i % mip.side) + 0.5;
    const double y = static_cast<double>(i / mip.side % mip.side) + 0.5;
    return panelDirection(environment::Layout::cube, face, {x / mip.side, y / mip.side});
}

/// Return sum L k dw / sum k dw over `steps` x `steps` points of each texel, with k as the design has it:
/// cos t times the square of alpha / (((1 + cos t) / 2) (alpha^2 - 1) + 1).
inline Double3 sumLobe(const environment::Environment& sky, uint32_t steps, Double3 axis, double roughness)
{
    const double alpha2 = roughness * roughness * roughness * roughness;
    Double3 light;
    double weights = 0;
    const uint32_t rows = sky.height * steps, columns = sky.width * steps;
    std::vector<Double3> equator;
    for (uint32_t x = 0; x < columns; ++x)
    {
        const double longitude = std::numbers::pi - 2 * std::numbers::pi * (x + 0.5) / columns;
        equator.push_back({std::sin(longitude), 0, std::cos(longitude)});
    }
    for (uint32_t y = 0; y < rows; ++y)
    {
        const double height = std::cos(std::numbers::pi * (y + 0.5) / rows),
                     sine = std::sin(std::numbers::pi * (y + 0.5) / rows);
        for (uint32_t x = 0; x < columns; ++x)
        {
            const double cosine = sine * dot(equator[x], axis) + height * axis.y;
            if (cosine <= 0)
                continue;
            const double spread = (1 + cosine) / 2 * (alpha2 - 1) + 1;
            const double weight = cosine * alpha2 / (spread * spread) * sine;
            light = light + widen(sky.texels[sky.index(0, x / steps, y / steps)]) * weight;
            weights += weight;
        }
    }
    return light * (1 / weights);
}

/// Return the mean of a mip over the sphere.
inline Double3 averageMip(const probes::ProbeMip& mip)
{
    const environment::Environment faces{environment::Layout::cube, mip.side, mip.side, {}};
    Double3 sum;
    for (size_t i = 0; i < mip.texels.size(); ++i)
        sum =
            sum + mip.texels[i] * panelSolidAngle(environment::Layout::cube,
                                                  faces.area(static_cast<uint32_t>(i % mip.side),
                                                             static_cast<uint32_t>(i / mip.side % mip.side)));
    return sum * (1 / (4 * std::numbers::pi));
}

} // namespace hearth::test
