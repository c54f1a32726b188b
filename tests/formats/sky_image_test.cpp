// The image of a sky: its texels lie where a cube map has them, and its harmonics give means over cones.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/gpu_shared/light_cone.h"
#include "formats/scene/radiance_transfer.h"
#include "formats/scene/scene_lighting.h"
#include "formats/scene/sky_image.h"
#include "formats/texels/shared_exponent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace hearth::shared
{

namespace
{

using formats::ProbeRecord;

constexpr double kPi = std::numbers::pi;

/// Probe whose texels are their own numbers: red in steps of 1, green the mip.
struct NumberedProbe
{
    ProbeRecord record{};
    std::vector<uint32_t> texels;

    NumberedProbe(uint32_t face_size, uint32_t mip_count, uint32_t sharp_mips)
    {
        record.face_size = face_size;
        record.mip_count = mip_count;
        record.sharp_mips = sharp_mips;
        record.flags = formats::kProbeIsSky;
        record.irradiance_luminance = 2;
        for (uint32_t mip = 0; mip < sharp_mips + mip_count; ++mip)
        {
            const uint32_t side = face_size << sharp_mips >> mip;
            for (uint32_t i = 0; i < 6 * side * side; ++i)
                texels.push_back(formats::encodeSharedExponent({double(i % 512), double(mip), 0}));
        }
        record.texels.count = static_cast<uint32_t>(texels.size());
    }
};

Float3 decoded(uint32_t word)
{
    return sharedExponentColor(word);
}

TEST(SharedExponentColor, isThatOfTheFormat)
{
    for (const uint32_t word : {0u, 0xFFFFFFFFu, 0x80000001u, 0x123u, 0xF8040201u, 0x00040201u, 0x7ABCDEF0u})
    {
        const std::array<float, 3> expected = formats::decodeSharedExponent(word);
        const Float3 found = decoded(word);
        EXPECT_EQ(found.x, expected[0]) << word;
        EXPECT_EQ(found.y, expected[1]) << word;
        EXPECT_EQ(found.z, expected[2]) << word;
    }
}

TEST(SkyImageIndex, isThatOfACubeMap)
{
    // Rows of the table of Vulkan 1.3, "Cube Map Face Selection": the directions of s, t and the face.
    constexpr Float3 kPanels[6][3] = {
        {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}}, {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
        {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},   {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
        {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},  {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
    };
    for (uint32_t panel = 0; panel < 6; ++panel)
        for (uint32_t y = 0; y < 16; ++y)
            for (uint32_t x = 0; x < 16; ++x)
            {
                const float s = (static_cast<float>(x) + 0.5f) / 8 - 1,
                            t = (static_cast<float>(y) + 0.5f) / 8 - 1;
                const Float3 direction = kPanels[panel][0] * s + kPanels[panel][1] * t + kPanels[panel][2];
                EXPECT_EQ(skyImageIndex(direction * 0.3f), (panel * 16 + y) * 16 + x);
            }
}

TEST(SkyImage, hasTheTexelsOfTheMipOfItsSize)
{
    for (const uint32_t sharp_mips : {0u, 1u})
    {
        const NumberedProbe probe(64, 4, sharp_mips); // the mip of 16 is number 2 after the sharp ones
        const auto image = makeSkyImage(probe.record, probe.texels);
        const Sky sky{{}, {}, {}, image.get()};
        for (uint32_t i = 0; i < kSkyImageTexels; ++i)
            ASSERT_EQ(decoded(image->texels[i]).x, static_cast<float>(i % 512));
        EXPECT_EQ(image->sharp_mips, sharp_mips);
        EXPECT_EQ(skyRadiance(sky, {1, 0.01f, 0.01f}).y, 2.0f * static_cast<float>(2 + sharp_mips));
    }
    // of a smaller probe the finest mip of a roughness
    const NumberedProbe small(8, 2, 0);
    const auto image = makeSkyImage(small.record, small.texels);
    EXPECT_EQ(decoded(image->texels[0]).x, 0);
    EXPECT_EQ(decoded(image->texels[1]).x, 0);
    EXPECT_EQ(decoded(image->texels[2]).x, 1);
    EXPECT_EQ(decoded(image->texels[2 * 16]).x, 8);
}

TEST(SkyImage, lightsASceneWithoutASun)
{
    const NumberedProbe probe(64, 4, 0);
    const SceneLighting lighting = sceneLighting({}, {}, {{&probe.record, 1}, probe.texels});
    EXPECT_TRUE(lighting.lights.empty());
    ASSERT_NE(lighting.sky.image, nullptr);
    EXPECT_EQ(lighting.sky.image->factor, 2);
    EXPECT_EQ(sceneLighting({}, {}).lights.size(), 1u);
    ProbeRecord local = probe.record;
    local.flags = 0;
    EXPECT_EQ(sceneLighting({}, {}, {{&local, 1}, probe.texels}).sky.image, nullptr);
}

/// Radiance of degree 2 at most.
double smoothRadiance(Float3 d)
{
    return 1.2 + 0.3 * double{d.x} - 0.2 * double{d.y} + 0.4 * double{d.z} + 0.3 * double{d.x} * double{d.y} -
           0.2 * double{d.z} * double{d.x} + 0.25 * double{d.y} * double{d.y} +
           0.1 * double{d.y} * double{d.z};
}

/// Integrate over directions within an angle of +Z, turned to an axis. Returns the mean.
template <typename Value>
double meanOverCone(Float3 axis, double cos_half_angle, const Value& value)
{
    const Float3 side = normalize(cross(axis, std::abs(axis.x) < 0.5f ? Float3{1, 0, 0} : Float3{0, 1, 0}));
    const Float3 other = cross(axis, side);
    constexpr int kRings = 200, kTurns = 200;
    double sum = 0;
    for (int ring = 0; ring < kRings; ++ring)
        for (int turn = 0; turn < kTurns; ++turn)
        {
            const double along = 1 - (1 - cos_half_angle) * (ring + 0.5) / kRings;
            const double across = std::sqrt(1 - along * along), angle = 2 * kPi * (turn + 0.5) / kTurns;
            sum +=
                value(axis * static_cast<float>(along) + side * static_cast<float>(across * std::cos(angle)) +
                      other * static_cast<float>(across * std::sin(angle)));
        }
    return sum / (kRings * kTurns);
}

TEST(SkyImage, givesMeansOverCones)
{
    SkyImage image{};
    for (size_t i = 0; i < kSkyHarmonics; ++i)
    {
        const auto product = [&](Float3 d) { return smoothRadiance(d) * double{evaluateHarmonics(d)[i]}; };
        const auto value = static_cast<float>(4 * kPi * meanOverCone({0, 0, 1}, -1, product));
        image.harmonics[i] = {value, 2 * value, -value};
    }
    const Sky sky{{}, {}, {}, &image};
    for (const Float3 axis : {Float3{0, 1, 0}, Float3{0.6f, -0.48f, 0.64f}, Float3{-0.6f, 0, 0.8f}})
        for (const double cosine : {0.0, 0.36, 0.8, 1.0})
        {
            const double expected = meanOverCone(axis, cosine, smoothRadiance);
            const Float3 found = skyImageConeRadiance(sky, axis, static_cast<float>(cosine));
            EXPECT_NEAR(found.x, expected, 1e-3) << cosine;
            EXPECT_NEAR(found.y, 2 * expected, 2e-3) << cosine;
            EXPECT_EQ(found.z, 0) << "never negative";
        }
    EXPECT_EQ(projectDistantLight(sky, {})[5].x, image.harmonics[5].x);
}

} // namespace

} // namespace hearth::shared
