// Compares the UASTC decoder with Arm's decoder of ASTC: random blocks are written as UASTC, and as the ASTC
// blocks that stand for the same texels.
// Source of ASTC's layout: Khronos Data Format Specification 1.3, "ASTC Compressed Texture Image Formats".
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/basis_uastc.h"
#include "tests/pipelines_scans/ktx2_builder.h"
#include "tests/pipelines_scans/uastc_modes.h"

#include <astcenc.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>

namespace hearth::import
{

namespace
{

using namespace test;

constexpr uint32_t kBlockBytes = 16;
constexpr uint32_t kColumns = 30, kRows = 22; ///< blocks of each mode

// ASTC's seeds of UASTC's patterns, from the tables of the UASTC specification.
constexpr std::array<uint32_t, 30> kTwoSubsets = {28,  20,  16,  29,  91,  9,   107, 72,  149, 204,
                                                  50,  114, 496, 17,  78,  39,  252, 828, 43,  156,
                                                  116, 210, 476, 273, 684, 359, 246, 195, 694, 524};
constexpr std::array<uint32_t, 11> kThreeSubsets = {260, 74, 32, 156, 183, 15, 745, 0, 335, 902, 254};
constexpr std::array<uint32_t, 19> kTwoOfThreeSubsets = {36,  48,  61,  137, 161, 183, 226, 281, 302, 307,
                                                         479, 495, 593, 594, 605, 799, 812, 988, 993};

std::span<const uint32_t> getSeeds(const UastcLayout& layout)
{
    if (layout.mode == 7)
        return kTwoOfThreeSubsets;
    return layout.subsets == 3 ? std::span<const uint32_t>(kThreeSubsets) : kTwoSubsets;
}

/// Content of a block, in any encoding.
struct LogicalBlock
{
    uint32_t pattern = 0;
    uint32_t channel = 3; ///< has the weights of the second plane
    std::vector<uint32_t>
        endpoints; ///< stored values: subset by subset, of each component the low and the high
    std::array<std::array<uint32_t, 2>, 16> weights{};
};

/// A block of ASTC, all zeros; bit 0 is the lowest of the first byte.
class AstcBits
{
public:
    void put(uint32_t at, uint32_t value, uint32_t count)
    {
        for (uint32_t i = 0; i < count; ++i)
            bytes_[(at + i) / 8] =
                static_cast<uint8_t>(bytes_[(at + i) / 8] | ((value >> i) & 1u) << ((at + i) % 8));
    }
    const std::array<uint8_t, kBlockBytes>& bytes() const { return bytes_; }

private:
    std::array<uint8_t, kBlockBytes> bytes_{};
};

constexpr uint32_t take(uint32_t value, uint32_t high, uint32_t low)
{
    return value >> low & ((1u << (high - low + 1)) - 1u);
}

/// Trits of a pack of 8 bits, as the specification decodes them.
std::array<uint32_t, 5> decodeTrits(uint32_t t)
{
    std::array<uint32_t, 5> trits{};
    uint32_t c = take(t, 4, 0);
    if (take(t, 4, 2) == 7)
    {
        c = take(t, 7, 5) << 2 | take(t, 1, 0);
        trits[4] = trits[3] = 2;
    }
    else if (take(t, 6, 5) == 3)
    {
        trits[4] = 2;
        trits[3] = take(t, 7, 7);
    }
    else
    {
        trits[4] = take(t, 7, 7);
        trits[3] = take(t, 6, 5);
    }
    if (take(c, 1, 0) == 3)
    {
        trits[2] = 2;
        trits[1] = take(c, 4, 4);
        trits[0] = take(c, 3, 3) << 1 | (take(c, 2, 2) & ~take(c, 3, 3));
    }
    else if (take(c, 3, 2) == 3)
    {
        trits[2] = trits[1] = 2;
        trits[0] = take(c, 1, 0);
    }
    else
    {
        trits[2] = take(c, 4, 4);
        trits[1] = take(c, 3, 2);
        trits[0] = take(c, 1, 1) << 1 | (take(c, 0, 0) & ~take(c, 1, 1));
    }
    return trits;
}

/// Quints of a pack of 7 bits, as the specification decodes them.
std::array<uint32_t, 3> decodeQuints(uint32_t q)
{
    std::array<uint32_t, 3> quints{};
    if (take(q, 2, 1) == 3 && take(q, 6, 5) == 0)
    {
        const uint32_t not_first = ~take(q, 0, 0) & 1u;
        quints[2] = take(q, 0, 0) << 2 | (take(q, 4, 4) & not_first) << 1 | (take(q, 3, 3) & not_first);
        quints[1] = quints[0] = 4;
        return quints;
    }
    uint32_t c = take(q, 4, 0);
    quints[2] = take(q, 6, 5);
    if (take(q, 2, 1) == 3)
    {
        quints[2] = 4;
        c = take(q, 4, 3) << 3 | (~take(q, 6, 5) & 3u) << 1 | take(q, 0, 0);
    }
    if (take(c, 2, 0) == 5)
    {
        quints[1] = 4;
        quints[0] = take(c, 4, 3);
    }
    else
    {
        quints[1] = take(c, 4, 3);
        quints[0] = take(c, 2, 0);
    }
    return quints;
}

/// Return the smallest pack that decodes to these digits.
template <typename Decode>
uint32_t findPack(const Decode& decode, std::span<const uint32_t> digits)
{
    for (uint32_t pack = 0; pack < 256; ++pack)
    {
        const auto decoded = decode(pack);
        if (std::equal(digits.begin(), digits.end(), decoded.begin()))
            return pack;
    }
    ADD_FAILURE() << "no pack has these digits";
    return 0;
}

/// Write an integer sequence: the bits of a pack of trits or quints lie between those of its values.
void putSequence(AstcBits& out, uint32_t at, uint32_t levels, std::span<const uint32_t> values)
{
    const uint32_t base = getDigitBase(levels), bits = countPlainBits(levels);
    constexpr std::array<uint32_t, 5> kTritBits = {2, 2, 1, 2, 1};
    constexpr std::array<uint32_t, 3> kQuintBits = {3, 2, 2};
    const size_t per_pack = base == 3 ? 5 : base == 5 ? 3 : 1;
    for (size_t first = 0; first < values.size(); first += per_pack)
    {
        const size_t count = std::min(per_pack, values.size() - first);
        std::vector<uint32_t> digits;
        for (size_t i = 0; i < count; ++i)
            digits.push_back(values[first + i] >> bits);
        uint32_t pack = base == 3   ? findPack(decodeTrits, digits)
                        : base == 5 ? findPack(decodeQuints, digits)
                                    : 0;
        for (size_t i = 0; i < count; ++i)
        {
            out.put(at, values[first + i] & ((1u << bits) - 1u), bits);
            at += bits;
            const uint32_t pack_bits = base == 3 ? kTritBits[i] : base == 5 ? kQuintBits[i] : 0;
            out.put(at, pack, pack_bits);
            at += pack_bits;
            pack >>= pack_bits;
        }
    }
}

/// Block mode of a grid of 4 x 4 weights: A = 2, B = 0, and the range of weights in R and H.
uint32_t getBlockMode(uint32_t weight_bits, uint32_t planes)
{
    constexpr std::array<uint32_t, 6> kR = {0, 2, 4, 7, 4, 7}; // 2, 4, 8; with H 16, 32 levels
    const uint32_t r = kR[weight_bits], h = weight_bits >= 4 ? 1 : 0;
    return r >> 1 | (r & 1u) << 4 | 2u << 5 | h << 9 | (planes == 2 ? 1u : 0u) << 10;
}

AstcBits encodeAstc(const UastcLayout& layout, const LogicalBlock& block)
{
    constexpr std::array<uint32_t, 5> kEndpointMode = {0, 0, 4, 8, 12}; // grey and alpha, RGB, RGBA; direct
    AstcBits out;
    out.put(0, getBlockMode(layout.weight_bits, layout.planes), 11);
    out.put(11, layout.subsets - 1, 2);
    uint32_t endpoints_at = 17;
    if (layout.subsets == 1)
        out.put(13, kEndpointMode[layout.components], 4);
    else
    {
        out.put(13, getSeeds(layout)[block.pattern], 10);
        out.put(25, kEndpointMode[layout.components], 4); // after two zeros: the same mode in all subsets
        endpoints_at = 29;
    }
    putSequence(out, endpoints_at, layout.levels, block.endpoints);
    uint32_t at = 128; // weights are stored downwards
    for (const auto& weights : block.weights)
        for (uint32_t plane = 0; plane < layout.planes; ++plane)
            for (uint32_t bit = 0; bit < layout.weight_bits; ++bit)
                out.put(--at, weights[plane] >> bit & 1u, 1);
    if (layout.planes == 2)
        out.put(at - 2, block.channel, 2);
    return out;
}

using Subsets = std::array<uint32_t, 16>; ///< subset of each texel

/// True for the first texel of each subset, whose weights have no highest bit in UASTC.
bool isAnchor(const Subsets& subsets, size_t texel)
{
    return std::find(subsets.begin(), subsets.end(), subsets[texel]) ==
           subsets.begin() + static_cast<ptrdiff_t>(texel);
}

UastcBits encodeUastc(const UastcLayout& layout, const LogicalBlock& block, const Subsets& subsets)
{
    UastcBits out;
    out.putCode(layout.code);
    out.put(0x155555, layout.hints);
    out.put(block.pattern, layout.pattern_bits);
    out.put(block.channel, layout.channel_bits);
    putEndpoints(out, layout.levels, block.endpoints);
    for (size_t texel = 0; texel < 16; ++texel)
        for (uint32_t plane = 0; plane < layout.planes; ++plane)
            out.put(block.weights[texel][plane], layout.weight_bits - (isAnchor(subsets, texel) ? 1 : 0));
    EXPECT_EQ(out.used(), layout.bits);
    return out;
}

class AstcDecoder
{
public:
    explicit AstcDecoder(astcenc_profile profile)
    {
        astcenc_config config{};
        EXPECT_EQ(
            astcenc_config_init(profile, 4, 4, 1, ASTCENC_PRE_FASTEST, ASTCENC_FLG_DECOMPRESS_ONLY, &config),
            ASTCENC_SUCCESS);
        astcenc_context* context = nullptr;
        EXPECT_EQ(astcenc_context_alloc(&config, 1, &context), ASTCENC_SUCCESS);
        context_.reset(context);
    }

    astcenc_block_info inspect(const AstcBits& block) const
    {
        astcenc_block_info info{};
        EXPECT_EQ(astcenc_get_block_info(context_.get(), block.bytes().data(), &info), ASTCENC_SUCCESS);
        return info;
    }

    /// Decode blocks, row by row, into texels of four channels.
    template <typename Value>
    std::vector<Value> decode(const Bytes& blocks, astcenc_type type) const
    {
        std::vector<Value> texels(size_t{kColumns} * kRows * 64);
        void* slice = texels.data();
        astcenc_image image{4 * kColumns, 4 * kRows, 1, type, &slice};
        const astcenc_swizzle same{ASTCENC_SWZ_R, ASTCENC_SWZ_G, ASTCENC_SWZ_B, ASTCENC_SWZ_A};
        EXPECT_EQ(astcenc_decompress_image(context_.get(), blocks.data(), blocks.size(), &image, &same, 0),
                  ASTCENC_SUCCESS);
        return texels;
    }

private:
    struct Free
    {
        void operator()(astcenc_context* context) const { astcenc_context_free(context); }
    };
    std::unique_ptr<astcenc_context, Free> context_;
};

/// Blocks of one mode in both encodings.
struct BlockPair
{
    Bytes uastc, astc;

    void add(const Bytes& uastc_block, const AstcBits& astc_block)
    {
        uastc.insert(uastc.end(), uastc_block.begin(), uastc_block.end());
        astc.insert(astc.end(), astc_block.bytes().begin(), astc_block.bytes().end());
    }
};

/// Place of an endpoint value on a scale from 0 to 1: values with trits and quints rise with the plain bits
/// above the lowest, then with the digit, and the lowest bit mirrors the scale.
double placeEndpoint(uint32_t value, uint32_t levels)
{
    const uint32_t base = getDigitBase(levels), bits = countPlainBits(levels);
    if (base == 1)
        return value / (levels - 1.0);
    const uint32_t low = value & ((1u << bits) - 1u);
    const double place = ((low >> 1) * base + (value >> bits)) / (levels - 1.0);
    return (low & 1u) != 0 ? 1 - place : place;
}

/// Brightness of the second endpoint of a subset above that of the first, as ASTC compares them.
double compareEndpoints(const UastcLayout& layout, std::span<const uint32_t> endpoints)
{
    double difference = 0;
    for (size_t component = 0; component < 3; ++component)
        difference += placeEndpoint(endpoints[2 * component + 1], layout.levels) -
                      placeEndpoint(endpoints[2 * component], layout.levels);
    return difference;
}

/// Draw a block whose endpoints differ enough in brightness for `compareEndpoints` to be certain.
LogicalBlock drawBlock(const UastcLayout& layout, const Subsets& subsets, uint32_t pattern,
                       std::mt19937& random)
{
    const auto below = [&](uint32_t count) { return static_cast<uint32_t>(random() % count); };
    LogicalBlock block{.pattern = pattern, .endpoints = {}};
    if (layout.channel_bits > 0)
        block.channel = below(layout.components);
    const size_t per_subset = size_t{2} * layout.components;
    for (uint32_t subset = 0; subset < layout.subsets; ++subset)
    {
        std::vector<uint32_t> endpoints(per_subset);
        do
            std::generate(endpoints.begin(), endpoints.end(), [&] { return below(layout.levels); });
        while (layout.components > 2 && std::abs(compareEndpoints(layout, endpoints)) < 0.03);
        block.endpoints.insert(block.endpoints.end(), endpoints.begin(), endpoints.end());
    }
    for (size_t texel = 0; texel < 16; ++texel)
        for (uint32_t plane = 0; plane < layout.planes; ++plane)
            block.weights[texel][plane] =
                below(1u << (layout.weight_bits - (isAnchor(subsets, texel) ? 1 : 0)));
    return block;
}

/// ASTC means something else, blue contraction, by a first endpoint that is brighter than the second: change
/// the two, and mirror the weights.
LogicalBlock orderForAstc(const UastcLayout& layout, LogicalBlock block, const Subsets& subsets)
{
    const size_t per_subset = size_t{2} * layout.components;
    for (uint32_t subset = 0; layout.components > 2 && subset < layout.subsets; ++subset)
    {
        const std::span endpoints = std::span(block.endpoints).subspan(subset * per_subset, per_subset);
        if (compareEndpoints(layout, endpoints) > 0)
            continue;
        for (size_t i = 0; i < per_subset; i += 2)
            std::swap(endpoints[i], endpoints[i + 1]);
        for (size_t texel = 0; texel < 16; ++texel)
            for (uint32_t plane = 0; subsets[texel] == subset && plane < layout.planes; ++plane)
                block.weights[texel][plane] = (1u << layout.weight_bits) - 1u - block.weights[texel][plane];
    }
    return block;
}

/// Ask Arm's decoder which subset each texel is in, and whether it reads the header as it is meant.
Subsets inspectSubsets(const AstcDecoder& decoder, const UastcLayout& layout, uint32_t pattern)
{
    LogicalBlock block{.pattern = pattern, .channel = 1, .endpoints = {}};
    block.endpoints.resize(size_t{2} * layout.components * layout.subsets);
    const astcenc_block_info info = decoder.inspect(encodeAstc(layout, block));
    EXPECT_FALSE(info.is_error_block);
    EXPECT_EQ(info.color_level_count, layout.levels);
    EXPECT_EQ(info.weight_level_count, 1u << layout.weight_bits);
    EXPECT_EQ(info.partition_count, layout.subsets);
    EXPECT_EQ(info.is_dual_plane_block, layout.planes == 2);
    Subsets subsets{};
    std::copy_n(info.partition_assignment, 16, subsets.begin());
    return subsets;
}

/// Random blocks of a mode with all patterns and all levels of endpoints and weights.
BlockPair drawBlocks(const AstcDecoder& decoder, const UastcLayout& layout)
{
    std::mt19937 random(layout.mode);
    std::set<uint32_t> endpoints, weights, channels;
    const auto patterns = layout.subsets == 1 ? 1u : static_cast<uint32_t>(getSeeds(layout).size());
    BlockPair blocks;
    for (uint32_t i = 0; i < kColumns * kRows; ++i)
    {
        const uint32_t pattern = i % patterns;
        const Subsets subsets = inspectSubsets(decoder, layout, pattern);
        const LogicalBlock block = drawBlock(layout, subsets, pattern, random);
        blocks.add(encodeUastc(layout, block, subsets).block(),
                   encodeAstc(layout, orderForAstc(layout, block, subsets)));
        endpoints.insert(block.endpoints.begin(), block.endpoints.end());
        channels.insert(block.channel);
        for (const auto& texel : block.weights)
            weights.insert(texel.begin(), texel.begin() + layout.planes);
    }
    EXPECT_EQ(endpoints.size(), layout.levels) << "each level is drawn";
    EXPECT_EQ(weights.size(), 1u << layout.weight_bits);
    EXPECT_EQ(channels.size(), layout.channel_bits > 0 ? layout.components : 1u);
    return blocks;
}

std::vector<std::byte> decodeUastcTexels(const Bytes& blocks, bool srgb)
{
    DecodedImage image{4 * kColumns, 4 * kRows, ChannelType::unorm8,
                       std::vector<std::byte>(size_t{kColumns} * kRows * 64)};
    EXPECT_TRUE(decodeUastc(std::as_bytes(std::span(blocks)), srgb, image));
    return image.texels;
}

/// Compare RGB of the sRGB profile exactly: it ends in the upper 8 bits of the interpolated 16, which is
/// UASTC's rule. Its alpha is left to the linear profile: astcenc 4.2 widens it as colours.
uint64_t countDifferentSrgb(const AstcDecoder& decoder, const BlockPair& blocks)
{
    const std::vector<std::byte> ours = decodeUastcTexels(blocks.uastc, true);
    const std::vector<uint8_t> theirs = decoder.decode<uint8_t>(blocks.astc, ASTCENC_TYPE_U8);
    uint64_t different = 0;
    for (size_t i = 0; i < ours.size(); ++i)
        different += i % 4 < 3 && std::to_integer<uint8_t>(ours[i]) != theirs[i] ? 1u : 0u;
    return different;
}

/// Compare all channels of the linear profile, which ends in 16 bits: the value of 8 bits must be their upper
/// half. Half floats, in which astcenc hands 16 bits on, have steps of at most 32 of 65535.
uint64_t countDifferentLinear(const AstcDecoder& decoder, const BlockPair& blocks)
{
    constexpr double kHalfStep = 33;
    const std::vector<std::byte> ours = decodeUastcTexels(blocks.uastc, false);
    const std::vector<float> theirs = decoder.decode<float>(blocks.astc, ASTCENC_TYPE_F32);
    uint64_t different = 0;
    for (size_t i = 0; i < ours.size(); ++i)
    {
        const double wide = double{theirs[i]} * 65535, low = 256.0 * std::to_integer<int>(ours[i]);
        different += wide > low - kHalfStep && wide < low + 255 + kHalfStep ? 0u : 1u;
    }
    return different;
}

TEST(UastcAndAstc, areTheSameTexelsInEveryModeAndPattern)
{
    const AstcDecoder srgb(ASTCENC_PRF_LDR_SRGB), linear(ASTCENC_PRF_LDR);
    for (const UastcLayout& layout : kUastcLayouts)
    {
        SCOPED_TRACE("mode " + std::to_string(layout.mode));
        const BlockPair blocks = drawBlocks(linear, layout);
        EXPECT_EQ(countDifferentSrgb(srgb, blocks), 0u);
        EXPECT_EQ(countDifferentLinear(linear, blocks), 0u);
    }
}

TEST(UastcAndAstc, areTheSameTexelsInTheSolidMode)
{
    std::mt19937 random(8);
    BlockPair blocks;
    for (uint32_t i = 0; i < kColumns * kRows; ++i)
    {
        UastcBits uastc;
        AstcBits astc; // void extent: the colour of the whole image, in 16 bits a channel
        uastc.putCode(kUastcSolidCode);
        astc.put(0, 0xDFC, 12);
        astc.put(12, 0xFFFFFFFF, 32);
        astc.put(44, 0xFFFFF, 20);
        for (uint32_t channel = 0; channel < 4; ++channel)
        {
            const auto value = static_cast<uint32_t>(random() % 256);
            uastc.put(value, 8);
            astc.put(64 + 16 * channel, value * 257, 16);
        }
        blocks.add(uastc.block(), astc);
    }
    EXPECT_EQ(countDifferentSrgb(AstcDecoder(ASTCENC_PRF_LDR_SRGB), blocks), 0u);
    EXPECT_EQ(countDifferentLinear(AstcDecoder(ASTCENC_PRF_LDR), blocks), 0u);
}

} // namespace

} // namespace hearth::import
