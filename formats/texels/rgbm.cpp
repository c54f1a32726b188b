// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/rgbm.h"

#include <algorithm>
#include <cmath>

namespace hearth::formats
{

uint32_t encodeRgbm(const std::array<double, 3>& color)
{
    std::array<double, 3> roots;
    for (size_t c = 0; c < 3; ++c)
        roots[c] = std::sqrt(std::clamp(color[c], 0.0, kMaxRgbmValue) / kMaxRgbmValue);
    const double largest = *std::max_element(roots.begin(), roots.end());
    // A factor of at least 1 keeps the division below sound for black.
    const double factor = std::max(1.0, std::ceil(largest * 255));
    uint32_t word = static_cast<uint32_t>(factor) << 24;
    for (size_t c = 0; c < 3; ++c)
        word |= static_cast<uint32_t>(std::floor(roots[c] * 255 / factor * 255 + 0.5)) << (8 * c);
    return word;
}

} // namespace hearth::formats
