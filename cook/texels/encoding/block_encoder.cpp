// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/encoding/block_encoder.h"

#include "cook/texels/bc/bc1.h"
#include "cook/texels/bc/bc4.h"
#include "cook/texels/bc/bc6h.h"
#include "cook/texels/bc/bc7.h"
#include "cook/texels/etc2/eac_encoder.h"
#include "cook/texels/etc2/etc2_encoder.h"
#include "formats/base/assert.h"

#include <algorithm>

namespace hearth::texels
{

using namespace formats;

namespace
{

constexpr uint32_t kSide = 4;

/// Return the texels of a block; beyond the edge those at the edge.
Block16 gatherBlock(const StoredTexels& texels, uint32_t x, uint32_t y)
{
    Block16 block;
    for (uint32_t j = 0; j < kSide; ++j)
        for (uint32_t i = 0; i < kSide; ++i)
        {
            const size_t row = std::min(y + j, texels.height - 1), column = std::min(x + i, texels.width - 1);
            block[j * kSide + i] = texels.texels[row * texels.width + column];
        }
    return block;
}

Block8 narrowBlock(const Block16& block)
{
    Block8 narrow;
    for (size_t i = 0; i < block.size(); ++i)
        for (size_t c = 0; c < 4; ++c)
            narrow[i][c] = narrowUnorm(block[i][c]);
    return narrow;
}

void encodeBc3(const Block8& block, Effort effort, std::span<std::byte, 16> out)
{
    encodeBc3Alpha(block, effort, out.first<8>());
    encodeBc1(block, {1, 1, 1, 0}, Bc1Palettes::four_only, effort, out.last<8>());
}

/// Encode a block of BC.
/// out  of the bytes of the format's block
void encodeBc(TexelFormat format, const Block16& block, Effort effort, std::span<std::byte> out)
{
    switch (format)
    {
    case TexelFormat::bc1_rgb_unorm:
    case TexelFormat::bc1_rgb_srgb:
        encodeBc1(narrowBlock(block), {1, 1, 1, 0}, Bc1Palettes::all, effort, out.first<8>());
        break;
    case TexelFormat::bc3_unorm:
    case TexelFormat::bc3_srgb:
        encodeBc3(narrowBlock(block), effort, out.first<16>());
        break;
    case TexelFormat::bc4_unorm:
        encodeBc4(block, 0, effort, out.first<8>());
        break;
    case TexelFormat::bc5_unorm:
        encodeBc5(block, effort, out.first<16>());
        break;
    case TexelFormat::bc6h_ufloat:
        encodeBc6h(block, effort, out.first<16>());
        break;
    default:
        HEARTH_ASSERT(format == TexelFormat::bc7_unorm || format == TexelFormat::bc7_srgb);
        encodeBc7(narrowBlock(block), {1, 1, 1, 1}, effort, out.first<16>());
    }
}

/// Encode a block of ETC2 or EAC.
void encodeEtc2(const Etc2Encoder& encoder, TexelFormat format, const Block16& block, Effort effort,
                std::span<std::byte> out)
{
    switch (format)
    {
    case TexelFormat::eac_r11_unorm:
    {
        std::array<uint16_t, 16> reds;
        std::ranges::transform(block, reds.begin(), [](const auto& texel) { return texel[0]; });
        std::ranges::copy(encodeEacR11(reds, effort).bytes, out.begin());
        break;
    }
    case TexelFormat::eac_rg11_unorm:
        std::ranges::copy(encodeEacRg11(block, effort).bytes, out.begin());
        break;
    case TexelFormat::etc2_rgba8_unorm:
    case TexelFormat::etc2_rgba8_srgb:
        std::ranges::copy(encoder.encodeRgba(narrowBlock(block)).bytes, out.begin());
        break;
    default:
        HEARTH_ASSERT(format == TexelFormat::etc2_rgb8_unorm || format == TexelFormat::etc2_rgb8_srgb);
        std::ranges::copy(encoder.encodeRgb(narrowBlock(block)).bytes, out.begin());
    }
}

} // namespace

std::vector<std::byte> encodeBlocks(const Candidate& candidate, const StoredTexels& texels, Effort effort)
{
    const TexelFormatTraits& traits = *candidate.traits;
    std::vector<std::byte> blocks(
        static_cast<size_t>(formats::mipBytes(traits, texels.width, texels.height)));
    const Etc2Encoder etc2(effort);
    std::byte* out = blocks.data();
    for (uint32_t y = 0; y < texels.height; y += kSide)
        for (uint32_t x = 0; x < texels.width; x += kSide, out += traits.block_bytes)
        {
            const auto index = static_cast<size_t>(out - blocks.data()) / traits.block_bytes;
            if (!texels.search.empty() && texels.search[index] == BlockSearch::none)
                continue;
            const Block16 block = gatherBlock(texels, x, y);
            const std::span<std::byte> bytes(out, traits.block_bytes);
            if (traits.family == TexelFamily::bc)
                encodeBc(traits.format, block, effort, bytes);
            else
                encodeEtc2(etc2, traits.format, block, effort, bytes);
        }
    return blocks;
}

} // namespace hearth::texels
