// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/texture.h"

#include "formats/base/half.h"
#include "formats/records/texel_wrap.h"

#include <cmath>

namespace hearth::bricks
{

using namespace formats;

namespace
{

/// Return the sRGB decoding table (IEC 61966-2-1). Rounding doubles to floats hides the last bits of pow,
/// which differ between libraries.
const std::array<float, 256>& linearFromSrgb()
{
    static const std::array<float, 256> table = []
    {
        std::array<float, 256> values{};
        for (size_t i = 0; i < values.size(); ++i)
        {
            const double code = static_cast<double>(i) / 255;
            values[i] =
                static_cast<float>(code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4));
        }
        return values;
    }();
    return table;
}

float unorm16(uint16_t channel)
{
    return static_cast<float>(channel) / 65535.0f;
}

Float4 mixed(Float4 a, Float4 b, float t)
{
    return {a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t, a.w + (b.w - a.w) * t};
}

} // namespace

Float2 transformed(const TextureRef& reference, Float2 uv)
{
    const float* m = reference.uv_transform;
    return {m[0] * uv.x + m[1] * uv.y + m[2], m[3] * uv.x + m[4] * uv.y + m[5]};
}

Texture::Texture(const PackView& part, uint32_t image)
    : part_(&part), image_(image), record_(part.images()[image])
{
}

uint32_t Texture::mipFor(double finest, double texels) const
{
    const double ratio = finest / texels;
    if (!(ratio >= 1))
        return 0;
    const auto mip = static_cast<uint32_t>(std::min(std::ilogb(ratio), 31));
    return std::min(mip, std::max(record_.mip_count, 1u) - 1);
}

Float4 Texture::at(const TextureRef& reference, Float2 uv, uint32_t level) const
{
    const Texels& texels = mip(level);
    if (texels.empty())
        return {};
    const MipExtent extent = mipExtent(record_, level);
    const int64_t width = extent.width, height = extent.height;
    const float x = std::clamp(uv.x, -kMaxUvMagnitude, kMaxUvMagnitude) * static_cast<float>(width) - 0.5f;
    const float y = std::clamp(uv.y, -kMaxUvMagnitude, kMaxUvMagnitude) * static_cast<float>(height) - 0.5f;
    const float left = std::floor(x), top = std::floor(y);
    const auto fetch = [&](int column, int row)
    {
        const int64_t i = wrapTexel(static_cast<int64_t>(left) + column, width, reference.wrap_u);
        const int64_t j = wrapTexel(static_cast<int64_t>(top) + row, height, reference.wrap_v);
        return texel(texels, static_cast<uint64_t>(j * width + i));
    };
    return mixed(mixed(fetch(0, 0), fetch(1, 0), x - left), mixed(fetch(0, 1), fetch(1, 1), x - left),
                 y - top);
}

Status Texture::status() const
{
    const std::lock_guard lock(mutex_);
    return status_;
}

const Texture::Texels& Texture::mip(uint32_t mip) const
{
    if (const Texels* texels = ready_[mip].load(std::memory_order_acquire))
        return *texels;
    const std::lock_guard lock(mutex_);
    if (!mips_[mip])
    {
        mips_[mip] = std::make_unique<const Texels>(read(mip));
        ready_[mip].store(mips_[mip].get(), std::memory_order_release);
    }
    return *mips_[mip];
}

/// Read a mip. The caller holds the lock.
Texture::Texels Texture::read(uint32_t mip) const
{
    const Result<ChunkData> data = part_->imageData(image_);
    const uint64_t first = mipOffset(record_, mip), end = mipOffset(record_, mip + 1);
    if (data.ok() && first < end && data->bytes().size() >= end)
        return {data->bytes().begin() + static_cast<ptrdiff_t>(first),
                data->bytes().begin() + static_cast<ptrdiff_t>(end)};
    if (status_.ok())
        status_ = data.ok()
                      ? Status(Error{Issue::chunk_size, part_->name(), "image " + std::to_string(image_),
                                     "it has fewer texels than its size says"})
                      : Status(data.error());
    return {};
}

Float4 Texture::texel(const Texels& texels, uint64_t index) const
{
    const auto byte = [&](size_t i) { return std::to_integer<uint8_t>(texels[index * 4 + i]); };
    const auto unorm = [&](size_t i) { return static_cast<float>(byte(i)) / 255.0f; };
    if (record_.format == static_cast<uint32_t>(TexelFormat::rgba8_srgb))
        return {linearFromSrgb()[byte(0)], linearFromSrgb()[byte(1)], linearFromSrgb()[byte(2)], unorm(3)};
    if (record_.format == static_cast<uint32_t>(TexelFormat::rgba8_unorm))
        return {unorm(0), unorm(1), unorm(2), unorm(3)};
    uint16_t words[4];
    std::memcpy(words, texels.data() + index * sizeof(words), sizeof(words));
    const auto decode = isUnorm16(record_.format) ? unorm16 : floatFromHalf;
    return {decode(words[0]), decode(words[1]), decode(words[2]), decode(words[3])};
}

} // namespace hearth::bricks
