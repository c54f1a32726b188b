// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/reflections/capture/specks.h"

#include "formats/scene/scene_lighting.h"

#include <algorithm>
#include <vector>

namespace hearth::reflections
{

namespace
{

/// Distance in texels over which a speck is spread, and how many times the median around it makes one.
constexpr int kSpread = 4;
constexpr float kSpeck = 3;
/// Bright texels around a speck, of so many: where there are more the surface is bright.
constexpr size_t kMaxBrightOf = 3;

/// Return the texels about a place, as far as the face goes.
std::vector<size_t> placesAround(int x, int y, int side)
{
    std::vector<size_t> places;
    for (int row = std::max(y - kSpread, 0); row <= std::min(y + kSpread, side - 1); ++row)
        for (int column = std::max(x - kSpread, 0); column <= std::min(x + kSpread, side - 1); ++column)
            places.push_back(static_cast<size_t>(row * side + column));
    return places;
}

/// Return the share of its light that a texel keeps: 1 unless it is a speck.
/// around  luminances of the texels about it; its order changes
float keptShare(float own, std::vector<float>& around)
{
    const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
    std::nth_element(around.begin(), middle, around.end());
    const float median = *middle, limit = kSpeck * median;
    const auto bright =
        static_cast<size_t>(std::ranges::count_if(around, [limit](float value) { return value > limit; }));
    // where most texels meet the sky there is no bounced light, and no median
    return median > 0 && own > limit && kMaxBrightOf * bright <= around.size() ? median / own : 1;
}

} // namespace

void spreadSpecks(std::span<Float3> light, uint32_t side)
{
    std::vector<Float3> spread(light.size());
    const auto count = static_cast<int>(side);
    for (int y = 0; y < count; ++y)
        for (int x = 0; x < count; ++x)
        {
            const std::vector<size_t> places = placesAround(x, y, count);
            std::vector<float> around;
            for (const size_t place : places)
                around.push_back(shared::luminance(light[place]));
            const auto at = static_cast<size_t>(y * count + x);
            const float kept = keptShare(shared::luminance(light[at]), around);
            spread[at] += light[at] * kept;
            for (const size_t place : places)
                if (kept < 1)
                    spread[place] += light[at] * ((1 - kept) / static_cast<float>(places.size()));
        }
    std::ranges::copy(spread, light.begin());
}

} // namespace hearth::reflections
