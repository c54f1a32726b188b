// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/texture_requests.h"

#include <algorithm>
#include <cmath>

namespace hearth::pack
{

TextureUse makeTextureUse(const formats::PackView& view, const formats::TextureRef& texture)
{
    constexpr double kMaxAnisotropy = 8;
    constexpr double kMinScale = 1e-6; // a transform that maps everything to a line or point
    const double a{texture.uv_transform[0]}, b{texture.uv_transform[1]};
    const double c{texture.uv_transform[3]}, d{texture.uv_transform[4]};
    const double squares = (a * a + b * b + c * c + d * d) / 2;
    const double determinant = a * d - b * c;
    const double difference = std::sqrt(std::max(squares * squares - determinant * determinant, 0.0));
    const double largest = std::sqrt(squares + difference);
    const double smallest = std::sqrt(std::max(squares - difference, 0.0));
    const double scale = std::max({smallest, largest / kMaxAnisotropy, kMinScale});
    const formats::ImageRecord& image = view.images()[texture.image];
    const auto [shorter, longer] = std::minmax(image.width, image.height);
    const double texels = std::max(1.0 * shorter, 1.0 * longer / kMaxAnisotropy);
    return {texture.image, static_cast<float>(std::log2(scale * texels))};
}

float mipPriority(const TextureUse& use, float pixels_log2, uint32_t mip)
{
    return std::exp2(pixels_log2 - use.texels_log2 + static_cast<float>(mip + 1));
}

} // namespace hearth::pack
