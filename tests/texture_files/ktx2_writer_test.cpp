// Checks written KTX2 files by the specifications' rules and examples, read here once more.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/texture_files/ktx2_writer.h"

#include "pipelines/texture_files/data_format.h"

#include <gtest/gtest.h>

#include <zstd.h>

#include <algorithm>
#include <map>
#include <string>

namespace hearth::texture_files
{
namespace
{

using namespace formats;

using Bytes = std::vector<std::byte>;

constexpr uint32_t kWidth = 37, kHeight = 21, kMips = 6;

/// Draw a texture's texels.
Bytes drawMips(const TexelFormatTraits& traits)
{
    uint64_t size = 0;
    for (uint32_t i = 0; i < kMips; ++i)
        size += mipBytes(traits, std::max(1u, kWidth >> i), std::max(1u, kHeight >> i));
    Bytes mips(static_cast<size_t>(size));
    for (size_t i = 0; i < mips.size(); ++i)
        mips[i] = static_cast<std::byte>(i * i / 7 + i);
    return mips;
}

Bytes write(const TexelFormatTraits& traits, const Bytes& mips, bool compressed,
            const std::string& swizzle = "rgba")
{
    return writeKtx2({&traits, kWidth, kHeight, kMips, mips, swizzle}, "Hearth test 123", compressed);
}

/// Fields of a file, read as the specification of KTX 2.0 numbers them.
class Ktx2Fields
{
public:
    explicit Ktx2Fields(const Bytes& file) : file_(file) {}

    uint64_t read(size_t at, size_t size) const
    {
        uint64_t number = 0;
        for (size_t i = size; i-- > 0;)
            number = number << 8 | std::to_integer<uint64_t>(file_.at(at + i));
        return number;
    }
    uint32_t word(size_t at) const { return static_cast<uint32_t>(read(at, 4)); }

    uint64_t levelOffset(uint32_t level) const { return read(80 + 24 * level, 8); }
    uint64_t levelBytes(uint32_t level) const { return read(88 + 24 * level, 8); }
    uint64_t levelUncompressedBytes(uint32_t level) const { return read(96 + 24 * level, 8); }

    /// Return the entries of key and value; their padding must be 0.
    std::vector<std::pair<std::string, std::string>> entries() const
    {
        std::vector<std::pair<std::string, std::string>> entries;
        for (size_t at = word(56), end = at + word(60); at < end;)
        {
            std::string text;
            for (size_t i = 0; i < word(at); ++i)
                text += static_cast<char>(file_.at(at + 4 + i));
            const size_t key = text.find('\0');
            entries.emplace_back(text.substr(0, key), text.substr(key + 1));
            at += 4 + text.size();
            for (; at % 4 != 0; ++at)
                EXPECT_EQ(file_.at(at), std::byte{0});
        }
        return entries;
    }

private:
    const Bytes& file_;
};

/// Check the rules of the layout that hold for every file of one texture with mips.
void checkLayout(const Bytes& file, const TexelFormatTraits& traits, bool compressed)
{
    const Ktx2Fields fields(file);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(file.data()), 12), "\xABKTX 20\xBB\r\n\x1A\n");
    EXPECT_EQ(fields.word(12), traits.vulkan_format);
    EXPECT_EQ(fields.word(20), kWidth);
    EXPECT_EQ(fields.word(24), kHeight);
    EXPECT_EQ(fields.word(28), 0u) << "depth";
    EXPECT_EQ(fields.word(32), 0u) << "no array";
    EXPECT_EQ(fields.word(36), 1u) << "faces";
    EXPECT_EQ(fields.word(40), kMips);
    EXPECT_EQ(fields.word(44), compressed ? 2u : 0u);
    const size_t descriptor = fields.word(48);
    EXPECT_EQ(descriptor, 80 + 24 * kMips);
    EXPECT_EQ(fields.word(52), fields.word(descriptor)) << "the descriptor's own size";
    EXPECT_EQ(fields.word(56), descriptor + fields.word(52));
    EXPECT_EQ(fields.read(64, 8), 0u);
    EXPECT_EQ(fields.read(72, 8), 0u);

    uint64_t end = uint64_t{fields.word(56)} + fields.word(60), alignment = 1;
    if (!compressed)
        while (alignment % 4 != 0 || alignment % traits.block_bytes != 0)
            ++alignment;
    for (uint32_t level = kMips; level-- > 0;)
    {
        for (; end % alignment != 0; ++end)
            EXPECT_EQ(fields.read(static_cast<size_t>(end), 1), 0u) << "padding";
        EXPECT_EQ(fields.levelOffset(level), end) << level;
        EXPECT_EQ(fields.levelUncompressedBytes(level),
                  mipBytes(traits, std::max(1u, kWidth >> level), std::max(1u, kHeight >> level)));
        end += fields.levelBytes(level);
    }
    EXPECT_EQ(end, file.size());
}

/// Check that the samples of a descriptor cover all bits of a block, and nothing more.
void checkDescriptor(const TexelFormatTraits& traits)
{
    const std::vector<uint32_t> words = describeTexels(traits);
    ASSERT_EQ(words[0], 4 * words.size());
    EXPECT_EQ(words[1], 0u);
    EXPECT_EQ(words[2], 2 | (words[0] - 4) << 16);
    EXPECT_EQ(words[3] >> 8, 1u | (traits.coding == TexelCoding::srgb ? 2u : 1u) << 8);
    EXPECT_EQ(words[4], (traits.block_width - 1u) | (traits.block_height - 1u) << 8);
    EXPECT_EQ(words[5], traits.block_bytes);
    EXPECT_EQ(words[6], 0u);
    std::vector<bool> bits(8u * traits.block_bytes);
    for (size_t at = 7; at < words.size(); at += 4)
    {
        const uint32_t first = words[at] & 0xFFFF, count = 1 + (words[at] >> 16 & 0xFF),
                       channel = words[at] >> 24;
        ASSERT_LE(first + count, bits.size());
        std::fill_n(bits.begin() + first, count, true);
        EXPECT_EQ((channel & 0x80) != 0,
                  traits.coding == TexelCoding::float_value && traits.format != TexelFormat::rgb9e5_float);
        EXPECT_EQ((channel & 0x40) != 0,
                  traits.coding == TexelCoding::snorm || ((channel & 0x80) != 0 && words[at + 2] != 0));
        EXPECT_EQ((channel & 0x10) != 0, traits.coding == TexelCoding::srgb && (channel & 15) == 15);
        EXPECT_EQ(words[at + 1], 0u);
    }
    EXPECT_EQ(std::count(bits.begin(), bits.end(), false), 0);
}

TEST(WriteKtx2, keepsTheRulesInEveryFormat)
{
    size_t tried = 0;
    for (const TexelFormatTraits& traits : detail::kTexelFormats)
    {
        if (traits.vulkan_format == 0)
            continue;
        SCOPED_TRACE(traits.name);
        const Bytes mips = drawMips(traits), file = write(traits, mips, false);
        checkLayout(file, traits, false);
        checkDescriptor(traits);
        const Ktx2Fields fields(file);
        size_t from = 0;
        for (uint32_t level = 0; level < kMips; ++level)
        {
            const auto at = static_cast<size_t>(fields.levelOffset(level)),
                       size = static_cast<size_t>(fields.levelBytes(level));
            EXPECT_EQ(size, fields.levelUncompressedBytes(level));
            EXPECT_TRUE(std::equal(file.begin() + static_cast<ptrdiff_t>(at),
                                   file.begin() + static_cast<ptrdiff_t>(at + size),
                                   mips.begin() + static_cast<ptrdiff_t>(from)));
            from += size;
        }
        ++tried;
    }
    EXPECT_GT(tried, 70u);
}

TEST(WriteKtx2, compressesEachMip)
{
    const TexelFormatTraits& traits = *findTexelFormat("astc-6x5-srgb");
    const Bytes mips = drawMips(traits), file = write(traits, mips, true);
    checkLayout(file, traits, true);
    const Ktx2Fields fields(file);
    size_t from = 0;
    for (uint32_t level = 0; level < kMips; ++level)
    {
        Bytes texels(static_cast<size_t>(fields.levelUncompressedBytes(level)));
        const std::byte* const frame = file.data() + fields.levelOffset(level);
        const auto size = static_cast<size_t>(fields.levelBytes(level));
        EXPECT_EQ(ZSTD_getFrameContentSize(frame, size), texels.size());
        EXPECT_EQ(ZSTD_decompress(texels.data(), texels.size(), frame, size), texels.size());
        EXPECT_TRUE(std::equal(texels.begin(), texels.end(), mips.begin() + static_cast<ptrdiff_t>(from)));
        from += texels.size();
    }
}

TEST(WriteKtx2, sortsKeys)
{
    using Entries = std::vector<std::pair<std::string, std::string>>;
    using namespace std::string_literals;
    const TexelFormatTraits& traits = *findTexelFormat("astc-4x4-unorm");
    const Bytes mips = drawMips(traits);
    EXPECT_EQ(Ktx2Fields(write(traits, mips, false)).entries(),
              (Entries{{"KTXorientation", "rd\0"s}, {"KTXwriter", "Hearth test 123\0"s}}));
    EXPECT_EQ(Ktx2Fields(write(traits, mips, false, "ra01")).entries(),
              (Entries{{"KTXorientation", "rd\0"s},
                       {"KTXswizzle", "ra01\0"s},
                       {"KTXwriter", "Hearth test 123\0"s}}));
}

TEST(WriteKtx2, writesTypeSizes)
{
    const std::map<std::string, uint32_t> sizes = {
        {"rgba8-srgb", 1},   {"rg8-unorm", 1},   {"rgba16-float", 2},  {"rgba16-unorm", 2},
        {"rgb9e5-float", 4}, {"bc6h-ufloat", 1}, {"astc-4x4-float", 1}};
    for (const auto& [name, size] : sizes)
    {
        const TexelFormatTraits& traits = *findTexelFormat(name);
        EXPECT_EQ(Ktx2Fields(write(traits, drawMips(traits), false)).word(16), size) << name;
    }
}

/// Descriptors from the words of a block on, as the examples of the Data Format Specification have them.
TEST(DescribeTexels, isLikeTheSpecificationsExamples)
{
    using Words = std::vector<uint32_t>;
    constexpr uint32_t kOneSample = 40u << 16 | 2, kTwoSamples = 56u << 16 | 2;
    const auto describe = [](const char* name) { return describeTexels(*findTexelFormat(name)); };
    EXPECT_EQ(describe("bc6h-sfloat"),
              (Words{44, 0, kOneSample, 0x00010185, 0x0303, 16, 0, 0xC07F0000, 0, 0xBF800000, 0x3F800000}));
    EXPECT_EQ(describe("bc6h-ufloat"),
              (Words{44, 0, kOneSample, 0x00010185, 0x0303, 16, 0, 0x807F0000, 0, 0, 0x3F800000}));
    EXPECT_EQ(describe("bc1-rgba-unorm"),
              (Words{44, 0, kOneSample, 0x00010180, 0x0303, 8, 0, 0x013F0000, 0, 0, 0xFFFFFFFF}));
    EXPECT_EQ(describe("etc2-rgb8a1-unorm"), (Words{60, 0, kTwoSamples, 0x000101A1, 0x0303, 8, 0, 0x023F0000,
                                                    0, 0, 0xFFFFFFFF, 0x0F3F0000, 0, 0, 0xFFFFFFFF}));
    EXPECT_EQ(describe("etc2-rgba8-srgb"), (Words{60, 0, kTwoSamples, 0x000201A1, 0x0303, 16, 0, 0x1F3F0000,
                                                  0, 0, 0xFFFFFFFF, 0x023F0040, 0, 0, 0xFFFFFFFF}));
    EXPECT_EQ(describe("bc5-snorm"), (Words{60, 0, kTwoSamples, 0x00010184, 0x0303, 16, 0, 0x403F0000, 0,
                                            0x80000000, 0x7FFFFFFF, 0x413F0040, 0, 0x80000000, 0x7FFFFFFF}));
    EXPECT_EQ(describe("astc-8x5-float"),
              (Words{44, 0, kOneSample, 0x000101A2, 0x0407, 16, 0, 0xC07F0000, 0, 0xBF800000, 0x3F800000}));
    EXPECT_EQ(describe("rgb9e5-float"), (Words{124, 0, 120u << 16 | 2, 0x00010101, 0, 4,  0,  0x00080000,
                                               0,   0, 8448,           0x2004001B, 0, 15, 31, 0x01080009,
                                               0,   0, 8448,           0x2104001B, 0, 15, 31, 0x02080012,
                                               0,   0, 8448,           0x2204001B, 0, 15, 31}));
    EXPECT_EQ(describe("rg8-unorm"),
              (Words{60, 0, kTwoSamples, 0x00010101, 0, 2, 0, 0x00070000, 0, 0, 255, 0x01070008, 0, 0, 255}));
}

} // namespace
} // namespace hearth::texture_files
