// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/compare/image.h"

#include "formats/base/regular_file.h"

#include <png.h>

#include <cmath>

namespace hearth::viewer
{

Result<Image> readPng(const std::string& path)
{
    HEARTH_ASSIGN_OR_RETURN(const std::string bytes, readFile(path));
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()))
        return Error{Issue::image_malformed, path, "", png.message};
    png.format = PNG_FORMAT_RGBA; // with alpha, so that libpng does not blend with a background
    std::vector<uint8_t> rgba(PNG_IMAGE_SIZE(png));
    if (!png_image_finish_read(&png, nullptr, rgba.data(), 0, nullptr))
        return Error{Issue::image_malformed, path, "", png.message};
    Image image(png.width, png.height);
    for (size_t i = 0; i < rgba.size() / 4; ++i)
        for (size_t channel = 0; channel < 3; ++channel)
            image.rgb[i * 3 + channel] = rgba[i * 4 + channel];
    return image;
}

Status writePng(const std::string& path, const Image& image)
{
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = image.width;
    png.height = image.height;
    png.format = PNG_FORMAT_RGB;
    if (!png_image_write_to_file(&png, path.c_str(), 0, image.rgb.data(), 0, nullptr))
        return Error{Issue::cannot_write, path, "", png.message};
    return success();
}

double linearFromSrgb(double encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double srgbFromLinear(double linear)
{
    return linear <= 0.0031308 ? linear * 12.92 : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

} // namespace hearth::viewer
