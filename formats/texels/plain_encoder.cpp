// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/plain_encoder.h"

#include "formats/base/assert.h"
#include "formats/base/half.h"
#include "formats/texels/shared_exponent.h"

#include <array>
#include <cstring>

namespace hearth::formats
{

namespace
{

uint32_t encodeHalves(const DecodedTexel& texel)
{
    std::array<double, 3> color;
    for (size_t c = 0; c < 3; ++c)
        color[c] = floatFromHalf(texel[c]);
    return encodeSharedExponent(color);
}

} // namespace

void encodePlain(const TexelFormatTraits& traits, std::span<const DecodedTexel> texels,
                 std::span<std::byte> bytes)
{
    HEARTH_ASSERT(traits.family == TexelFamily::plain);
    HEARTH_ASSERT(bytes.size() == texels.size() * traits.block_bytes);
    if (traits.block_bytes == sizeof(DecodedTexel))
    {
        std::memcpy(bytes.data(), texels.data(), bytes.size());
        return;
    }
    for (size_t i = 0; i < texels.size(); ++i)
    {
        std::byte* const out = bytes.data() + i * traits.block_bytes;
        if (traits.format == TexelFormat::rgb9e5_float)
        {
            const uint32_t word = encodeHalves(texels[i]);
            std::memcpy(out, &word, sizeof(word));
        }
        else
            for (uint32_t c = 0; c < traits.channels; ++c)
                out[c] = std::byte{narrowUnorm(texels[i][c])};
    }
}

} // namespace hearth::formats
