// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/roughness_images.h"

#include "cook/textures/texel_codec.h"
#include "formats/pack/pack_view.h"

#include <algorithm>
#include <cmath>

namespace hearth::textures
{

using namespace formats;

namespace
{

/// Decode the texels of a mip.
std::vector<Float4> decodeMip(const ImageRecord& image, std::span<const std::byte> texels, uint32_t mip)
{
    const auto [width, height] = mipExtent(image, mip);
    std::vector<Float4> decoded(size_t{width} * height);
    decodeRow(Content::data, image.format, texels.subspan(static_cast<size_t>(mipOffset(image, mip))),
              decoded);
    return decoded;
}

double meanRoughness(std::span<const Float4> texels)
{
    double sum = 0;
    for (const Float4& texel : texels)
        sum += double{texel.y};
    return sum / static_cast<double>(texels.size());
}

} // namespace

double findRoughnessDifference(const ImageRecord& image, std::span<const std::byte> a,
                               std::span<const std::byte> b)
{
    double worst = 0;
    for (uint32_t mip = 0; mip < image.mip_count; ++mip)
    {
        const std::vector<Float4> first = decodeMip(image, a, mip), second = decodeMip(image, b, mip);
        double sum = 0;
        for (size_t i = 0; i < first.size(); ++i)
        {
            const double difference = double{first[i].y} - double{second[i].y};
            sum += difference * difference;
        }
        worst = std::max(worst, std::sqrt(sum / static_cast<double>(first.size())));
    }
    return worst;
}

double findRoughnessRise(const ImageRecord& image, std::span<const std::byte> texels)
{
    const double finest = meanRoughness(decodeMip(image, texels, 0));
    double rise = 0;
    for (uint32_t mip = 1; mip < image.mip_count; ++mip)
        rise = std::max(rise, meanRoughness(decodeMip(image, texels, mip)) - finest);
    return rise;
}

RoughnessImage makeRoughnessImage(const ImageRecord& normals, float roughness)
{
    RoughnessImage image;
    image.record.name = normals.name;
    image.record.width = std::max(normals.width / 2, 1u);
    image.record.height = std::max(normals.height / 2, 1u);
    image.record.format = static_cast<uint32_t>(TexelFormat::rgba8_unorm);
    const float code = std::ceil(std::clamp(roughness, 0.0f, 1.0f) * 255);
    if (code > 0)
        image.factor = std::clamp(roughness, 0.0f, 1.0f) * 255 / code;
    image.texels.assign(size_t{image.record.width} * image.record.height * 4, std::byte{255});
    for (size_t i = 1; i < image.texels.size(); i += 4)
        image.texels[i] = static_cast<std::byte>(static_cast<uint8_t>(code));
    return image;
}

} // namespace hearth::textures
