// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/plain_decoder.h"

#include "formats/base/half.h"
#include "formats/texels/shared_exponent.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace hearth::formats
{

namespace
{

uint16_t widen(std::byte channel)
{
    return static_cast<uint16_t>(static_cast<uint16_t>(channel) * 257);
}

/// Widen texels of four channels, which most images have. Compilers see that copies of four texels do not
/// overlap, so processors take many channels at a time.
void widenRow(std::span<const std::byte> row, std::span<DecodedTexel> texels)
{
    constexpr size_t kRun = 4;
    std::array<std::byte, kRun * 4> narrow;
    std::array<DecodedTexel, kRun> wide;
    size_t next = 0;
    for (; next + kRun <= texels.size(); next += kRun)
    {
        std::memcpy(narrow.data(), row.data() + 4 * next, sizeof(narrow));
        for (size_t i = 0; i < kRun; ++i)
            for (size_t c = 0; c < 4; ++c)
                wide[i][c] = widen(narrow[4 * i + c]);
        std::memcpy(texels.data() + next, wide.data(), sizeof(wide));
    }
    for (; next < texels.size(); ++next)
        for (size_t c = 0; c < 4; ++c)
            texels[next][c] = widen(row[4 * next + c]);
}

/// Decode a texel with a shared exponent. Mantissas have fewer bits than those of half floats, and the
/// largest value is less than the largest half.
DecodedTexel decodeHalves(uint32_t word)
{
    const std::array<float, 3> color = decodeSharedExponent(word);
    return {halfFromFloat(color[0]), halfFromFloat(color[1]), halfFromFloat(color[2]), halfFromFloat(1)};
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
        return decodeHalves(word);
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

void decodePlainRow(TexelFormat format, std::span<const std::byte> row, std::span<DecodedTexel> texels)
{
    if (format == TexelFormat::rgba8_unorm || format == TexelFormat::rgba8_srgb)
    {
        widenRow(row, texels);
        return;
    }
    const size_t bytes = row.size() / std::max<size_t>(texels.size(), 1);
    for (size_t i = 0; i < texels.size(); ++i)
        texels[i] = decodePlainTexel(format, row.subspan(i * bytes, bytes));
}

} // namespace hearth::formats
