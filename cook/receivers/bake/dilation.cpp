// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/bake/dilation.h"

#include "cook/receivers/bake/atlas_layout.h"
#include "formats/base/index.h"

#include <array>

namespace hearth::receivers
{

std::vector<TexelCopy> dilate(uint32_t width, uint32_t height, std::span<const TexelCell> texels)
{
    constexpr std::array<TexelCell, 8> kNeighbours{
        {{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
    const auto border = static_cast<int32_t>(kAtlasBorder);
    const int32_t columns = static_cast<int32_t>(width) + 2 * border,
                  rows = static_cast<int32_t>(height) + 2 * border;
    const auto index = [&](int32_t x, int32_t y) { return static_cast<size_t>(y * columns + x); };
    std::vector<uint32_t> sources(static_cast<size_t>(columns) * static_cast<size_t>(rows), kInvalidIndex);
    for (uint32_t i = 0; i < texels.size(); ++i)
        sources[index(texels[i].x + border, texels[i].y + border)] = i;
    std::vector<bool> is_copy(sources.size());
    for (uint32_t round = 0; round < kDilation; ++round)
    {
        const std::vector<uint32_t> last = sources;
        for (int32_t y = 0; y < rows; ++y)
            for (int32_t x = 0; x < columns; ++x)
                for (const TexelCell& step : kNeighbours)
                {
                    const int32_t near_x = x + step.x, near_y = y + step.y;
                    if (sources[index(x, y)] != kInvalidIndex || near_x < 0 || near_y < 0 ||
                        near_x >= columns || near_y >= rows)
                        continue;
                    sources[index(x, y)] = last[index(near_x, near_y)];
                    is_copy[index(x, y)] = sources[index(x, y)] != kInvalidIndex;
                }
    }
    std::vector<TexelCopy> copies;
    for (int32_t y = 0; y < rows; ++y)
        for (int32_t x = 0; x < columns; ++x)
            if (is_copy[index(x, y)])
                copies.push_back({{x - border, y - border}, sources[index(x, y)]});
    return copies;
}

} // namespace hearth::receivers
