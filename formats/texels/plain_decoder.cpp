// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/plain_decoder.h"

#include "formats/base/half.h"

#include <cmath>
#include <cstring>

namespace hearth::formats
{

namespace
{

uint16_t widen(std::byte channel)
{
    return static_cast<uint16_t>(static_cast<uint16_t>(channel) * 257);
}

/// Decode a texel with a shared exponent. Source: Vulkan 1.3, section 39.3 (E5B9G9R9). Mantissas have fewer
/// bits than those of half floats, but the largest values are beyond their range and become the largest half.
DecodedTexel decodeSharedExponent(uint32_t word)
{
    const auto exponent = static_cast<int>(word >> 27);
    const auto channel = [&](uint32_t shift)
    { return halfFromFloat(std::ldexp(static_cast<float>(word >> shift & 0x1FF), exponent - 15 - 9)); };
    return {channel(0), channel(9), channel(18), halfFromFloat(1)};
}

} // namespace

DecodedTexel decodePlainTexel(TexelFormat format, std::span<const std::byte> texel)
{
    DecodedTexel decoded{0, 0, 0, 0xFFFF};
    switch (format)
    {
    case TexelFormat::rgb9e5_float:
    {
        uint32_t word;
        std::memcpy(&word, texel.data(), sizeof(word));
        return decodeSharedExponent(word);
    }
    case TexelFormat::rgba16_float:
    case TexelFormat::rgba16_unorm:
    case TexelFormat::rgba16_srgb:
        std::memcpy(decoded.data(), texel.data(), sizeof(decoded));
        return decoded;
    default:
        for (size_t c = 0; c < texel.size(); ++c)
            decoded[c] = widen(texel[c]);
        return decoded;
    }
}

} // namespace hearth::formats
