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

/// Return the RMS difference of roughness from reference(texel).
template <typename Reference>
double measureDifference(std::span<const Float4> texels, const Reference& reference)
{
    double sum = 0;
    for (size_t i = 0; i < texels.size(); ++i)
    {
        const double difference = double{texels[i].y} - reference(i);
        sum += difference * difference;
    }
    return std::sqrt(sum / static_cast<double>(texels.size()));
}

} // namespace

double findRoughnessDifference(const ImageRecord& image, std::span<const std::byte> a,
                               std::span<const std::byte> b)
{
    double worst = 0;
    for (uint32_t mip = 0; mip < image.mip_count; ++mip)
    {
        const std::vector<Float4> first = decodeMip(image, a, mip), second = decodeMip(image, b, mip);
        worst = std::max(worst, measureDifference(first, [&](size_t i) { return double{second[i].y}; }));
    }
    return worst;
}

double findRoughnessRise(const ImageRecord& image, std::span<const std::byte> texels)
{
    const double roughness = double{decodeMip(image, texels, 0).front().y};
    double rise = 0;
    for (uint32_t mip = 1; mip < image.mip_count; ++mip)
        rise = std::max(rise,
                        measureDifference(decodeMip(image, texels, mip), [&](size_t) { return roughness; }));
    return rise;
}

RoughnessImage makeRoughnessImage(const ImageRecord& normals, float roughness)
{
    RoughnessImage image;
    image.record.width = std::max(normals.width / 2, 1u);
    image.record.height = std::max(normals.height / 2, 1u);
    image.record.format = static_cast<uint32_t>(TexelFormat::rgba8_unorm);
    const float code = std::round(std::clamp(roughness, 0.0f, 1.0f) * 255);
    image.texels.assign(size_t{image.record.width} * image.record.height * 4, std::byte{255});
    for (size_t i = 1; i < image.texels.size(); i += 4)
        image.texels[i] = static_cast<std::byte>(static_cast<uint8_t>(code));
    return image;
}

} // namespace hearth::textures
