// Image whose mips are to be encoded.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "formats/texels/decoded_texel.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hearth::texels
{

/// Set of channels: bit 0 is red, bit 3 alpha.
using Channels = uint8_t;

inline constexpr Channels kRed = 1, kGreen = 2, kBlue = 4, kAlpha = 8;
inline constexpr Channels kRgb = kRed | kGreen | kBlue;

constexpr bool has(Channels channels, uint32_t channel)
{
    return (channels >> channel & 1) != 0;
}

/// Plain mips of an image, finest first, and what shaders read of them.
struct PlainImage
{
    formats::ImageRecord record{};
    std::span<const std::byte> mips{};
    formats::ImageRole role = formats::ImageRole::none;
    Channels channels = 0; ///< that shaders read
};

/// Return the stored texels of a mip.
std::span<const std::byte> mipBytes(const PlainImage& image, uint32_t mip);

/// Decode rows of a mip.
/// first_row, rows  inside the mip
std::vector<formats::DecodedTexel> decodeRows(const PlainImage& image, uint32_t mip, uint32_t first_row,
                                              uint32_t rows);

/// Return the channels of which all texels of all mips have one value.
/// values  filled with the values of those channels
Channels findConstantChannels(const PlainImage& image, formats::DecodedTexel& values);

} // namespace hearth::texels
