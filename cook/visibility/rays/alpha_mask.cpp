// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/rays/alpha_mask.h"

#include "formats/base/half.h"
#include "formats/records/texel_wrap.h"
#include "formats/texels/decoded_texel.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace hearth::visibility
{

using namespace formats;

Result<AlphaImage> readAlpha(const PackView& part, uint32_t image)
{
    HEARTH_ASSIGN_OR_RETURN(const ChunkData data, part.imageData(image));
    const ImageRecord& record = part.images()[image];
    AlphaImage alpha{record.width, record.height, {}};
    const size_t count = size_t{record.width} * record.height;
    const uint32_t size = texelBytes(record.format);
    if (data.bytes().size() < count * size)
        return Error{Issue::chunk_size, part.name(), "image " + std::to_string(image),
                     "it has fewer texels than its size says"};
    alpha.texels.resize(count);
    for (size_t i = 0; i < count; ++i)
    {
        const std::byte* texel = data.bytes().data() + i * size;
        if (size == 4)
        {
            alpha.texels[i] = std::to_integer<uint8_t>(texel[3]);
            continue;
        }
        uint16_t word;
        std::memcpy(&word, texel + 6, sizeof(word));
        alpha.texels[i] = isUnorm16(record.format)
                              ? narrowUnorm(word)
                              : static_cast<uint8_t>(quantizeUnorm(floatFromHalf(word), 255));
    }
    return alpha;
}

AlphaMask::AlphaMask(const MaterialRecord& material, std::shared_ptr<const AlphaImage> image)
    : texture_(material.base_color_texture),
      alpha_(material.base_color.w),
      cutoff_(material.alpha_cutoff),
      image_(std::move(image))
{
}

bool AlphaMask::isOpaque(Float2 uv) const
{
    if (!image_)
        return alpha_ >= cutoff_;
    const float* m = texture_.uv_transform;
    const auto texelCoordinate = [&](const float* row, uint32_t size)
    {
        const float value =
            std::clamp(row[0] * uv.x + row[1] * uv.y + row[2], -kMaxUvMagnitude, kMaxUvMagnitude);
        return value * static_cast<float>(size) - 0.5f;
    };
    const float x = texelCoordinate(m, image_->width), y = texelCoordinate(m + 3, image_->height);
    const float x0 = std::floor(x), y0 = std::floor(y);
    const auto wrapColumn = [&](float column)
    { return wrapTexel(static_cast<int64_t>(column), image_->width, texture_.wrap_u); };
    const auto wrapRow = [&](float row)
    { return wrapTexel(static_cast<int64_t>(row), image_->height, texture_.wrap_v) * image_->width; };
    const int64_t left = wrapColumn(x0), right = wrapColumn(x0 + 1), top = wrapRow(y0),
                  bottom = wrapRow(y0 + 1);
    const auto texel = [&](int64_t row, int64_t column)
    { return static_cast<float>(image_->texels[static_cast<size_t>(row + column)]); };
    const float fx = x - x0, fy = y - y0;
    const float upper = texel(top, left) * (1 - fx) + texel(top, right) * fx;
    const float lower = texel(bottom, left) * (1 - fx) + texel(bottom, right) * fx;
    return alpha_ * (upper * (1 - fy) + lower * fy) >= cutoff_ * 255;
}

} // namespace hearth::visibility
