// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/codecs/vertex_codec.h"

#include <gtest/gtest.h>

#include <random>

namespace hearth::test
{

using namespace formats;

namespace
{

/// Angle in radians, from the chord: accurate for small angles.
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

/// Largest angle between random directions and their decoded codes.
template <int B>
double worstNormal(int count)
{
    std::mt19937 random(1);
    double worst = 0;
    for (int i = 0; i < count; ++i)
    {
        const Float3 direction = randomDirection(random);
        const uint32_t code = NormalCode<B>::encode(direction * 7.0f);
        EXPECT_TRUE(NormalCode<B>::legal(code));
        worst = std::max(worst, angle(direction, NormalCode<B>::decode(code)));
    }
    return worst;
}

/// Least angle between a direction and any code, by exhaustive search.
double leastAngle(Float3 direction)
{
    double least = 9;
    for (int32_t x = -127; x <= 127; ++x)
        for (int32_t y = -127; y <= 127; ++y)
            least = std::min(least, angle(direction, NormalCode<8>::decode(NormalCode<8>::pack(x, y))));
    return least;
}

constexpr double kDegree = 0.017453292519943295;

} // namespace

TEST(NormalCode, staysWithinWhatTheFormatStates)
{
    EXPECT_LT(worstNormal<8>(200000), 0.7 * kDegree);
    EXPECT_GT(worstNormal<8>(200000), 0.5 * kDegree) << "the bound that is stated is about the bound";
    EXPECT_LT(worstNormal<16>(200000), 0.003 * kDegree);
}

TEST(NormalCode, isTheBestOfAll)
{
    std::mt19937 random(5);
    for (int i = 0; i < 60; ++i)
    {
        const Float3 direction = randomDirection(random);
        const double found = angle(direction, NormalCode<8>::decode(NormalCode<8>::encode(direction)));
        // The encoder tries the four codes around the point of the square; a code farther off is sometimes
        // slightly better.
        EXPECT_LT(found, leastAngle(direction) * 1.02 + 1e-6);
    }
}

TEST(NormalCode, keepsTheAxes)
{
    for (int axis = 0; axis < 3; ++axis)
        for (const float sign : {-1.0f, 1.0f})
        {
            Float3 direction;
            direction[axis] = sign;
            EXPECT_LT(angle(NormalCode<8>::decode(NormalCode<8>::encode(direction)), direction), 1e-7);
            EXPECT_LT(angle(NormalCode<16>::decode(NormalCode<16>::encode(direction)), direction), 1e-7);
        }
}

TEST(NormalCode, encodesWhatItDecodedToTheSameCode)
{
    for (int32_t x = -126; x <= 126; ++x) // on the border two codes are one direction
        for (int32_t y = -126; y <= 126; ++y)
        {
            const uint32_t code = NormalCode<8>::pack(x, y);
            ASSERT_EQ(NormalCode<8>::encode(NormalCode<8>::decode(code)), code) << x << ' ' << y;
        }
    std::mt19937 random(2);
    std::uniform_int_distribution<int32_t> inner(-32766, 32766);
    for (int i = 0; i < 200000; ++i)
    {
        const uint32_t code = NormalCode<16>::pack(inner(random), inner(random));
        ASSERT_EQ(NormalCode<16>::encode(NormalCode<16>::decode(code)), code);
    }
}

TEST(NormalCode, decodesTheBorderToOneDirection)
{
    for (int32_t x : {-127, -100, -1, 0, 7, 127})
        EXPECT_LT(angle(NormalCode<8>::decode(NormalCode<8>::pack(x, 127)),
                        NormalCode<8>::decode(NormalCode<8>::pack(-x, 127))),
                  1e-6);
}

TEST(NormalCode, knowsWhatIsNoCode)
{
    EXPECT_FALSE(isLegalNormal(kVertexNormal, 0x0080));
    EXPECT_FALSE(isLegalNormal(kVertexNormal, 0x8000));
    EXPECT_FALSE(isLegalNormal(kVertexNormal, 0x10000));
    EXPECT_TRUE(isLegalNormal(kVertexNormal, 0x8181));
    EXPECT_FALSE(isLegalNormal(kVertexNormal | kVertexNormal16, 0x80000000));
    EXPECT_TRUE(isLegalNormal(kVertexNormal | kVertexNormal16, 0x80018001));
}

TEST(TangentCode, keepsTheFlipAndStaysWithinWhatTheFormatStates)
{
    std::mt19937 random(3);
    for (const auto& [layout, bound] : {std::pair{uint32_t{kVertexNormal}, 1.8 * kDegree},
                                        std::pair{kVertexNormal | kVertexNormal16, 0.008 * kDegree}})
    {
        double worst = 0;
        for (int i = 0; i < 200000; ++i)
        {
            const Float3 normal = decodeNormal(layout, encodeNormal(layout, randomDirection(random)));
            const Float3 t = normalizeOr(cross(normal, randomDirection(random)), {1, 0, 0});
            const float flip = i % 2 == 0 ? 1.0f : -1.0f;
            const uint32_t code = encodeTangent(layout, {t.x, t.y, t.z, flip}, normal);
            ASSERT_TRUE(isLegalTangent(layout, code));
            const Float4 back = decodeTangent(layout, code, normal);
            ASSERT_EQ(back.w, flip);
            ASSERT_NEAR(dot({back.x, back.y, back.z}, normal), 0, 1e-5);
            ASSERT_EQ(encodeTangent(layout, back, normal), code);
            worst = std::max(worst, angle(t, {back.x, back.y, back.z}));
        }
        EXPECT_LT(worst, bound);
        EXPECT_GT(worst, bound / 2);
    }
}

TEST(TangentCode, ofAVectorAlongTheNormalIsATangent)
{
    const Float3 normal{0, 0, 1};
    const uint32_t code = encodeTangent(kVertexNormal, {0, 0, 3, 1}, normal);
    EXPECT_TRUE(isLegalTangent(kVertexNormal, code));
    EXPECT_EQ(decodeTangent(kVertexNormal, code, normal).z, 0);
    EXPECT_FALSE(isLegalTangent(kVertexNormal, 0x100));
    EXPECT_FALSE(isLegalTangent(kVertexNormal | kVertexNormal16, 0x10000));
}

TEST(ColorWords, keepEveryCode)
{
    for (uint32_t code = 0; code <= 65535; ++code)
        ASSERT_EQ(quantizeUnorm(static_cast<float>(code) / 65535.0f, 65535), code);
    EXPECT_EQ(encodeColor(kVertexColor16, {-1, 0, 1, 7})[0], 0u);
    EXPECT_EQ(encodeColor(kVertexColor16, {-1, 0, 1, 7})[1], 0xFFFFFFFFu);
    for (uint32_t code = 0; code <= 255; ++code)
    {
        const float part = static_cast<float>(code) / 255.0f;
        const auto words = encodeColor(0, {part, 0, 1, part});
        ASSERT_EQ(words[0], code | 0xFF0000u | code << 24);
        ASSERT_EQ(decodeColor(0, words), (Float4{part, 0, 1, part}));
    }
}

TEST(GridCoordinates, areExact)
{
    std::mt19937 random(4);
    std::uniform_int_distribution<int32_t> coordinate(-kMaxGridCoordinate, kMaxGridCoordinate);
    for (int i = 0; i < 100000; ++i)
    {
        const int32_t c = coordinate(random);
        ASSERT_EQ(double{gridToFloat(c, 0x1p-20f)}, c * 0x1p-20);
    }
    EXPECT_EQ(uvStep(14), 1.0f / 16384);
}

TEST(AttributeWord, followsTheOrderOfTheBits)
{
    const uint32_t fine = kVertexAttributesAll | kVertexNormal16 | kVertexColor16; // UVs are floats
    EXPECT_EQ(attributeWord(fine, kVertexNormal), 2u);
    EXPECT_EQ(attributeWord(fine, kVertexTangent), 3u);
    EXPECT_EQ(attributeWord(fine, kVertexUv0), 4u);
    EXPECT_EQ(attributeWord(fine, kVertexUv3), 10u);
    EXPECT_EQ(attributeWord(fine, kVertexColor), 12u);
    EXPECT_EQ(attributeWord(fine, kVertexVisibility), 14u);
    const uint32_t all = kVertexAttributesAll | 0x1F1Eu << kVertexUvStepShift;
    EXPECT_EQ(attributeWord(all, kVertexNormal), 1u);
    EXPECT_EQ(attributeWord(all, kVertexTangent), 2u);
    EXPECT_EQ(attributeWord(all, kVertexUv2), 5u);
    EXPECT_EQ(attributeWord(all, kVertexColor), 7u);
    EXPECT_EQ(attributeWord(all, kVertexVisibility), 8u);
    EXPECT_EQ(attributeWord(all | kVertexWideOffsets, kVertexNormal), 3u);
    EXPECT_EQ(attributeWord(all | kVertexWideOffsets, kVertexUv1), 7u);
    const uint32_t grid1 = kVertexUv1 | kVertexColor | 14u << (kVertexUvStepShift + 4);
    EXPECT_EQ(attributeWord(grid1, kVertexUv1), 2u);
    EXPECT_EQ(attributeWord(grid1, kVertexColor), 3u);
    const uint32_t more = fine | kVertexInfluences | kVertexInfluences8;
    EXPECT_EQ(attributeWord(more, kVertexColor), 12u) << "influences stand behind the others";
    EXPECT_EQ(attributeWord(more, kVertexInfluences), 15u);
    EXPECT_EQ(attributeWord(kVertexInfluences | kVertexWideOffsets, kVertexInfluences), 3u);
}

TEST(MorphDelta, keepsBothParts)
{
    for (const int32_t position : {0, 1, -1, kMaxMorphPositionSteps, -kMaxMorphPositionSteps - 1})
        for (const int32_t normal : {0, 1, -1, 2047, -2048})
        {
            const uint32_t word = packMorphDelta(position, normal);
            EXPECT_EQ(morphPosition(word), position);
            EXPECT_EQ(morphNormal(word), normal);
        }
}

TEST(UvBaseWord, countsTheSetsOnGrids)
{
    const uint32_t sets = kVertexUv0 | kVertexUv1 | kVertexUv3;
    EXPECT_EQ(uvBaseWords(sets), 0u);
    EXPECT_EQ(uvBaseWords(sets | 0xE0EEu << kVertexUvStepShift), 6u);
    EXPECT_EQ(uvBaseWord(sets | 0xE0EEu << kVertexUvStepShift, 3), 4u);
    EXPECT_EQ(uvBaseWords(sets | 0xE00Eu << kVertexUvStepShift), 4u);
    EXPECT_EQ(uvBaseWord(sets | 0xE00Eu << kVertexUvStepShift, 3), 2u);
}

TEST(GridUvs, areTheSetsWithSteps)
{
    for (uint32_t steps = 0; steps <= 0xFFFF; ++steps)
    {
        uint32_t grids = 0;
        for (uint32_t set = 0; set < 4; ++set)
            grids |= (steps >> 4 * set & 15u) != 0 ? kVertexUv0 << set : 0;
        ASSERT_EQ(gridUvs(kVertexAttributesAll | kVertexWideOffsets | steps << kVertexUvStepShift), grids);
    }
}

TEST(LargestLayout, needsTheMostBytesOfAllWithItsAttributes)
{
    std::mt19937 random(7);
    for (int i = 0; i < 100000; ++i)
    {
        const auto layout = static_cast<uint32_t>(random());
        if (!isLegalLayout(layout))
            continue;
        const auto vertices = static_cast<uint32_t>(random() % 4);
        ASSERT_LE(clusterBytes(layout, vertices, 1), clusterBytes(worstCaseLayout(layout), vertices, 1))
            << layout;
        ASSERT_LE(clusterBytes(layout | kVertexWideOffsets, vertices, 1),
                  clusterBytes(worstCaseLayout(layout), vertices, 1))
            << layout;
    }
}

TEST(LegalLayout, saysWhatThereIsAndNothingElse)
{
    const uint32_t grid0 = 14u << kVertexUvStepShift;
    EXPECT_TRUE(isLegalLayout(0));
    EXPECT_TRUE(isLegalLayout(kVertexNormal | kVertexTangent | kVertexNormal16 | kVertexUv0 | grid0));
    EXPECT_TRUE(isLegalLayout(kVertexUv0)) << "floats";
    EXPECT_TRUE(isLegalLayout(kVertexUv0 | kVertexUv2 | grid0));
    EXPECT_FALSE(isLegalLayout(grid0)) << "a grid of no set";
    EXPECT_FALSE(isLegalLayout(kVertexUv0 | kVertexUv2 | grid0 << 4));
    EXPECT_TRUE(isLegalLayout(kVertexNormal | kVertexVisibility));
    EXPECT_FALSE(isLegalLayout(kVertexVisibility)) << "above no surface";
    EXPECT_FALSE(isLegalLayout(kVertexTangent)) << "an angle about nothing";
    for (const uint32_t bit : {1u << 10, 1u << 11, 1u << 12})
        EXPECT_FALSE(isLegalLayout(bit)) << "no meaning";
    EXPECT_FALSE(isLegalLayout(kVertexNormal16));
    EXPECT_FALSE(isLegalLayout(kVertexColor16));
    EXPECT_FALSE(isLegalLayout(kVertexWideOffsets)) << "of a cluster";
    EXPECT_TRUE(isLegalLayout(kVertexInfluences));
    EXPECT_TRUE(isLegalLayout(kVertexInfluences | kVertexInfluences8));
    EXPECT_FALSE(isLegalLayout(kVertexInfluences8)) << "more than none";
}

} // namespace hearth::test
