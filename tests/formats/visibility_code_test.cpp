// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/codecs/visibility_code.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <vector>

namespace hearth::test
{

using namespace formats;
using shared::VisibilityCone;
using shared::VisibilityMoments;

namespace
{

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kDegree = kPi / 180;

Float3 randomDirection(std::mt19937& random)
{
    std::normal_distribution<float> normal;
    return normalizeOr({normal(random), normal(random), normal(random)}, {0, 0, 1});
}

/// Normal as vertices have them: decoded from a random code.
Float3 randomNormal(std::mt19937& random)
{
    return decodeNormal(kVertexNormal, encodeNormal(kVertexNormal, randomDirection(random)));
}

float uniform(std::mt19937& random, float low, float high)
{
    return std::uniform_real_distribution<float>(low, high)(random);
}

/// Moments of a cone that is above the surface if its axis is near enough to the normal.
VisibilityMoments momentsOfCone(Float3 axis, float aperture, float scale)
{
    const double half_sine = std::sin(double{aperture} / 2), sine = std::sin(double{aperture});
    return {static_cast<float>(4 * std::numbers::pi * scale * half_sine * half_sine),
            axis * static_cast<float>(std::numbers::pi * scale * sine * sine)};
}

/// Random moments of any length that visibility above a surface can have, from all directions at the horizon
/// to all about one direction.
VisibilityMoments randomMoments(std::mt19937& random, Float3 normal)
{
    const float m0 = 2 * kPi * std::pow(uniform(random, 0, 1), 2.0f);
    const float size = uniform(random, m0 * m0 / (4 * kPi), m0 * (1 - m0 / (4 * kPi)));
    // within 30 degrees of the normal nothing is clipped, for any length
    const NormalFrame frame = makeNormalFrame(normal);
    const float tilt = uniform(random, 0, 0.5f), turn = uniform(random, 0, 2 * kPi);
    const Float3 across = frame.first * std::cos(turn) + frame.second * std::sin(turn);
    return {m0, (normal * std::sqrt(1 - tilt * tilt) + across * tilt) * size};
}

float ambientOcclusion(const VisibilityMoments& moments, Float3 normal)
{
    return dot(moments.m1, normal) / kPi;
}

/// Angle in radians, from the chord: accurate for small angles.
float angle(Float3 a, Float3 b)
{
    return 2 * std::asin(std::min(1.0f, length(a - b) / 2));
}

} // namespace

TEST(VisibilityCode, ofTheOpenHemisphereIsExact)
{
    std::mt19937 random(1);
    for (int i = 0; i < 1000; ++i)
    {
        const Float3 normal = randomNormal(random);
        ASSERT_EQ(encodeVisibility(2 * kPi, normal * kPi, normal), kVisibilityUnoccluded);
    }
    const VisibilityMoments open = shared::decodeVisibilityInFrame(kVisibilityUnoccluded);
    EXPECT_EQ(open.m0, 2 * kPi);
    EXPECT_EQ(open.m1, (Float3{0, 0, kPi}));
    const Float3 up{0, 1, 0};
    EXPECT_EQ(shared::decodeVisibility(kVisibilityUnoccluded, up).m1, up * kPi);
    EXPECT_EQ(encodeVisibility(7, up * 4, up), kVisibilityUnoccluded) << "what overshoots is cut";
}

TEST(VisibilityCode, ofNothingSeenIsNothing)
{
    const Float3 up{0, 0, 1};
    EXPECT_EQ(encodeVisibility(0, {}, up), 0u);
    EXPECT_EQ(encodeVisibility(-0.2f, {0.1f, 0, 0.3f}, up), 0u) << "what overshoots is cut";
    const VisibilityMoments none = shared::decodeVisibility(0, up);
    EXPECT_EQ(none.m0, 0);
    EXPECT_EQ(none.m1, Float3{});
}

TEST(VisibilityCode, staysWithinWhatItStates)
{
    std::mt19937 random(2);
    float worst_along = 0, worst_across = 0, worst_ratio = 0, worst_m0 = 0;
    for (int i = 0; i < 200000; ++i)
    {
        const Float3 normal = randomNormal(random);
        const VisibilityMoments moments = randomMoments(random, normal);
        const uint32_t code = encodeVisibility(moments.m0, moments.m1, normal);
        ASSERT_TRUE(isLegalVisibility(code));
        const VisibilityMoments back = shared::decodeVisibility(code, normal);
        const NormalFrame frame = makeNormalFrame(normal);
        const Float3 off = (back.m1 - moments.m1) / kPi;
        worst_along = std::max(worst_along, std::abs(dot(off, normal)));
        worst_across =
            std::max({worst_across, std::abs(dot(off, frame.first)), std::abs(dot(off, frame.second))});
        worst_m0 = std::max(worst_m0, std::abs(back.m0 - moments.m0));
        const float x = shared::visibilityLength(shared::decodeVisibilityInFrame(code).m1 / kPi);
        if (x == 0)
            continue;
        const float ratio = length(moments.m1) / moments.m0;
        const float nearest = std::clamp(ratio, shared::visibilityRatio(x, 0), shared::visibilityRatio(x, 1));
        worst_ratio = std::max(worst_ratio, std::abs(x * kPi / back.m0 - nearest));
    }
    EXPECT_LT(worst_along, 1.0 / 1022 + 1e-5);
    EXPECT_GT(worst_along, 0.95 / 1022) << "the bound that is stated is about the bound";
    EXPECT_LT(worst_across, 1.0 / 508 + 1e-5);
    EXPECT_GT(worst_across, 0.95 / 508);
    EXPECT_LT(worst_ratio, 1.0 / 254 + 1e-5);
    EXPECT_GT(worst_ratio, 0.9 / 254);
    EXPECT_LT(worst_m0, 0.21f) << "where only a thin ring at the horizon is seen, whose |m1| is nearly 0";
}

TEST(VisibilityCode, keepsConesOfAllSizes)
{
    std::mt19937 random(3);
    for (int i = 0; i < 50000; ++i)
    {
        const Float3 normal = randomNormal(random);
        const NormalFrame frame = makeNormalFrame(normal);
        const float aperture = uniform(random, 15 * kDegree, 60 * kDegree);
        const float tilt = uniform(random, 0, 30 * kDegree), scale = uniform(random, 0.5f, 1);
        const Float3 axis = normal * std::cos(tilt) + frame.first * std::sin(tilt);
        const VisibilityMoments moments = momentsOfCone(axis, aperture, scale);
        const VisibilityMoments back =
            shared::decodeVisibility(encodeVisibility(moments.m0, moments.m1, normal), normal);
        const VisibilityCone cone = shared::visibilityCone(back.m0, back.m1, normal);
        // m1 / pi is 0.0033 long or longer for cones of 15 degrees at half the light
        const float size = length(moments.m1) / kPi;
        ASSERT_LT(angle(cone.axis, axis), 0.0031f / size) << aperture / kDegree;
        ASSERT_LT(std::abs(cone.aperture - aperture), 0.011f / std::sin(aperture)) << aperture / kDegree;
        ASSERT_NEAR(back.m0, moments.m0, 0.06f * moments.m0 + 0.02f);
    }
}

/// Moments of the hemisphere about +Z after one to three caps of directions, some of them half transparent,
/// are removed; by quadrature.
VisibilityMoments momentsBesideCaps(std::mt19937& random)
{
    struct Cap
    {
        Float3 axis;
        float cosine, share;
    };
    std::vector<Cap> caps(1 + random() % 3);
    for (Cap& cap : caps)
        cap = {randomDirection(random), uniform(random, -0.3f, 0.95f),
               random() % 4 == 0 ? uniform(random, 0, 1) : 0};
    constexpr int kRows = 24, kColumns = 48;
    VisibilityMoments moments{0, {}};
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column)
        {
            const float z = (static_cast<float>(row) + 0.5f) / kRows, r = std::sqrt(1 - z * z);
            const float turn = 2 * kPi * (static_cast<float>(column) + 0.5f) / kColumns;
            const Float3 w{r * std::cos(turn), r * std::sin(turn), z};
            float share = 2 * kPi / (kRows * kColumns);
            for (const Cap& cap : caps)
                share *= dot(w, cap.axis) > cap.cosine ? cap.share : 1;
            moments.m0 += share;
            moments.m1 += w * share;
        }
    return moments;
}

TEST(VisibilityCode, keepsTheConesOfOccludersOfAllKinds)
{
    std::mt19937 random(9);
    const Float3 up{0, 0, 1};
    double ao2 = 0, axis2 = 0, aperture2 = 0, m02 = 0;
    int count = 0;
    for (int i = 0; i < 2000; ++i)
    {
        const VisibilityMoments moments = momentsBesideCaps(random);
        if (ambientOcclusion(moments, up) < 0.02f)
            continue;
        const VisibilityMoments back =
            shared::decodeVisibility(encodeVisibility(moments.m0, moments.m1, up), up);
        const VisibilityCone was = shared::visibilityCone(moments.m0, moments.m1, up);
        const VisibilityCone is = shared::visibilityCone(back.m0, back.m1, up);
        const auto square = [](float x) { return double{x} * double{x}; };
        ao2 += square(ambientOcclusion(back, up) - ambientOcclusion(moments, up));
        axis2 += square(angle(is.axis, was.axis) / kDegree);
        aperture2 += square((is.aperture - was.aperture) / kDegree);
        m02 += square((back.m0 - moments.m0) / (2 * kPi));
        ++count;
    }
    // root mean squares; cook/pages/README.md compares with other codes
    EXPECT_LT(std::sqrt(ao2 / count), 0.0007);
    EXPECT_LT(std::sqrt(axis2 / count), 0.3);
    EXPECT_LT(std::sqrt(aperture2 / count), 0.25);
    EXPECT_LT(std::sqrt(m02 / count), 0.0015);
}

TEST(VisibilityCode, encodesWhatItDecodedToTheSameCode)
{
    std::mt19937 random(4);
    for (int i = 0; i < 200000; ++i)
    {
        const Float3 normal = randomNormal(random);
        const VisibilityMoments moments = randomMoments(random, normal);
        const uint32_t code = encodeVisibility(moments.m0, moments.m1, normal);
        const VisibilityMoments back = shared::decodeVisibility(code, normal);
        // if x is nearly 1 or 0, all codes of rho are nearly equal
        const float x = length(back.m1) / kPi;
        if (x > 0.01f && x < 0.999f)
        {
            ASSERT_EQ(encodeVisibility(back.m0, back.m1, normal), code);
        }
    }
}

TEST(VisibilityCode, hasTheFrameOfTangents)
{
    std::mt19937 random(5);
    for (int i = 0; i < 1000; ++i)
    {
        const Float3 normal = randomNormal(random);
        const NormalFrame frame = makeNormalFrame(normal);
        const auto code = static_cast<uint32_t>(random());
        const VisibilityMoments local = shared::decodeVisibilityInFrame(code);
        ASSERT_EQ(shared::decodeVisibility(code, normal).m1,
                  frame.first * local.m1.x + frame.second * local.m1.y + normal * local.m1.z);
    }
}

TEST(VisibilityCode, isCutBelowTheSurfaceAndFarAlongIt)
{
    const Float3 up{0, 0, 1};
    const VisibilityMoments below = shared::decodeVisibility(encodeVisibility(3, {0.3f, 0, -1}, up), up);
    EXPECT_EQ(below.m1.z, 0);
    EXPECT_NEAR(below.m1.x, 0.3f, kPi / 508);
    const VisibilityMoments along =
        shared::decodeVisibility(encodeVisibility(2 * kPi, {3, -3, 0.1f}, up), up);
    EXPECT_EQ(along.m1.x, kPi * (127 / 254.0f));
    EXPECT_EQ(along.m1.y, -kPi * (127 / 254.0f));
    EXPECT_FALSE(isLegalVisibility(0x00800000));
    EXPECT_FALSE(isLegalVisibility(0x80000000));
    EXPECT_TRUE(isLegalVisibility(0x8181FFFF));
}

TEST(VisibilityCode, givesEveryWordAFiniteCone)
{
    const auto check = [](uint32_t code)
    {
        const Float3 up{0, 0, 1};
        const VisibilityMoments moments = shared::decodeVisibility(code, up);
        const VisibilityCone cone = shared::visibilityCone(moments.m0, moments.m1, up);
        return moments.m0 >= 0 && moments.m0 <= 2 * kPi * 1.000001f && isFinite(moments.m1) &&
               std::abs(length(cone.axis) - 1) < 1e-5f && cone.cos_aperture >= 0 && cone.cos_aperture <= 1 &&
               cone.aperture >= 0 && cone.aperture <= kPi / 2 && cone.scale >= 0 && cone.scale <= 1;
    };
    for (uint32_t low = 0; low <= 0xFFFF; ++low)
        for (const uint32_t high : {0x0000u, 0x0001u, 0xFF00u, 0x7F7Fu, 0x8181u, 0x3000u, 0x8080u})
            ASSERT_TRUE(check(low | high << 16)) << (low | high << 16);
    std::mt19937 random(6);
    for (int i = 0; i < 300000; ++i)
    {
        const auto code = static_cast<uint32_t>(random());
        ASSERT_TRUE(check(code)) << code;
    }
}

TEST(VisibilityCone, agreesWithItsMoments)
{
    std::mt19937 random(7);
    for (int i = 0; i < 10000; ++i)
    {
        const Float3 axis = randomDirection(random);
        const float aperture = uniform(random, 1 * kDegree, 89.9f * kDegree),
                    scale = uniform(random, 0.05f, 1);
        const VisibilityMoments moments = momentsOfCone(axis, aperture, scale);
        const VisibilityCone cone = shared::visibilityCone(moments.m0, moments.m1, {0, 0, 1});
        ASSERT_LT(angle(cone.axis, axis), 1e-4f);
        ASSERT_NEAR(cone.cos_aperture, std::cos(aperture), 2e-6f);
        ASSERT_NEAR(cone.scale, scale, 0.005f) << aperture / kDegree;
        ASSERT_NEAR(cone.scale * (1 - cone.cos_aperture * cone.cos_aperture),
                    scale * std::pow(std::sin(aperture), 2.0f), 1e-5f);
    }
}

TEST(VisibilityCone, ofCornersIsKnown)
{
    // perpendicular planes: a half and a quarter of the hemisphere
    const float crease = kPi, half = kPi / 2;
    const VisibilityCone of_crease = shared::visibilityCone(crease, {half, 0, half}, {0, 0, 1});
    EXPECT_NEAR(of_crease.aperture, 65.53f * kDegree, 0.005f * kDegree);
    EXPECT_NEAR(of_crease.scale, 0.8536f, 0.00005f);
    EXPECT_NEAR(of_crease.axis.x, std::sqrt(0.5f), 1e-6f);
    const float quarter = kPi / 4;
    const VisibilityCone of_corner = shared::visibilityCone(kPi / 2, {quarter, quarter, quarter}, {0, 0, 1});
    EXPECT_NEAR(of_corner.aperture, 42.94f * kDegree, 0.005f * kDegree);
    EXPECT_NEAR(of_corner.scale, 0.9330f, 0.00005f);
    const VisibilityCone of_plane = shared::visibilityCone(2 * kPi, {0, 0, kPi}, {0, 0, 1});
    EXPECT_NEAR(of_plane.aperture, kPi / 2, 1e-3f);
    EXPECT_NEAR(of_plane.scale, 1, 1e-6f);
}

TEST(VisibilityCone, keepsAmbientOcclusionBelowWhatHangsOverhead)
{
    const Float3 up{0, 0, 1};
    // a sphere of radius 1 at height 1.2: m0 = 2 pi cos a, AO = 1 - sin^2 a with sin a = 1 / 1.2
    const float sine = 1 / 1.2f, cosine = std::sqrt(1 - sine * sine);
    const VisibilityCone sphere =
        shared::visibilityCone(2 * kPi * cosine, up * (kPi * (1 - sine * sine)), up);
    EXPECT_EQ(sphere.cos_aperture, 0);
    EXPECT_NEAR(sphere.scale, 0.306f, 0.0005f) << "a hemisphere about the normal has its scale as occlusion";
    // ceilings with distance falloff; k: height of the ceiling over the falloff distance
    for (const float k : {0.2f, 0.5f, 0.9f})
    {
        const float ao = 2 * (k - k * k / 2);
        const VisibilityCone ceiling =
            shared::visibilityCone(2 * kPi * k * (1 - std::log(k)), up * (2 * kPi * (k - k * k / 2)), up);
        EXPECT_EQ(ceiling.cos_aperture, 0) << k;
        EXPECT_NEAR(ceiling.scale, ao, 1e-6f) << k;
    }
}

TEST(VisibilityCone, keepsM1OfAllThatCanBe)
{
    std::mt19937 random(8);
    for (int i = 0; i < 100000; ++i)
    {
        const Float3 normal = randomDirection(random);
        const VisibilityMoments moments = randomMoments(random, normal);
        const VisibilityCone cone = shared::visibilityCone(moments.m0, moments.m1, normal);
        ASSERT_LE(cone.scale, 1);
        const float sine2 = 1 - cone.cos_aperture * cone.cos_aperture;
        ASSERT_NEAR(dot(cone.axis, normal) * cone.scale * sine2, ambientOcclusion(moments, normal), 2e-5f);
    }
}

TEST(VisibilityCone, makesWhatOvershootsFeasible)
{
    const Float3 up{0, 0, 1};
    const VisibilityCone more = shared::visibilityCone(9, up * 9, up);
    EXPECT_NEAR(more.scale, 1, 1e-6f);
    EXPECT_LT(more.cos_aperture, 1e-3f);
    const VisibilityCone pointed = shared::visibilityCone(1, up, up);
    EXPECT_NEAR(pointed.scale, 1, 1e-5f) << "as narrow as m0 can be: a cap";
    EXPECT_NEAR(pointed.cos_aperture, 1 - 1 / (2 * kPi), 1e-6f);
    const Float3 side{0.6f, 0, 0.8f};
    for (const auto& [m0, m1] :
         {std::pair{0.0f, Float3{}}, {-1.0f, up}, {0.0f, up}, {1.0f, Float3{}}, {1e-30f, up * 1e-30f}})
    {
        const VisibilityCone none = shared::visibilityCone(m0, m1, side);
        EXPECT_EQ(none.scale, 0);
        EXPECT_EQ(none.axis, side);
        EXPECT_EQ(none.aperture, std::acos(none.cos_aperture));
    }
}

} // namespace hearth::test
