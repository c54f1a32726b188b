// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/etc2/planar_search.h"

#include "cook/texels/etc2/base_sweep.h"

#include <algorithm>

namespace hearth::texels
{

namespace
{

/// Channel of a block with its sums.
struct ChannelPlane
{
    std::array<int32_t, 16> codes;
    int32_t sum = 0;
    int32_t slope_x = 0; ///< sum of codes times -3, -1, 1, 3 by column
    int32_t slope_y = 0; ///< the same by row
    int32_t squares = 0;
};

ChannelPlane gatherPlane(const Block8& block, size_t channel)
{
    ChannelPlane plane;
    for (int32_t y = 0; y < 4; ++y)
        for (int32_t x = 0; x < 4; ++x)
        {
            const auto t = static_cast<size_t>(4 * y + x);
            const int32_t code = block[t][channel];
            plane.codes[t] = code;
            plane.sum += code;
            plane.slope_x += code * (2 * x - 3);
            plane.slope_y += code * (2 * y - 3);
            plane.squares += code * code;
        }
    return plane;
}

/// Return 80 times the least sum of squares of any plane, by the sums' orthogonality.
int64_t leastSquares80(const ChannelPlane& plane)
{
    return int64_t{80} * plane.squares - int64_t{5} * plane.sum * plane.sum -
           int64_t{plane.slope_x} * plane.slope_x - int64_t{plane.slope_y} * plane.slope_y;
}

int32_t planeError(const ChannelPlane& plane, const PlanarCodes& codes, int bits)
{
    const int32_t origin = widenCode(codes[0], bits);
    const int32_t right = widenCode(codes[1], bits) - origin, below = widenCode(codes[2], bits) - origin;
    int32_t error = 0;
    for (int32_t y = 0; y < 4; ++y)
        for (int32_t x = 0; x < 4; ++x)
        {
            const int32_t value = std::clamp((x * right + y * below + 4 * origin + 2) >> 2, 0, 255);
            const int32_t difference = plane.codes[static_cast<size_t>(4 * y + x)] - value;
            error += difference * difference;
        }
    return error;
}

/// Find codes from the plane of least squares, by changing one code or two by one while that lowers the
/// error.
/// returns  codes, their error
std::pair<PlanarCodes, int32_t> fitPlane(const ChannelPlane& plane, int bits, Effort effort)
{
    const int32_t maximum = (1 << bits) - 1;
    const int32_t origin = 5 * plane.sum - 3 * (plane.slope_x + plane.slope_y); // times 80, as are the next
    PlanarCodes codes{nearestCode(std::max(origin, 0), 80, bits),
                      nearestCode(std::max(origin + 8 * plane.slope_x, 0), 80, bits),
                      nearestCode(std::max(origin + 8 * plane.slope_y, 0), 80, bits)};
    int32_t error = planeError(plane, codes, bits);
    if (effort == Effort::draft)
        return {codes, error};
    constexpr std::array<PlanarCodes, 9> kDirections{{{1, 0, 0},
                                                      {0, 1, 0},
                                                      {0, 0, 1},
                                                      {1, -1, 0},
                                                      {1, 0, -1},
                                                      {0, 1, -1},
                                                      {1, 1, 0},
                                                      {1, 0, 1},
                                                      {0, 1, 1}}};
    for (bool is_better = error > 0; is_better;)
    {
        is_better = false;
        for (const PlanarCodes& direction : kDirections)
            for (const int32_t sign : {-1, 1})
            {
                PlanarCodes trial = codes;
                bool is_code = true;
                for (size_t p = 0; p < 3; ++p)
                {
                    trial[p] += sign * direction[p];
                    is_code = is_code && trial[p] >= 0 && trial[p] <= maximum;
                }
                if (!is_code)
                    continue;
                const int32_t trial_error = planeError(plane, trial, bits);
                if (trial_error >= error)
                    continue;
                codes = trial;
                error = trial_error;
                is_better = true;
            }
    }
    return {codes, error};
}

/// True if a plane may have less error than a limit. Rounding of 16 texels' channels moves the root of the
/// error by at most sqrt(16 * 3 / 4) < 4 (times that of the greatest weight).
bool mayBeBelow(int64_t least80, int32_t limit, const ColorWeights& weights)
{
    const int64_t greatest = *std::max_element(weights.begin(), weights.end());
    // sqrt(least) < sqrt(limit) + 4 sqrt(w)  <=>  least - limit - 16 w < 8 sqrt(w limit)
    const int64_t excess = least80 / 80 - limit - 16 * greatest;
    return excess < 0 || excess * excess < 64 * greatest * limit;
}

} // namespace

PlanarSolution searchPlanar(const Block8& block, const ColorWeights& weights, Effort effort, int32_t limit)
{
    std::array<ChannelPlane, 3> planes;
    int64_t least80 = 0;
    for (size_t c = 0; c < 3; ++c)
    {
        planes[c] = gatherPlane(block, c);
        least80 += weights[c] * leastSquares80(planes[c]);
    }
    PlanarSolution solution;
    if (!mayBeBelow(least80, limit, weights))
        return solution;
    solution.error = 0;
    for (size_t c = 0; c < 3; ++c)
    {
        const auto [codes, error] = fitPlane(planes[c], c == 1 ? 7 : 6, effort);
        solution.channels[c] = codes;
        solution.error += weights[c] * error;
    }
    return solution;
}

} // namespace hearth::texels
