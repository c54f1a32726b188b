// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/picture.h"

#include "formats/base/half.h"
#include "formats/pack/decode_image.h"
#include "formats/pack/pack_view.h"
#include "formats/texels/swizzle.h"
#include "pipelines/texture_files/png_writer.h"

#include <algorithm>
#include <cmath>

namespace hearth::gltf_export
{

using namespace formats;

namespace
{

constexpr uint16_t kOne = 0xFFFF;

uint16_t toCode(double value)
{
    return static_cast<uint16_t>(std::lround(std::clamp(value, 0.0, 1.0) * kOne));
}

/// Return the sRGB code of linear light, to the nearest of 8 bits.
uint16_t codeLight(uint16_t half)
{
    const double light = std::clamp(double{floatFromHalf(half)}, 0.0, 1.0);
    const double code = light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055;
    return static_cast<uint16_t>(std::lround(code * 255) * 257);
}

/// Set z of a normal from x and y, as shaders do. The nearest code makes the length so near 1 that a second
/// cook, which scales normals to 1, rounds x and y to the codes that they have.
void restoreZ(DecodedTexel& texel)
{
    const double x = texel[0] / 32767.5 - 1, y = texel[1] / 32767.5 - 1;
    texel[2] = toCode((std::sqrt(std::max(0.0, 1 - x * x - y * y)) + 1) / 2);
}

std::vector<DecodedTexel> readTexels(const ImageRecord& image, std::span<const std::byte> mips)
{
    const bool is_light = findTexelFormat(image.format)->coding == TexelCoding::float_value;
    const bool is_normal = (image.flags & kImageNormalMap) != 0;
    std::vector<DecodedTexel> texels = decodeImageMip(image, mips, 0);
    applySwizzle(texels, image.swizzle, is_light ? kHalfOne : kOne);
    for (DecodedTexel& texel : texels)
    {
        if (is_light)
            texel = {codeLight(texel[0]), codeLight(texel[1]), codeLight(texel[2]),
                     toCode(double{floatFromHalf(texel[3])})};
        if (is_normal)
            restoreZ(texel);
    }
    return texels;
}

} // namespace

std::vector<std::byte> encodeImage(const ImageRecord& image, std::span<const std::byte> mips)
{
    const std::vector<DecodedTexel> texels = readTexels(image, mips);
    const bool is_opaque =
        std::all_of(texels.begin(), texels.end(), [](const DecodedTexel& texel) { return texel[3] == kOne; });
    const bool is_wide = isUnorm16(image.format);
    const uint32_t channels = is_opaque ? 3 : 4;
    std::vector<uint8_t> codes;
    codes.reserve(texels.size() * channels * (is_wide ? 2 : 1));
    for (const DecodedTexel& texel : texels)
        for (uint32_t c = 0; c < channels; ++c)
        {
            if (is_wide)
                codes.push_back(static_cast<uint8_t>(texel[c] >> 8)); // big-endian
            codes.push_back(is_wide ? static_cast<uint8_t>(texel[c] & 255) : narrowUnorm(texel[c]));
        }
    return texture_files::writePng(image.width, image.height, {channels, is_wide ? 16u : 8u}, codes);
}

} // namespace hearth::gltf_export
