// Applies the swizzle of an image to its stored texels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"
#include "formats/texels/decoded_texel.h"

#include <array>
#include <span>

namespace hearth::formats
{

/// Return the stored texel as a shader reads it.
/// swizzle  as ImageRecord::swizzle, valid
/// one      1 in the coding of the channels
inline DecodedTexel applySwizzle(const DecodedTexel& stored, const uint8_t (&swizzle)[4], uint16_t one)
{
    DecodedTexel read;
    for (uint32_t c = 0; c < 4; ++c)
    {
        const auto source = static_cast<Swizzle>(swizzle[c]);
        if (source == Swizzle::identity)
            read[c] = stored[c];
        else if (source == Swizzle::zero || source == Swizzle::one)
            read[c] = source == Swizzle::one ? one : uint16_t{0};
        else
            read[c] = stored[swizzle[c] - static_cast<uint8_t>(Swizzle::red)];
    }
    return read;
}

/// The same for many texels, in place.
inline void applySwizzle(std::span<DecodedTexel> texels, const uint8_t (&swizzle)[4], uint16_t one)
{
    // each channel read is one of the four stored ones, 0, and 1
    constexpr size_t kZero = 4, kOne = 5;
    std::array<size_t, 4> sources{};
    for (size_t c = 0; c < 4; ++c)
    {
        const auto source = static_cast<Swizzle>(swizzle[c]);
        sources[c] = source == Swizzle::identity ? c
                     : source == Swizzle::zero   ? kZero
                     : source == Swizzle::one    ? kOne
                                                 : swizzle[c] - static_cast<size_t>(Swizzle::red);
    }
    if (sources == std::array<size_t, 4>{0, 1, 2, 3})
        return;
    for (DecodedTexel& texel : texels)
    {
        const std::array<uint16_t, 6> values{texel[0], texel[1], texel[2], texel[3], 0, one};
        texel = {values[sources[0]], values[sources[1]], values[sources[2]], values[sources[3]]};
    }
}

} // namespace hearth::formats
