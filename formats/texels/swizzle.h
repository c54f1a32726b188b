// Applies the swizzle of an image to its stored texels.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/scene.h"
#include "formats/texels/decoded_texel.h"

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

} // namespace hearth::formats
