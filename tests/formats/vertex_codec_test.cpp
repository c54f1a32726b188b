// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/vertex_codec.h"

#include <gtest/gtest.h>

#include <random>

namespace hearth::test
{

using namespace formats;

namespace
{

/// Angle in radians, from the chord: exact for small angles.
double angle(Float3 a, Float3 b)
{
    const double x = double{a.x} - b.x, y = double{a.y} - b.y, z = double{a.z} - b.z;
    return 2 * std::asin(std::min(1.0, std::sqrt(x * x + y * y + z * z) / 2));
}

Float3 randomDirection(std::mt19937& random)
{
    std::normal_distribution<float> normal;
    return normalizeOr({normal(random), normal(random), normal(random)}, {0, 0, 1});
}

} // namespace

TEST(OctahedralNormal, staysWithinAQuantum)
{
    std::mt19937 random(1);
    double worst = 0;
    for (int i = 0; i < 200000; ++i)
    {
        const Float3 direction = randomDirection(random);
        const uint32_t word = encodeNormal(direction);
        ASSERT_TRUE(legalOctahedral(word));
        worst = std::max(worst, angle(direction, decodeNormal(word)));
    }
    // half a quantum in x and y, stretched by at most 3 where the octahedron's faces meet the sphere
    EXPECT_LT(worst, 3 * 0.7072 / 32767);
}

TEST(OctahedralNormal, keepsTheAxes)
{
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.0f, 1.0f})
        {
            Float3 direction;
            direction[axis] = sign;
            EXPECT_LT(angle(decodeNormal(encodeNormal(direction)), direction), 1e-7);
        }
}

TEST(OctahedralNormal, encodesWhatItDecodedToTheSameWord)
{
    std::mt19937 random(2);
    std::uniform_int_distribution<int32_t> inner(-32766, 32766); // on the border two codes are one direction
    for (int i = 0; i < 200000; ++i)
    {
        const uint32_t word = packHalves(inner(random), inner(random));
        ASSERT_EQ(encodeNormal(decodeNormal(word)), word);
    }
}

TEST(OctahedralNormal, decodesTheBorderToOneDirection)
{
    for (int32_t x : {-32767, -12345, -1, 0, 7, 32767})
        EXPECT_LT(angle(decodeNormal(packHalves(x, 32767)), decodeNormal(packHalves(-x, 32767))), 1e-6);
}

TEST(OctahedralTangent, keepsTheFlipAndStaysWithinAQuantum)
{
    std::mt19937 random(3);
    double worst = 0;
    for (int i = 0; i < 200000; ++i)
    {
        const Float3 d = randomDirection(random);
        const float flip = i % 2 == 0 ? 1.0f : -1.0f;
        const uint32_t word = encodeTangent({d.x, d.y, d.z, flip});
        ASSERT_TRUE(legalOctahedral(word));
        const Float4 back = decodeTangent(word);
        ASSERT_EQ(back.w, flip);
        worst = std::max(worst, angle(d, {back.x, back.y, back.z}));
        const bool border = std::abs(lowHalf(word)) == 32767 || std::abs(highHalf(word)) == 32767;
        ASSERT_TRUE(border || encodeTangent(back) == word) << d.x << ' ' << d.y << ' ' << d.z;
    }
    EXPECT_LT(worst, 3 * 1.1181 / 32767) << "half a quantum in x, one in y";
}

TEST(OctahedralTangent, isLegalOnTheBorder)
{
    for (const float y : {-1.0f, 1.0f})
        for (const float flip : {-1.0f, 1.0f})
        {
            const uint32_t word = encodeTangent({0, y, 0, flip});
            EXPECT_TRUE(legalOctahedral(word));
            EXPECT_EQ(decodeTangent(word).w, flip);
            EXPECT_NEAR(decodeTangent(word).y, y, 1e-6);
        }
}

TEST(ColorWords, keepEveryCode)
{
    for (uint32_t code = 0; code <= 65535; ++code)
        ASSERT_EQ(quantizeUnorm16(dequantizeUnorm16(code)), code);
    const ColorWords words = encodeColor({-1, 0, 1, 7});
    EXPECT_EQ(words.word[0], 0u);
    EXPECT_EQ(words.word[1], 0xFFFFFFFFu);
}

TEST(AttributeWord, followsTheOrderOfTheBits)
{
    const uint32_t all = kVertexAttributesAll;
    EXPECT_EQ(attributeWord(all, kVertexNormal), 3u);
    EXPECT_EQ(attributeWord(all, kVertexTangent), 4u);
    EXPECT_EQ(attributeWord(all, kVertexUv0), 5u);
    EXPECT_EQ(attributeWord(all, kVertexUv3), 11u);
    EXPECT_EQ(attributeWord(all, kVertexColor), 13u);
    EXPECT_EQ(attributeWord(kVertexUv1 | kVertexColor, kVertexUv1), 3u);
    EXPECT_EQ(attributeWord(kVertexUv1 | kVertexColor, kVertexColor), 5u);
}

} // namespace hearth::test
