// Formats of texels in texture files, by their numbers in Vulkan: those that devices sample.
// Source: Vulkan 1.3, section 34.1.1 (Format Definition).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/texel_format.h"

#include <array>
#include <optional>

namespace hearth::import
{

/// Meaning of the bits of a channel.
enum class ChannelCoding : uint8_t
{
    unorm,
    snorm,
    float_value, ///< 32 or 16 bits; 11 or 10 without a sign
};

/// Bits of a channel in a texel, counted from the lowest bit of its first byte.
struct ChannelBits
{
    uint8_t first = 0;
    uint8_t count = 0; ///< 0: the texel lacks the channel. At most 16, or 32 of a float
};

/// Memory layout of a texel that is not compressed.
struct PlainLayout
{
    ChannelCoding coding;
    uint8_t texel_bytes;
    std::array<ChannelBits, 4> channels; ///< red, green, blue, alpha
};

/// Either a format of the one table of formats, or a plain layout.
struct StoredFormat
{
    const formats::TexelFormatTraits* traits = nullptr; ///< null: `plain`
    PlainLayout plain{};

    uint32_t blockBytes() const { return traits != nullptr ? traits->block_bytes : plain.texel_bytes; }
    bool hasFloats() const
    {
        return traits != nullptr ? traits->coding == formats::TexelCoding::float_value
                                 : plain.coding == ChannelCoding::float_value;
    }
    uint32_t blockHeight() const { return traits != nullptr ? traits->block_height : 1u; }

    /// Return the bytes of a level of width x height texels; blocks that reach over the edge are whole.
    uint64_t levelBytes(uint32_t width, uint32_t height) const;
};

/// Return the format with a number of VkFormat; nullopt if it is not read. Formats of sRGB are laid out as
/// those of linear numbers.
std::optional<StoredFormat> findStoredFormat(uint32_t vulkan_format);

} // namespace hearth::import
