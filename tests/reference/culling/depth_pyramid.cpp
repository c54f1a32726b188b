// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/culling/depth_pyramid.h"

#include <algorithm>

namespace hearth::reference
{

std::vector<float> makePyramid(const std::vector<float>& depth, uint32_t width, uint32_t height)
{
    std::vector<float> texels;
    for (uint32_t level = 1; level <= shared::pyramidLevels(width, height); ++level)
        for (uint32_t y = 0; y < shared::pyramidSize(height, level); ++y)
            for (uint32_t x = 0; x < shared::pyramidSize(width, level); ++x)
            {
                float farthest = 1;
                for (uint32_t py = y << level; py < std::min((y + 1) << level, height); ++py)
                    for (uint32_t px = x << level; px < std::min((x + 1) << level, width); ++px)
                        farthest = std::min(farthest, depth[size_t{py} * width + px]);
                texels.push_back(farthest);
            }
    return texels;
}

bool isHidden(const Pyramid& pyramid, const shared::Instance& instance, Float3 box_min, Float3 box_max)
{
    const shared::PyramidBox box = shared::pyramidBox(pyramid.view, instance, box_min, box_max);
    if (box.known == 0)
        return false;
    for (uint32_t y = box.y0; y <= box.y1; ++y)
        for (uint32_t x = box.x0; x <= box.x1; ++x)
            if (box.depth >= pyramid.texels.at(box.offset + y * box.stride + x))
                return false;
    return true;
}

} // namespace hearth::reference
