// Views an image at another size, for images that are made of two.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/assert.h"
#include "pipelines/import/part/part_builder.h"

#include <array>

namespace hearth::import
{

/// Image sampled at another size by nearest texel; white if it is empty. 8-bit images only (asserted).
class ResizedImage
{
public:
    ResizedImage(const DecodedImage& image, uint32_t width, uint32_t height)
        : image_(image), width_(width), height_(height)
    {
        HEARTH_ASSERT(image.type == ChannelType::unorm8);
    }

    std::array<uint8_t, 4> texel(uint32_t x, uint32_t y) const
    {
        if (image_.texels.empty())
            return {255, 255, 255, 255};
        const uint64_t from_x = uint64_t{x} * image_.width / width_;
        const uint64_t from_y = uint64_t{y} * image_.height / height_;
        const std::byte* from = image_.texels.data() + (from_y * image_.width + from_x) * 4;
        std::array<uint8_t, 4> texel;
        for (size_t i = 0; i < 4; ++i)
            texel[i] = static_cast<uint8_t>(from[i]);
        return texel;
    }

private:
    const DecodedImage& image_;
    uint32_t width_;
    uint32_t height_;
};

/// Return an image of 8 bits a channel whose texels are 0.
inline DecodedImage blankImage(uint32_t width, uint32_t height)
{
    DecodedImage image;
    image.width = width;
    image.height = height;
    image.texels.resize(size_t{width} * height * 4);
    return image;
}

} // namespace hearth::import
