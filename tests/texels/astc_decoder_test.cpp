// Compares the ASTC decoder with libastcenc's 4.2, which hands on half floats: values of 16 bits are compared
// after the specification's conversion to them, and before it with what astcenc_get_block_info tells.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/texels/astc_decoder.h"

#include "formats/base/half.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>

#include <astcenc.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace hearth::formats
{
namespace
{

using Block = std::array<uint8_t, 16>;

/// Blocks that libastcenc decodes at once, as a row of an image.
constexpr uint32_t kBatch = 1024;

/// Blocks of a batch whose classes are counted.
constexpr size_t kInspected = 256;

/// Return the number of random blocks of each footprint, profile and kind. HEARTH_ASTC_TRIALS multiplies it:
/// 500 tries more than 10^7 blocks.
size_t blocksOfEachKind()
{
    const char* const factor = std::getenv("HEARTH_ASTC_TRIALS");
    return test::trials(kBatch) * (factor == nullptr ? 1 : std::strtoul(factor, nullptr, 10));
}

class Astcenc
{
public:
    Astcenc(astcenc_profile profile, uint32_t width, uint32_t height, float quality, uint32_t flags)
        : width_(width), height_(height)
    {
        astcenc_config config{};
        EXPECT_EQ(astcenc_config_init(profile, width, height, 1, quality, flags, &config), ASTCENC_SUCCESS);
        astcenc_context* context = nullptr;
        EXPECT_EQ(astcenc_context_alloc(&config, 1, &context), ASTCENC_SUCCESS);
        context_.reset(context);
    }

    Astcenc(astcenc_profile profile, uint32_t width, uint32_t height)
        : Astcenc(profile, width, height, ASTCENC_PRE_FASTEST, ASTCENC_FLG_DECOMPRESS_ONLY)
    {
    }

    astcenc_block_info inspect(const Block& block) const
    {
        astcenc_block_info info{};
        EXPECT_EQ(astcenc_get_block_info(context_.get(), block.data(), &info), ASTCENC_SUCCESS);
        return info;
    }

    /// Encode an image of one row of blocks from its half floats.
    std::vector<Block> encode(std::vector<DecodedTexel>& texels) const
    {
        const auto columns = static_cast<uint32_t>(texels.size() / (size_t{width_} * height_));
        std::vector<Block> blocks(columns);
        void* slice = texels.data();
        astcenc_image image{columns * width_, height_, 1, ASTCENC_TYPE_F16, &slice};
        EXPECT_EQ(
            astcenc_compress_image(context_.get(), &image, &kSame, blocks[0].data(), blocks.size() * 16, 0),
            ASTCENC_SUCCESS);
        return blocks;
    }

    /// Decode a row of blocks into an image of one row of blocks: half floats.
    std::vector<DecodedTexel> decode(const std::vector<Block>& blocks) const
    {
        const auto columns = static_cast<uint32_t>(blocks.size());
        std::vector<DecodedTexel> texels(size_t{columns} * width_ * height_);
        void* slice = texels.data();
        astcenc_image image{columns * width_, height_, 1, ASTCENC_TYPE_F16, &slice};
        EXPECT_EQ(astcenc_decompress_reset(context_.get()), ASTCENC_SUCCESS);
        EXPECT_EQ(
            astcenc_decompress_image(context_.get(), blocks[0].data(), blocks.size() * 16, &image, &kSame, 0),
            ASTCENC_SUCCESS);
        return texels;
    }

private:
    static constexpr astcenc_swizzle kSame{ASTCENC_SWZ_R, ASTCENC_SWZ_G, ASTCENC_SWZ_B, ASTCENC_SWZ_A};

    struct Free
    {
        void operator()(astcenc_context* context) const { astcenc_context_free(context); }
    };

    uint32_t width_, height_;
    std::unique_ptr<astcenc_context, Free> context_;
};

/// Bits of a block, put from either end.
class BlockBits
{
public:
    void put(uint32_t first, uint32_t count, uint64_t value)
    {
        for (uint32_t i = 0; i < count; ++i)
        {
            const uint32_t bit = first + i;
            block_[bit / 8] = static_cast<uint8_t>((block_[bit / 8] & ~(1u << bit % 8)) |
                                                   static_cast<uint32_t>(value >> i & 1) << bit % 8);
        }
    }

    explicit BlockBits(std::mt19937_64& random)
    {
        const std::array<uint64_t, 2> words = {random(), random()};
        std::memcpy(block_.data(), words.data(), sizeof(words));
    }

    const Block& block() const { return block_; }

private:
    Block block_;
};

/// Kinds of random blocks: each draws what random bits seldom give.
enum class Kind
{
    bits,            ///< all random
    one_partition,   ///< with a drawn block mode and endpoint mode
    same_modes,      ///< several partitions with one endpoint mode
    different_modes, ///< several partitions with an endpoint mode each
    void_extent,
    edges, ///< endpoints with rows of bits that are all 0 or all 1
};
constexpr Kind kKinds[] = {Kind::bits,        Kind::one_partition, Kind::same_modes, Kind::different_modes,
                           Kind::void_extent, Kind::edges};

Block drawBlock(Kind kind, std::mt19937_64& random)
{
    const auto below = [&](uint64_t count) { return random() % count; };
    BlockBits bits(random);
    switch (kind)
    {
    case Kind::bits:
        break;
    case Kind::edges:
        for (uint32_t run = 0; run < 6; ++run)
        {
            const auto first = static_cast<uint32_t>(17 + below(100));
            const auto count = static_cast<uint32_t>(below(128 - first));
            bits.put(first, std::min(count, 64u), below(2) == 0 ? 0 : ~uint64_t{0});
        }
        [[fallthrough]];
    case Kind::one_partition:
        bits.put(11, 2, 0);
        break;
    case Kind::same_modes:
        bits.put(11, 2, 1 + below(3));
        bits.put(23, 2, 0);
        break;
    case Kind::different_modes:
        bits.put(11, 2, 1 + below(3));
        bits.put(23, 2, 1 + below(3));
        bits.put(25, 4, below(2) == 0 ? below(16) : 0);
        break;
    case Kind::void_extent:
        bits.put(0, 9, 0b111111100);
        if (below(8) != 0)
            bits.put(10, 2, 3);
        if (below(2) == 0)
            bits.put(12, 52, ~uint64_t{0});
        else if (below(2) == 0) // one texel from s to s or from t to t, or all but a bit of no extent
            for (uint32_t first = below(2) == 0 ? 12 : 38, i = 0; i < 13; ++i)
                bits.put(first + 13 + i, 1, bits.block()[(first + i) / 8] >> (first + i) % 8 & 1u);
        else
            bits.put(12, 52, ~(uint64_t{1} << below(52)));
        if (below(4) == 0)
            for (uint32_t channel = 0; channel < 4; ++channel)
                bits.put(64 + 16 * channel, 16, below(8));
        break;
    }
    return bits.block();
}

/// Number of blocks of each class.
using Classes = std::map<std::string, uint64_t>;
constexpr size_t kClasses = 3 + 7 + 16 + 12;

/// Count a block in the classes that it belongs to, by what libastcenc says of it.
void classify(const Block& block, const astcenc_block_info& info, Classes& classes)
{
    if (info.is_error_block)
        ++classes["illegal"];
    else if (info.is_constant_block)
        ++classes[(block[1] & 2) != 0 ? "void extent, hdr" : "void extent"];
    else
    {
        ++classes["partitions " + std::to_string(info.partition_count) +
                  (info.is_dual_plane_block ? ", 2 planes" : ", 1 plane")];
        for (uint32_t i = 0; i < info.partition_count; ++i)
            ++classes["endpoint mode " + std::to_string(info.color_endpoint_modes[i])];
        ++classes["weights of " + std::to_string(info.weight_level_count)];
    }
}

bool isNan(uint16_t half)
{
    return (half & 0x7FFF) > 0x7C00;
}

/// [value of 16 bits]: the largest half float that is not above value / 65536; 1 of 65535.
std::vector<uint16_t> listHalves()
{
    std::vector<uint16_t> halves(65536, 0x3C00);
    uint16_t half = 0;
    for (uint32_t value = 0; value < 65535; ++value)
    {
        while (floatFromHalf(static_cast<uint16_t>(half + 1)) * 65536 <= static_cast<float>(value))
            ++half;
        halves[value] = half;
    }
    return halves;
}

/// Return true if a texel is as libastcenc's. Two of its answers are other than the specification's table of
/// error colours in LDR formats: an illegal block is NaN, which the table allows for half floats, and the
/// magenta of HDR endpoints is 255/256.
bool isSame(const DecodedTexel& ours, const DecodedTexel& theirs, TexelCoding coding)
{
    static const std::vector<uint16_t> halves = listHalves();
    constexpr DecodedTexel kMagenta = {0xFFFF, 0, 0xFFFF, 0xFFFF};
    constexpr DecodedTexel kDarkMagenta = {0x3BF8, 0, 0x3BF8, 0x3BF8};
    if (coding != TexelCoding::float_value && isNan(theirs[0]))
        return ours == kMagenta;
    if (coding == TexelCoding::unorm && theirs == kDarkMagenta && ours == kMagenta)
        return true;
    for (size_t c = 0; c < 4; ++c)
        if (coding == TexelCoding::float_value ? ours[c] != theirs[c] && !(isNan(ours[c]) && isNan(theirs[c]))
                                               : halves[ours[c]] != theirs[c])
            return false;
    return true;
}

/// Count the texels of a row of blocks that libastcenc decodes differently.
uint64_t countDifferent(const TexelFormatTraits& traits, const std::vector<Block>& blocks,
                        const Astcenc& astcenc)
{
    const std::vector<DecodedTexel> theirs = astcenc.decode(blocks);
    std::vector<DecodedTexel> ours(size_t{traits.block_width} * traits.block_height);
    uint64_t different = 0;
    for (size_t column = 0; column < blocks.size(); ++column)
    {
        decodeAstcBlock(traits, std::as_bytes(std::span(blocks[column])), ours);
        for (size_t i = 0; i < ours.size(); ++i)
        {
            const size_t x = column * traits.block_width + i % traits.block_width, y = i / traits.block_width;
            different +=
                isSame(ours[i], theirs[y * blocks.size() * traits.block_width + x], traits.coding) ? 0u : 1u;
        }
    }
    return different;
}

struct Profile
{
    TexelFormat first;
    astcenc_profile astcenc;
};
constexpr Profile kProfiles[] = {{TexelFormat::astc_unorm, ASTCENC_PRF_LDR},
                                 {TexelFormat::astc_srgb, ASTCENC_PRF_LDR_SRGB},
                                 {TexelFormat::astc_float, ASTCENC_PRF_HDR}};

class DecodeAstcBlock : public testing::TestWithParam<uint32_t>
{
};

TEST_P(DecodeAstcBlock, isLibastcencsForRandomBlocks)
{
    std::mt19937_64 random(GetParam());
    Classes classes;
    for (const Profile& profile : kProfiles)
    {
        const TexelFormatTraits& traits = texelTraits(astcFormat(profile.first, GetParam()));
        SCOPED_TRACE(traits.name);
        const Astcenc astcenc(profile.astcenc, traits.block_width, traits.block_height);
        for (const Kind kind : kKinds)
            for (size_t count = blocksOfEachKind(); count > 0; count -= std::min<size_t>(count, kBatch))
            {
                std::vector<Block> blocks(std::min<size_t>(count, kBatch));
                for (Block& block : blocks)
                    block = drawBlock(kind, random);
                ASSERT_EQ(countDifferent(traits, blocks, astcenc), 0u) << static_cast<int>(kind);
                for (const Block& block : std::span(blocks).first(std::min(blocks.size(), kInspected)))
                    classify(block, astcenc.inspect(block), classes);
            }
    }
    if (HasFailure() || std::getenv("HEARTH_ASTC_TRIALS") != nullptr)
        for (const auto& [name, count] : classes)
            std::printf("%8llu  %s\n", static_cast<unsigned long long>(count), name.c_str());
    EXPECT_EQ(classes.size(), test::kSanitized ? classes.size() : kClasses);
}

/// Return the values of 16 bits of a block by the endpoints, weights and partitions that libastcenc reads:
/// half floats have too few bits for all of them.
DecodedTexel interpolate(const astcenc_block_info& info, size_t texel, size_t width)
{
    const size_t x = texel % width, y = texel / width, i = y * width + x;
    const uint32_t partition = info.partition_assignment[i];
    DecodedTexel out;
    for (size_t c = 0; c < 4; ++c)
    {
        const auto endpoint = [&](size_t end) {
            return std::min(255u, static_cast<uint32_t>(info.color_endpoints[partition][end][c] * 256)) * 257;
        };
        const float weight = info.is_dual_plane_block && c == info.dual_plane_component
                                 ? info.weight_values_plane2[i]
                                 : info.weight_values_plane1[i];
        // weights of libastcenc are from 0 to 4
        const auto sixtyfourths = static_cast<uint32_t>(weight * 16);
        out[c] =
            static_cast<uint16_t>((endpoint(0) * (64 - sixtyfourths) + endpoint(1) * sixtyfourths + 32) / 64);
    }
    return out;
}

TEST_P(DecodeAstcBlock, interpolatesSixteenBits)
{
    std::mt19937_64 random(GetParam());
    const TexelFormatTraits& traits = texelTraits(astcFormat(TexelFormat::astc_unorm, GetParam()));
    const Astcenc astcenc(ASTCENC_PRF_LDR, traits.block_width, traits.block_height);
    std::vector<DecodedTexel> texels(size_t{traits.block_width} * traits.block_height);
    size_t compared = 0;
    for (size_t trial = 0; trial < test::trials(400); ++trial)
    {
        const Block block = drawBlock(kKinds[trial % 4], random);
        const astcenc_block_info info = astcenc.inspect(block);
        if (info.is_error_block || info.is_constant_block)
            continue;
        decodeAstcBlock(traits, std::as_bytes(std::span(block)), texels);
        for (size_t i = 0; i < texels.size(); ++i)
            ASSERT_EQ(texels[i], interpolate(info, i, traits.block_width)) << trial << ' ' << i;
        ++compared;
    }
    if (!test::kSanitized) // too few blocks are tried there
        EXPECT_GT(compared, test::trials(400) / 20);
}

/// Draw a row of blocks with ramps, waves, an edge and noise; values up to `max`.
std::vector<DecodedTexel> drawRow(const TexelFormatTraits& traits, size_t columns, float max)
{
    const size_t width = columns * traits.block_width, height = traits.block_height;
    std::mt19937 random(7);
    std::vector<DecodedTexel> texels;
    for (size_t y = 0; y < height; ++y)
        for (size_t x = 0; x < width; ++x)
        {
            const auto u = static_cast<float>(x) / static_cast<float>(width);
            const auto v = static_cast<float>(y) / static_cast<float>(height);
            const float noise = static_cast<float>(random() % 256) / 256 * u;
            const bool side = (x + 2 * y) % 23 < 9;
            texels.push_back({halfFromFloat(u * max), halfFromFloat((side ? v : 0.9f) * max),
                              halfFromFloat((0.5f + 0.5f * std::sin(40 * u + 3 * v)) * max),
                              halfFromFloat(side ? 1 : noise)});
        }
    return texels;
}

TEST_P(DecodeAstcBlock, isLibastcencsForWhatItEncodes)
{
    for (const Profile& profile : kProfiles)
    {
        const TexelFormatTraits& traits = texelTraits(astcFormat(profile.first, GetParam()));
        SCOPED_TRACE(traits.name);
        const Astcenc astcenc(profile.astcenc, traits.block_width, traits.block_height, ASTCENC_PRE_FAST, 0);
        std::vector<DecodedTexel> row =
            drawRow(traits, test::trials(40), traits.coding == TexelCoding::float_value ? 20.0f : 1.0f);
        EXPECT_EQ(countDifferent(traits, astcenc.encode(row), astcenc), 0u);
    }
}

INSTANTIATE_TEST_SUITE_P(Footprints, DecodeAstcBlock, testing::Range(0u, kAstcFootprints),
                         [](const auto& row)
                         {
                             const auto& traits = texelTraits(astcFormat(TexelFormat::astc_unorm, row.param));
                             return std::to_string(traits.block_width) + "x" +
                                    std::to_string(traits.block_height);
                         });

} // namespace
} // namespace hearth::formats
