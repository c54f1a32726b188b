// Generates images for texture tests.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <array>
#include <random>
#include <vector>

namespace hearth::textures::test
{

using Rgba8 = std::array<uint8_t, 4>;

inline formats::ImageRecord makeRecord(uint32_t width, uint32_t height,
                                       formats::TexelFormat format = formats::TexelFormat::rgba8_srgb,
                                       uint32_t flags = 0)
{
    formats::ImageRecord record{};
    record.width = width;
    record.height = height;
    record.format = static_cast<uint32_t>(format);
    record.flags = flags;
    record.alpha_cutoff = (flags & formats::kImageAlphaTested) != 0 ? 0.5f : 0;
    return record;
}

inline std::vector<std::byte> filled(uint32_t width, uint32_t height, Rgba8 texel)
{
    std::vector<std::byte> texels;
    for (size_t i = 0; i < size_t{width} * height; ++i)
        for (const uint8_t value : texel)
            texels.push_back(std::byte{value});
    return texels;
}

inline std::vector<std::byte> randomBytes(size_t count, uint32_t seed)
{
    std::mt19937 random(seed);
    std::vector<std::byte> bytes(count);
    for (std::byte& byte : bytes)
        byte = static_cast<std::byte>(random() & 0xFFu);
    return bytes;
}

/// Return the texels of one mip of a chain, four bytes each.
inline std::vector<Rgba8> decodeMip(const formats::ImageRecord& image, const std::vector<std::byte>& chain,
                                    uint32_t mip)
{
    std::vector<Rgba8> texels;
    const auto end = static_cast<size_t>(formats::mipOffset(image, mip + 1));
    for (auto at = static_cast<size_t>(formats::mipOffset(image, mip)); at < end; at += 4)
        texels.push_back({static_cast<uint8_t>(chain[at]), static_cast<uint8_t>(chain[at + 1]),
                          static_cast<uint8_t>(chain[at + 2]), static_cast<uint8_t>(chain[at + 3])});
    return texels;
}

} // namespace hearth::textures::test
