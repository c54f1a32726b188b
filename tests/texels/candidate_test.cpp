// Channels come back through layout and swizzle, whatever a format stores.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/encoding/candidate.h"
#include "cook/texels/encoding/encode.h"
#include "cook/texels/role.h"
#include "tests/texels/test_images.h"

#include <gtest/gtest.h>

namespace hearth::texels
{

namespace
{

using namespace test;
using namespace formats;

constexpr Families kAll{.astc = true, .etc2 = true, .bc = true};

/// Return what a shader reads where the encoder changes nothing.
DecodedTexel readBack(const PlainImage& image, const Candidate& candidate, const DecodedTexel& texel)
{
    StoredTexels stored = arrangeChannels(image, candidate, 1, 1, std::span(&texel, 1));
    readStored(candidate, stored.texels);
    return stored.texels[0];
}

TEST(Candidates, everyLayoutGivesBackTheChannelsThatAreRead)
{
    const TestImage noise = makeImage(8, 8, 1, TexelFormat::rgba8_unorm,
                                      [random = std::mt19937(1)](uint32_t, double, double) mutable
                                      { return static_cast<double>(random() & 255) / 255; });
    for (uint32_t channels = 1; channels < 16; ++channels)
    {
        const PlainImage image = noise.plain(ImageRole::data, static_cast<Channels>(channels));
        for (const Candidate& candidate : listCandidates(image, kAll))
            for (const DecodedTexel& texel : decodeRows(image, 0, 0, 8))
            {
                const DecodedTexel read = readBack(image, candidate, texel);
                for (uint32_t c = 0; c < 4; ++c)
                    EXPECT_EQ(read[c], has(image.channels, c) ? texel[c] : 0xFFFF)
                        << candidate.traits->name << ", channels " << channels;
            }
    }
}

TEST(Candidates, channelsOfZeroOrOneAreNotStored)
{
    const TestImage rough = makeImage(8, 8, 1, TexelFormat::rgba8_unorm,
                                      [](uint32_t c, double x, double) {
                                          return c == 1 ? x : c == 2 ? 0 : 1;
                                      });
    const PlainImage image = rough.plain(ImageRole::data, kRgb);
    const Candidate plain = listCandidates(image, {}).back();
    EXPECT_EQ(plain.traits->format, TexelFormat::r8_unorm);
    EXPECT_EQ(plain.swizzle, (std::array{Swizzle::one, Swizzle::red, Swizzle::zero, Swizzle::one}));
    for (const Candidate& candidate : listCandidates(image, kAll))
        for (const DecodedTexel& texel : decodeRows(image, 0, 0, 8))
            EXPECT_EQ(readBack(image, candidate, texel), (DecodedTexel{0xFFFF, texel[1], 0, 0xFFFF}))
                << candidate.traits->name;
}

TEST(Candidates, areAscendingWithThePlainOneLast)
{
    const TestImage color = makeImage(16, 16, 1, TexelFormat::rgba8_srgb, photographic(0.1));
    const std::vector<Candidate> candidates = listCandidates(color.plain(ImageRole::color, kRgb), kAll);
    ASSERT_GT(candidates.size(), 1u);
    for (size_t i = 1; i < candidates.size(); ++i)
        EXPECT_GE(candidates[i].bitsPerTexel(), candidates[i - 1].bitsPerTexel());
    EXPECT_EQ(candidates.back().traits->format, TexelFormat::rgba8_srgb);
    for (const Candidate& candidate : candidates)
        EXPECT_EQ(candidate.traits->coding, TexelCoding::srgb) << candidate.traits->name;
}

TEST(Candidates, aTargetWithoutFamiliesKeepsPlainTexels)
{
    const TestImage color = makeImage(16, 16, 1, TexelFormat::rgba8_srgb, photographic(0.1));
    EXPECT_EQ(listCandidates(color.plain(ImageRole::color, kRgb), {}).size(), 1u);
}

TEST(Roles, comeFromUsesAndAlphaModes)
{
    MaterialRecord opaque{}, masked{};
    masked.alpha_mode = static_cast<uint32_t>(AlphaMode::mask);
    const std::vector<MaterialRecord> materials{opaque, masked};
    const auto read = [&](TexelFormat format, uint32_t flags, std::vector<ImageUse> uses)
    {
        ImageRecord record{};
        record.format = static_cast<uint32_t>(format);
        record.flags = flags;
        const ImageReads reads = findReads(record, uses, materials);
        return std::pair(reads.role, reads.channels);
    };
    constexpr TexelFormat kColor = TexelFormat::rgba8_srgb, kData = TexelFormat::rgba8_unorm;
    EXPECT_EQ(read(kColor, 0, {{0, "baseColor"}}), std::pair(ImageRole::color, kRgb));
    EXPECT_EQ(read(kColor, 0, {{0, "baseColor"}, {1, "baseColor"}}),
              std::pair(ImageRole::cutout, static_cast<Channels>(kRgb | kAlpha)));
    EXPECT_EQ(read(kColor, 0, {{0, "emissive"}}), std::pair(ImageRole::emissive, kRgb));
    EXPECT_EQ(read(kColor, 0, {{0, "emissive"}, {0, "baseColor"}}), std::pair(ImageRole::color, kRgb));
    EXPECT_EQ(read(kData, 0, {{0, "metallicRoughness"}}),
              std::pair(ImageRole::data, static_cast<Channels>(kGreen | kBlue)));
    EXPECT_EQ(read(kData, 0, {{0, "metallicRoughness"}, {0, "occlusion"}}), std::pair(ImageRole::data, kRgb));
    EXPECT_EQ(read(kData, kImageNormalMap, {{0, "normal"}}),
              std::pair(ImageRole::normal, static_cast<Channels>(kRed | kGreen)));
    EXPECT_EQ(read(TexelFormat::rgba16_float, 0, {{0, "emissive"}}).first, ImageRole::light);
    EXPECT_EQ(read(kColor, 0, {{0, "sheen"}}),
              std::pair(ImageRole::color, static_cast<Channels>(kRgb | kAlpha)));
    EXPECT_EQ(read(kData, 0, {}).second, kRgb | kAlpha) << "nobody knows what an image without a use is for";
}

} // namespace

} // namespace hearth::texels
