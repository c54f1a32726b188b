// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/placeholder.h"

namespace hearth::import
{

DecodedImage makePlaceholderImage()
{
    constexpr uint32_t kSize = 64;
    constexpr uint32_t kSquare = 8;
    DecodedImage image;
    image.width = image.height = kSize;
    image.texels = std::vector<std::byte>(size_t{kSize} * kSize * 4);
    for (size_t y = 0; y < kSize; ++y)
        for (size_t x = 0; x < kSize; ++x)
        {
            std::byte* texel = &image.texels[(y * kSize + x) * 4];
            if ((x / kSquare + y / kSquare) % 2 == 0)
                texel[0] = texel[2] = std::byte{255};
            texel[3] = std::byte{255};
        }
    return image;
}

} // namespace hearth::import
