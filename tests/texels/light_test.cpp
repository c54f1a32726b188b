// Light without limit keeps its target in each family, by the decoder of libastcenc.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/texels/search/search.h"
#include "formats/base/half.h"
#include "formats/texels/decode_texels.h"
#include "tests/texels/astc_reference.h"
#include "tests/texels/test_images.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

namespace hearth::texels
{

namespace
{

using namespace test;
using namespace formats;

constexpr uint32_t kSide = 128;

/// Sky over dark ground with grain, and a sun of 20,000.
std::vector<float> makeSky()
{
    std::mt19937 random(3);
    std::vector<float> texels;
    for (uint32_t y = 0; y < kSide; ++y)
        for (uint32_t x = 0; x < kSide; ++x)
        {
            const bool is_sun = (x - 40.0) * (x - 40.0) + (y - 20.0) * (y - 20.0) < 9;
            const double height = 1 - y / 64.0, grain = 1 + 0.8 * static_cast<double>(random() % 1000) / 1000;
            for (uint32_t c = 0; c < 3; ++c)
            {
                const double sky = (2 + c) * std::exp(-2 * height), ground = 0.4 * (3 - c) * grain;
                texels.push_back(static_cast<float>(is_sun ? 20'000 : height > 0 ? sky : ground));
            }
            texels.push_back(1);
        }
    return texels;
}

TestImage makeLight(std::span<const float> texels)
{
    TestImage image;
    image.record.width = image.record.height = kSide;
    image.record.mip_count = 1;
    image.record.format = static_cast<uint32_t>(TexelFormat::rgba16_float);
    image.mips.resize(texels.size() * 2);
    for (size_t i = 0; i < texels.size(); ++i)
    {
        const uint16_t half = halfFromFloat(texels[i]);
        std::memcpy(&image.mips[2 * i], &half, sizeof(half));
    }
    return image;
}

/// Root of the mean square of the differences in stops: log2(1 + light).
double recount(std::span<const float> plain, std::span<const float> stored)
{
    double sum = 0;
    for (size_t i = 0; i < plain.size(); ++i)
        if (i % 4 < 3)
            sum += std::pow(std::log2((1 + double{plain[i]}) / (1 + double{stored[i]})), 2);
    return std::sqrt(sum / (0.75 * static_cast<double>(plain.size())));
}

/// Decode with libastcenc where it can.
std::vector<float> decode(const Encoding& encoding)
{
    const TexelFormatTraits& traits = *encoding.candidate.traits;
    if (traits.family == TexelFamily::astc_hdr)
        return decodeByAstcenc(traits, kSide, kSide, encoding.texels);
    std::vector<float> texels;
    for (const DecodedTexel& texel : decodeMip(traits, kSide, kSide, encoding.texels))
        for (const uint16_t channel : texel)
            texels.push_back(floatFromHalf(channel));
    return texels;
}

TEST(Light, holdsItsTargetInEachFamily)
{
    const std::vector<float> sky = makeSky();
    const TestImage image = makeLight(sky);
    const PlainImage plain = image.plain(ImageRole::light, kRgb);
    for (const Families& families : {Families{.astc_hdr = true}, Families{.bc = true}, Families{}})
    {
        const std::vector<Candidate> candidates = listCandidates(plain, families);
        const Target target = findTarget(ImageRole::light, Effort::normal);
        const Encoding encoding = encodeForTarget(plain, candidates, target, Effort::normal, false);
        SCOPED_TRACE(encoding.candidate.traits->name);
        EXPECT_NEAR(recount(sky, decode(encoding)), encoding.error.error, 0.002);
        EXPECT_LE(encoding.error.error, target.error);
    }
}

TEST(Light, takesFewerBitsWhereMoreErrorIsAllowed)
{
    const TestImage image = makeLight(makeSky());
    const PlainImage plain = image.plain(ImageRole::light, kRgb);
    const std::vector<Candidate> candidates = listCandidates(plain, {.astc_hdr = true});
    double bits = 0;
    for (const Effort quality : {Effort::draft, Effort::high})
    {
        const Target target = findTarget(ImageRole::light, quality);
        const Encoding encoding = encodeForTarget(plain, candidates, target, Effort::normal, false);
        EXPECT_EQ(encoding.candidate.traits->family, TexelFamily::astc_hdr);
        EXPECT_GT(encoding.candidate.bitsPerTexel(), bits);
        bits = encoding.candidate.bitsPerTexel();
    }
}

TEST(Light, isNeverNegativeAndHasNoAlpha)
{
    std::vector<float> texels(size_t{kSide} * kSide * 4, -3.0f);
    const TestImage image = makeLight(texels);
    const PlainImage plain = image.plain(ImageRole::light, kRgb);
    for (const Candidate& candidate : listCandidates(plain, {.astc_hdr = true, .bc = true}))
    {
        std::vector<DecodedTexel> read =
            decodeMip(*candidate.traits, kSide, kSide, encodeImage(plain, {}, candidate, Effort::draft));
        readStored(candidate, read);
        for (const DecodedTexel& texel : read)
            ASSERT_EQ(texel, (DecodedTexel{0, 0, 0, kHalfOne})) << candidate.traits->name;
    }
}

} // namespace

} // namespace hearth::texels
