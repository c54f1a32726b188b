// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/plain_encoder.h"

#include "formats/base/assert.h"
#include "formats/base/half.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace hearth::formats
{

namespace
{

constexpr int kExponentBias = 15, kMantissaBits = 9;

/// Encode three half floats with a shared exponent. Source: Vulkan 1.3, section "RGB to shared exponent".
uint32_t encodeSharedExponent(const DecodedTexel& texel)
{
    std::array<double, 3> channels;
    for (size_t c = 0; c < 3; ++c)
        channels[c] = std::max(0.0, double{floatFromHalf(texel[c])});
    const double largest = *std::max_element(channels.begin(), channels.end());
    if (largest == 0)
        return 0;
    int exponent = std::max(-kExponentBias - 1, std::ilogb(largest)) + 1 + kExponentBias;
    double step = std::ldexp(1.0, exponent - kExponentBias - kMantissaBits);
    if (std::floor(largest / step + 0.5) == 1 << kMantissaBits) // rounded up past the mantissa
    {
        step *= 2;
        ++exponent;
    }
    uint32_t word = static_cast<uint32_t>(exponent) << 27;
    for (size_t c = 0; c < 3; ++c)
        word |= static_cast<uint32_t>(std::floor(channels[c] / step + 0.5)) << (9 * c);
    return word;
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
            const uint32_t word = encodeSharedExponent(texels[i]);
            std::memcpy(out, &word, sizeof(word));
        }
        else
            for (uint32_t c = 0; c < traits.channels; ++c)
                out[c] = std::byte{narrowUnorm(texels[i][c])};
    }
}

} // namespace hearth::formats
