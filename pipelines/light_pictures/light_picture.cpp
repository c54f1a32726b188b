// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/light_pictures/light_picture.h"

#include "formats/base/atomic_file.h"
#include "pipelines/texture_files/exr_writer.h"
#include "pipelines/texture_files/png_writer.h"

#include <algorithm>
#include <cmath>

namespace hearth::light_pictures
{

namespace
{

/// Return the code of sRGB for a light x, as x / (1 + x) of white.
uint8_t displayCode(double value)
{
    const double light = value / (1 + value);
    const double code = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
    return static_cast<uint8_t>(255 * code + 0.5);
}

} // namespace

std::vector<std::byte> encodePng(const LightPicture& picture, double factor)
{
    std::vector<uint8_t> codes;
    for (const Float3& texel : picture.texels)
        for (int c = 0; c < 3; ++c)
            codes.push_back(displayCode(factor * double{texel[c]}));
    return texture_files::writePng(picture.width, picture.height, {}, codes);
}

LightPicture shrink(const LightPicture& picture, uint32_t factor)
{
    LightPicture small{(picture.width + factor - 1) / factor, (picture.height + factor - 1) / factor, {}};
    for (uint32_t y = 0; y < small.height; ++y)
        for (uint32_t x = 0; x < small.width; ++x)
        {
            const uint32_t right = std::min((x + 1) * factor, picture.width);
            const uint32_t bottom = std::min((y + 1) * factor, picture.height);
            Float3 sum;
            for (uint32_t from_y = y * factor; from_y < bottom; ++from_y)
                for (uint32_t from_x = x * factor; from_x < right; ++from_x)
                    sum += picture.texels[size_t{from_y} * picture.width + from_x];
            small.texels.push_back(sum / static_cast<float>((right - x * factor) * (bottom - y * factor)));
        }
    return small;
}

bool isPictureName(const std::string& output)
{
    return output.ends_with(".png") || output.ends_with(".exr");
}

Status writePicture(const std::string& output, const LightPicture& picture, double factor)
{
    HEARTH_ASSIGN_OR_RETURN(AtomicFile out, AtomicFile::create(output));
    out.write(output.ends_with(".png")
                  ? encodePng(picture, factor)
                  : texture_files::writeExr(picture.width, picture.height, picture.texels));
    return out.finish();
}

} // namespace hearth::light_pictures
