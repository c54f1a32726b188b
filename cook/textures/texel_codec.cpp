// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/textures/texel_codec.h"

#include "cook/textures/srgb.h"
#include "formats/base/half.h"

#include <array>
#include <cstring>

namespace hearth::textures
{

namespace
{

// Colours are weighted by alpha + this. If all texels are cut away, the result is their plain mean; beside
// the faintest alpha that 8 bits store, cut-away texels add less than 1/4000.
constexpr float kMinWeight = 0x1p-20f;

// Minimum length of a mean direction. Stored directions are accurate to half a step of 8 bits: a mean shorter
// than one step has no direction.
constexpr float kMinDirectionLength = 1.0f / 128;

uint8_t unorm8(float value)
{
    return static_cast<uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255 + 0.5f);
}

/// Decode a normal: 0..255 means -1..1, as in glTF.
Float3 decodeNormal(const uint8_t* texel)
{
    const auto component = [](uint8_t value) { return static_cast<float>(value) / 127.5f - 1; };
    return normalizeOr({component(texel[0]), component(texel[1]), component(texel[2])}, {0, 0, 1});
}

Float4 decode(Content content, const uint8_t* texel, const SrgbTables& srgb)
{
    const float alpha = static_cast<float>(texel[3]) / 255;
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
        return {static_cast<float>(texel[0]) / 255, static_cast<float>(texel[1]) / 255,
                static_cast<float>(texel[2]) / 255, alpha};
    }
}

std::array<uint8_t, 4> encode(Content content, Float4 texel, float alpha_scale, const SrgbTables& srgb)
{
    const uint8_t alpha = unorm8(texel.w * alpha_scale);
    switch (content)
    {
    case Content::color:
    {
        const float weight = texel.w + kMinWeight;
        return {srgb.stored(texel.x / weight), srgb.stored(texel.y / weight), srgb.stored(texel.z / weight),
                alpha};
    }
    case Content::normals:
    {
        const Float3 mean{texel.x, texel.y, texel.z};
        const Float3 direction = length(mean) < kMinDirectionLength ? Float3{0, 0, 1} : mean / length(mean);
        return {unorm8(direction.x * 0.5f + 0.5f), unorm8(direction.y * 0.5f + 0.5f),
                unorm8(direction.z * 0.5f + 0.5f), alpha};
    }
    default:
        return {unorm8(texel.x), unorm8(texel.y), unorm8(texel.z), alpha};
    }
}

} // namespace

Content classifyContent(const formats::ImageRecord& image)
{
    const auto format = static_cast<formats::TexelFormat>(image.format);
    if (format == formats::TexelFormat::rgba16_float)
        return Content::light;
    if ((image.flags & formats::kImageNormalMap) != 0)
        return Content::normals;
    return format == formats::TexelFormat::rgba8_srgb ? Content::color : Content::data;
}

void decodeRow(Content content, std::span<const std::byte> stored, std::span<Float4> out)
{
    const SrgbTables& srgb = SrgbTables::get();
    if (content != Content::light)
    {
        const auto* texels = reinterpret_cast<const uint8_t*>(stored.data());
        for (size_t i = 0; i < out.size(); ++i)
            out[i] = decode(content, texels + i * 4, srgb);
        return;
    }
    for (size_t i = 0; i < out.size(); ++i)
    {
        std::array<uint16_t, 4> half;
        std::memcpy(half.data(), stored.data() + i * sizeof(half), sizeof(half));
        out[i] = {floatFromHalf(half[0]), floatFromHalf(half[1]), floatFromHalf(half[2]),
                  floatFromHalf(half[3])};
    }
}

void encodeRow(Content content, std::span<const Float4> texels, float alpha_scale, std::span<std::byte> out)
{
    const SrgbTables& srgb = SrgbTables::get();
    for (size_t i = 0; i < texels.size(); ++i)
    {
        const Float4& t = texels[i];
        if (content == Content::light)
        {
            const std::array<uint16_t, 4> half = {halfFromFloat(t.x), halfFromFloat(t.y), halfFromFloat(t.z),
                                                  halfFromFloat(t.w * alpha_scale)};
            std::memcpy(out.data() + i * sizeof(half), half.data(), sizeof(half));
            continue;
        }
        const std::array<uint8_t, 4> stored = encode(content, t, alpha_scale, srgb);
        std::memcpy(out.data() + i * stored.size(), stored.data(), stored.size());
    }
}

} // namespace hearth::textures
