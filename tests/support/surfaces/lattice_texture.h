// Texture of a sheet with round holes, for alpha masks and blended materials.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace hearth::test
{

/// Make the texels, RGBA8, of a sheet with a hole of 11 texels in each square of 16: alpha is 0 in the holes
/// and 255 between them, and the texel of their rims is smooth.
inline std::vector<uint32_t> makeLatticeTexels(uint32_t width, uint32_t height)
{
    std::vector<uint32_t> texels;
    for (uint32_t y = 0; y < height; ++y)
        for (uint32_t x = 0; x < width; ++x)
        {
            const auto fromMiddle = [](uint32_t i) { return static_cast<float>(i % 16) - 7.5f; };
            const float from_rim = std::hypot(fromMiddle(x), fromMiddle(y)) - 5.5f;
            const auto alpha = static_cast<uint32_t>(255 * std::clamp(0.5f + 0.5f * from_rim, 0.0f, 1.0f));
            texels.push_back(alpha << 24 | 0x60A0C0u);
        }
    return texels;
}

} // namespace hearth::test
