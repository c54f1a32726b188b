// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/png.h"

#include "formats/base/assert.h"

#include <png.h>

namespace hearth::tools
{

std::vector<std::byte> encodePng(uint32_t width, uint32_t height, uint32_t channels,
                                 std::span<const uint8_t> codes)
{
    HEARTH_ASSERT((channels == 1 || channels == 3) && codes.size() == size_t{width} * height * channels);
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = width;
    png.height = height;
    png.format = channels == 1 ? PNG_FORMAT_GRAY : PNG_FORMAT_RGB;
    std::vector<std::byte> file(PNG_IMAGE_PNG_SIZE_MAX(png));
    png_alloc_size_t size = file.size();
    const int written = png_image_write_to_memory(&png, file.data(), &size, 0, codes.data(), 0, nullptr);
    HEARTH_ASSERT(written != 0);
    file.resize(size);
    return file;
}

} // namespace hearth::tools
