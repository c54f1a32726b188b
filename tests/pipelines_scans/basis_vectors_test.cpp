// Compares the decoders of Basis Universal with the texels that its own transcoder makes of its own encoder's
// files: frozen ones, and those of real models.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/basis_uastc.h"
#include "tests/pipelines_scans/frozen_basis.h"
#include "tests/pipelines_scans/ktx2_builder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace hearth::import
{

namespace
{

using namespace test;
using hearth::test::kEtc1sFiles;
using hearth::test::kUastcBlocks;

Bytes readHexadecimal(std::string_view digits)
{
    Bytes bytes(digits.size() / 2);
    for (size_t i = 0; i < bytes.size(); ++i)
        std::from_chars(&digits[2 * i], &digits[2 * i] + 2, bytes[i], 16);
    return bytes;
}

/// CRC-32 of PNG and zlib.
uint32_t computeCrc(std::span<const std::byte> bytes)
{
    std::array<uint32_t, 256> table{};
    for (uint32_t i = 0; i < 256; ++i)
    {
        table[i] = i;
        for (int bit = 0; bit < 8; ++bit)
            table[i] = table[i] >> 1 ^ ((table[i] & 1u) != 0 ? 0xEDB88320u : 0u);
    }
    uint32_t crc = 0xFFFFFFFFu;
    for (const std::byte byte : bytes)
        crc = crc >> 8 ^ table[(crc ^ std::to_integer<uint32_t>(byte)) & 0xFFu];
    return ~crc;
}

TEST(BasisVectors, blocksOfUastcAreTheTranscodersTexels)
{
    for (const auto& frozen : kUastcBlocks)
    {
        DecodedImage image{4, 4, ChannelType::unorm8, std::vector<std::byte>(64)};
        const Bytes block = readHexadecimal(frozen.block);
        ASSERT_TRUE(decodeUastc(std::as_bytes(std::span(block)), false, image)) << frozen.mode;
        EXPECT_EQ(computeCrc(image.texels), frozen.texels) << "mode " << frozen.mode << ": " << frozen.block;
    }
}

TEST(BasisVectors, filesOfEtc1sAreTheTranscodersTexels)
{
    for (const auto& frozen : kEtc1sFiles)
    {
        const auto image = decode(readHexadecimal(frozen.file));
        ASSERT_TRUE(image.ok()) << frozen.name << ": " << image.error().detail;
        EXPECT_EQ(image->width, frozen.width);
        EXPECT_EQ(image->height, frozen.height);
        EXPECT_EQ(computeCrc(image->texels), frozen.texels) << frozen.name;
    }
}

Bytes readAsset(const std::string& name)
{
    std::ifstream file(std::getenv("HEARTH_ASSETS") + ("/good/" + name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

uint64_t readNumber(const Bytes& bytes, size_t at, size_t size)
{
    uint64_t value = 0;
    std::memcpy(&value, &bytes.at(at), size);
    return value;
}

/// Find the KTX2 files in a GLB by their identifier; the end of one is that of its last level.
std::vector<Bytes> findKtx2(const Bytes& glb)
{
    constexpr std::array<uint8_t, 12> kIdentifier = {0xAB, 'K',  'T',  'X',  ' ',  '2',
                                                     '0',  0xBB, '\r', '\n', 0x1A, '\n'};
    std::vector<Bytes> files;
    auto at = glb.begin();
    while ((at = std::search(at, glb.end(), kIdentifier.begin(), kIdentifier.end())) != glb.end())
    {
        const auto start = static_cast<size_t>(at - glb.begin());
        const uint64_t levels = readNumber(glb, start + 40, 4);
        uint64_t end = 0;
        for (uint64_t level = 0; level < levels; ++level)
            end = std::max(end, readNumber(glb, start + 80 + 24 * level, 8) +
                                    readNumber(glb, start + 88 + 24 * level, 8));
        files.emplace_back(at, at + static_cast<ptrdiff_t>(end));
        ++at;
    }
    return files;
}

TEST(BasisVectors, texturesOfRealModelsAreTheTranscodersTexels)
{
    if (std::getenv("HEARTH_ASSETS") == nullptr)
        GTEST_SKIP() << "HEARTH_ASSETS is not set";
    const auto small = decode(readAsset("ktx2/ktx2_2d_etc1s/2d_etc1s.ktx2"));
    ASSERT_TRUE(small.ok()) << small.error().detail;
    EXPECT_EQ(computeCrc(small->texels), 0x67A6DD8Bu);

    const std::vector<Bytes> textures =
        findKtx2(readAsset("tex-ktx2/jet_fighter_ktx2_draco/jet-fighter.glb"));
    constexpr std::array<uint32_t, 3> kTexels = {0x97A4F325, 0xEA162C2B, 0x83D0CF74};
    ASSERT_EQ(textures.size(), kTexels.size());
    for (size_t i = 0; i < textures.size(); ++i)
    {
        const auto image = decode(textures[i]);
        ASSERT_TRUE(image.ok()) << image.error().detail;
        EXPECT_EQ(computeCrc(image->texels), kTexels[i]) << "texture " << i;
    }
}

} // namespace

} // namespace hearth::import
