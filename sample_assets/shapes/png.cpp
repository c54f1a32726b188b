// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "sample_assets/shapes/png.h"

#include "formats/base/assert.h"

#include <png.h>

namespace hearth::samples
{

namespace
{

bool isOpaque(const Image& image)
{
    for (size_t i = 3; i < image.texels.size(); i += 4)
        if (image.texels[i] != 255)
            return false;
    return true;
}

std::vector<uint8_t> withoutAlpha(const Image& image)
{
    std::vector<uint8_t> rgb;
    rgb.reserve(image.texels.size() / 4 * 3);
    for (size_t i = 0; i < image.texels.size(); i += 4)
        rgb.insert(rgb.end(), {image.texels[i], image.texels[i + 1], image.texels[i + 2]});
    return rgb;
}

} // namespace

std::vector<std::byte> encodePng(const Image& image)
{
    HEARTH_ASSERT(image.texels.size() == size_t{image.width} * image.height * 4);
    const bool opaque = isOpaque(image);
    const std::vector<uint8_t> rgb = opaque ? withoutAlpha(image) : std::vector<uint8_t>();
    const uint8_t* const texels = opaque ? rgb.data() : image.texels.data();

    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = image.width;
    png.height = image.height;
    png.format = opaque ? PNG_FORMAT_RGB : PNG_FORMAT_RGBA;
    // noise hardly compresses: the fast setting costs a tenth of the time for about 10 % more bytes
    png.flags = PNG_IMAGE_FLAG_FAST;

    std::vector<std::byte> file(PNG_IMAGE_PNG_SIZE_MAX(png));
    png_alloc_size_t size = file.size();
    const int written = png_image_write_to_memory(&png, file.data(), &size, 0, texels, 0, nullptr);
    HEARTH_ASSERT(written != 0);
    file.resize(size);
    return file;
}

} // namespace hearth::samples
