// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/texel_codec.h"

#include "cook/textures/srgb.h"
#include "formats/base/half.h"
#include "formats/pack/pack_view.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

namespace hearth::textures
{

namespace
{

// Colours are weighted by alpha + this. If all texels are cut away, the result is their plain mean; beside
// the faintest alpha that 8 bits store, cut-away texels add less than 1/4000.
constexpr float kMinWeight = 0x1p-20f;

// Minimum length of a mean direction. Directions stored in 8 bits are accurate to half a step: a mean shorter
// than one step has no direction.
constexpr float kMinDirectionLength = 1.0f / 128;

/// Return a stored channel as a share of its range.
template <typename T>
float fromUnorm(T channel)
{
    return static_cast<float>(channel) / static_cast<float>(std::numeric_limits<T>::max());
}

template <typename T>
T toUnorm(float value)
{
    constexpr auto kMax = static_cast<float>(std::numeric_limits<T>::max());
    return static_cast<T>(std::clamp(value, 0.0f, 1.0f) * kMax + 0.5f);
}

/// Four channels as stored.
template <typename T>
using Texel = std::array<T, 4>;

template <typename T>
Texel<T> readTexel(std::span<const std::byte> row, size_t i)
{
    Texel<T> texel;
    std::memcpy(texel.data(), row.data() + i * sizeof(texel), sizeof(texel));
    return texel;
}

/// Decode a normal: 0 to the largest number means -1 to 1, as in glTF. It is on the front side of the
/// surface, and unit: z is made of x and y later.
template <typename T>
Float3 decodeNormal(const Texel<T>& texel)
{
    constexpr float kHalf = static_cast<float>(std::numeric_limits<T>::max()) / 2;
    const auto component = [](T value) { return static_cast<float>(value) / kHalf - 1; };
    return normalizeOr({component(texel[0]), component(texel[1]), std::max(component(texel[2]), 0.0f)},
                       {0, 0, 1});
}

/// srgb  SrgbTables for 8 bits, WideSrgbTable for 16
template <typename T, typename Srgb>
Float4 decode(Content content, const Texel<T>& texel, const Srgb& srgb)
{
    const float alpha = fromUnorm(texel[3]);
    switch (content)
    {
    case Content::color:
    {
        const float weight = alpha + kMinWeight;
        return {srgb.linear(texel[0]) * weight, srgb.linear(texel[1]) * weight,
                srgb.linear(texel[2]) * weight, alpha};
    }
    case Content::normals:
    {
        const Float3 direction = decodeNormal(texel);
        return {direction.x, direction.y, direction.z, alpha};
    }
    default:
        return {fromUnorm(texel[0]), fromUnorm(texel[1]), fromUnorm(texel[2]), alpha};
    }
}

Texel<uint8_t> encodeColor(Float4 texel, float alpha_scale, const SrgbTables& srgb)
{
    const float weight = texel.w + kMinWeight;
    return {srgb.stored(texel.x / weight), srgb.stored(texel.y / weight), srgb.stored(texel.z / weight),
            toUnorm<uint8_t>(texel.w * alpha_scale)};
}

/// Encode data or a normal.
template <typename T>
Texel<T> encode(Content content, Float4 texel, float alpha_scale)
{
    const T alpha = toUnorm<T>(texel.w * alpha_scale);
    if (content != Content::normals)
        return {toUnorm<T>(texel.x), toUnorm<T>(texel.y), toUnorm<T>(texel.z), alpha};
    const Float3 mean{texel.x, texel.y, texel.z};
    const Float3 direction = length(mean) < kMinDirectionLength ? Float3{0, 0, 1} : mean / length(mean);
    return {toUnorm<T>(direction.x * 0.5f + 0.5f), toUnorm<T>(direction.y * 0.5f + 0.5f),
            toUnorm<T>(direction.z * 0.5f + 0.5f), alpha};
}

Float4 decodeLight(const Texel<uint16_t>& half)
{
    return {floatFromHalf(half[0]), floatFromHalf(half[1]), floatFromHalf(half[2]), floatFromHalf(half[3])};
}

Texel<uint16_t> encodeLight(Float4 texel, float alpha_scale)
{
    return {halfFromFloat(texel.x), halfFromFloat(texel.y), halfFromFloat(texel.z),
            halfFromFloat(texel.w * alpha_scale)};
}

/// Write the texels of a row, each encoded by `encodeTexel`.
template <typename Encode>
void writeRow(std::span<const Float4> texels, std::span<std::byte> out, const Encode& encodeTexel)
{
    for (size_t i = 0; i < texels.size(); ++i)
    {
        const auto stored = encodeTexel(texels[i]);
        std::memcpy(out.data() + i * sizeof(stored), stored.data(), sizeof(stored));
    }
}

} // namespace

Content classifyContent(const formats::ImageRecord& image)
{
    if (static_cast<formats::TexelFormat>(image.format) == formats::TexelFormat::rgba16_float)
        return Content::light;
    if ((image.flags & formats::kImageNormalMap) != 0)
        return Content::normals;
    return formats::isSrgb(image.format) ? Content::color : Content::data;
}

uint32_t mipFormat(uint32_t imported_format, uint32_t max_bits)
{
    if (formats::isSrgb(imported_format))
        return static_cast<uint32_t>(formats::TexelFormat::rgba8_srgb);
    return formats::isUnorm16(imported_format) && max_bits < 16
               ? static_cast<uint32_t>(formats::TexelFormat::rgba8_unorm)
               : imported_format;
}

void decodeRow(Content content, uint32_t format, std::span<const std::byte> stored, std::span<Float4> out)
{
    const auto decodeAll = [&](const auto& decodeTexel)
    {
        for (size_t i = 0; i < out.size(); ++i)
            out[i] = decodeTexel(i);
    };
    if (content == Content::light)
        decodeAll([&](size_t i) { return decodeLight(readTexel<uint16_t>(stored, i)); });
    else if (formats::isUnorm16(format))
        decodeAll([&, &srgb = WideSrgbTable::get()](size_t i)
                  { return decode(content, readTexel<uint16_t>(stored, i), srgb); });
    else
        decodeAll([&, &srgb = SrgbTables::get()](size_t i)
                  { return decode(content, readTexel<uint8_t>(stored, i), srgb); });
}

void encodeRow(Content content, uint32_t format, std::span<const Float4> texels, float alpha_scale,
               std::span<std::byte> out)
{
    const SrgbTables& srgb = SrgbTables::get();
    if (content == Content::light)
        writeRow(texels, out, [&](Float4 texel) { return encodeLight(texel, alpha_scale); });
    else if (content == Content::color)
        writeRow(texels, out, [&](Float4 texel) { return encodeColor(texel, alpha_scale, srgb); });
    else if (formats::isUnorm16(format))
        writeRow(texels, out, [&](Float4 texel) { return encode<uint16_t>(content, texel, alpha_scale); });
    else
        writeRow(texels, out, [&](Float4 texel) { return encode<uint8_t>(content, texel, alpha_scale); });
}

} // namespace hearth::textures
