// Texture files that end too early or have other bytes are refused, or decoded to something, by one message.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/records/texel_format.h"
#include "pipelines/texture_files/ktx2_writer.h"
#include "tests/pipelines_scans/dds_builder.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>

#include <random>

namespace hearth::import
{

namespace
{

using namespace test;

/// Limits that a damaged size exceeds soon.
constexpr ImportLimits kLimits{.max_image_texels = 1 << 16, .max_image_size = 1 << 10};

Bytes writeTexture(const char* format, bool compressed)
{
    const formats::TexelFormatTraits& traits = *formats::findTexelFormat(format);
    std::vector<std::byte> mips;
    for (uint32_t i = 0; i < 3; ++i)
        for (uint64_t at = formats::mipBytes(traits, 13u >> i, 9u >> i); at-- > 0;)
            mips.push_back(static_cast<std::byte>(at * at + 3 * at));
    const auto file = texture_files::writeKtx2({&traits, 13, 9, 3, mips, "rgb1"}, "test", compressed);
    const auto* const bytes = reinterpret_cast<const uint8_t*>(file.data());
    return {bytes, bytes + file.size()};
}

/// Return sound files of every kind of header and of texels.
std::vector<Bytes> soundFiles()
{
    std::vector<Bytes> files;
    for (const bool compressed : {false, true})
        for (const char* format : {"astc-6x5-srgb", "bc6h-sfloat", "etc2-rgb8a1-srgb", "rg8-unorm"})
            files.push_back(writeTexture(format, compressed));
    Dds bc7 = Dds::withDxgi(98, Bytes(16 * 4 * 3, 0x5A));
    bc7.width = 13;
    bc7.height = 9;
    files.push_back(bc7.file());
    files.push_back(Dds::withCode("DXT5", Bytes(16, 0xA5)).file());
    files.push_back(Dds().file());
    return files;
}

Result<DecodedImage> decodeLimited(const Bytes& bytes)
{
    return decodeImage(std::as_bytes(std::span(bytes)), "texture", kLimits);
}

TEST(DamagedTextures, areRefusedWhereverTheyEnd)
{
    for (const Bytes& file : soundFiles())
    {
        const auto whole = decodeLimited(file);
        ASSERT_TRUE(whole.ok()) << formatMessage(whole.error());
        for (size_t size = 0; size < file.size(); ++size)
        {
            // a copy of its own, so that a sanitizer sees a read past the end
            const auto image =
                decodeLimited({file.begin(), file.begin() + static_cast<std::ptrdiff_t>(size)});
            ASSERT_FALSE(image.ok()) << size << " of " << file.size();
            ASSERT_EQ(image.error().issue, Issue::image_malformed);
            ASSERT_FALSE(image.error().detail.empty());
        }
    }
}

TEST(DamagedTextures, haveOneMessage)
{
    std::mt19937 random(7);
    size_t refused = 0, read = 0;
    for (const Bytes& file : soundFiles())
        for (size_t trial = 0; trial < hearth::test::trials(1000); ++trial)
        {
            Bytes damaged = file;
            for (size_t i = 0; i < 1 + trial % 3; ++i)
            {
                // three of four in the headers
                const size_t end = random() % 4 == 0 ? file.size() : std::min<size_t>(file.size(), 300);
                damaged[random() % end] ^= static_cast<uint8_t>(1u << random() % 8);
            }
            const auto image = decodeLimited(damaged);
            if (image.ok())
            {
                ++read;
                ASSERT_EQ(image->texels.size(), size_t{image->width} * image->height * image->texelBytes());
                continue;
            }
            ++refused;
            const Issue issue = image.error().issue;
            ASSERT_TRUE(issue == Issue::image_malformed || issue == Issue::image_unsupported ||
                        issue == Issue::input_too_large);
            ASSERT_FALSE(image.error().detail.empty());
        }
    EXPECT_GT(refused, read / 10);
    EXPECT_GT(read, refused / 10);
}

TEST(DamagedTextures, areRefusedForEveryNumberOfTheLevelIndex)
{
    const Bytes file = writeTexture("bc7-srgb", false);
    for (size_t at = 48; at < 80 + 3 * 24; at += 4)
        for (const uint32_t value : {1u, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFFu})
        {
            if (at >= 64 && at < 80 && value == 1) // no global data, but of a size or place
                continue;
            Bytes damaged = file;
            std::memcpy(damaged.data() + at, &value, sizeof(value));
            EXPECT_FALSE(decodeLimited(damaged).ok()) << at << ": " << value;
        }
}

} // namespace

} // namespace hearth::import
