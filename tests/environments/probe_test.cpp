// Tests probes as they are stored.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/probes/harmonics.h"
#include "cook/probes/probe.h"
#include "formats/scene/scene_lighting.h"
#include "formats/texels/shared_exponent.h"
#include "tests/environments/environments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <numbers>
#include <span>

namespace hearth::probes
{

namespace
{

using environment::Environment;
using environment::Layout;
using test::makeEnvironment;
using test::makeNoise;

constexpr double kPi = std::numbers::pi;
constexpr uint32_t kSide = 32;

Probe cook(const Environment& sky)
{
    Result<Probe> probe = cookProbe(sky, "sky.hdr", kSide);
    EXPECT_TRUE(probe.ok()) << (probe.ok() ? "" : formatMessage(probe.error()));
    return probe.ok() ? std::move(probe).value() : Probe{};
}

Environment scale(Environment sky, float factor)
{
    for (Float3& texel : sky.texels)
        texel = texel * factor;
    return sky;
}

/// Largest difference of mantissas with one exponent; 512 where exponents differ by more than rounding does.
int compareTexels(uint32_t a, uint32_t b)
{
    const auto left = formats::decodeSharedExponent(a), right = formats::decodeSharedExponent(b);
    const double step = std::ldexp(1.0, static_cast<int>(std::max(a >> 27, b >> 27)) - 24);
    double difference = 0;
    for (size_t c = 0; c < 3; ++c)
        difference = std::max(difference, std::abs(double{left[c]} - double{right[c]}) / step);
    return static_cast<int>(std::ceil(difference));
}

} // namespace

TEST(CookProbe, storesOneRadianceExactly)
{
    const Float3 color{3, 0.7f, 1.9f};
    const Probe probe = cook(makeEnvironment(Layout::lat_long, 16, [&](Double3) { return color; }));
    const double luminance = 0.2126 * 3 + 0.7152 * double{0.7f} + 0.0722 * double{1.9f};
    EXPECT_NEAR(probe.record.irradiance.x, kPi * 3, 1e-5);
    EXPECT_NEAR(probe.record.irradiance_luminance, kPi * luminance, 1e-5);
    const uint32_t expected = formats::encodeSharedExponent(
        {3 / (kPi * luminance), double{0.7f} / (kPi * luminance), double{1.9f} / (kPi * luminance)});
    ASSERT_EQ(probe.texels.size(), formats::cubeTexelCount(kSide, 6));
    for (const uint32_t texel : probe.texels)
        ASSERT_EQ(texel, expected);
    EXPECT_NEAR(probe.record.harmonics[0], 3 * 2 * std::sqrt(kPi) / (kPi * luminance), 1e-6);
    for (size_t i = 3; i < formats::kProbeHarmonicValues; ++i)
        EXPECT_NEAR(probe.record.harmonics[i], 0, 1e-7);
    EXPECT_NEAR(probe.record.largest, 3 / (kPi * luminance), 1e-6);
    EXPECT_EQ(probe.record.window, 0);
    EXPECT_LT(probe.record.error, 1.0 / 512);
}

TEST(CookProbe, brightnessChangesTheIrradianceAlone)
{
    const Environment sky = makeNoise(Layout::lat_long, 32, 8);
    Probe probe = cook(sky), brighter = cook(scale(sky, 1024)), third = cook(scale(sky, 1.0f / 3));
    EXPECT_EQ(probe.texels, brighter.texels);
    EXPECT_EQ(brighter.record.irradiance.y, 1024 * probe.record.irradiance.y);
    EXPECT_EQ(brighter.record.irradiance_luminance, 1024 * probe.record.irradiance_luminance);
    brighter.record.irradiance = probe.record.irradiance;
    brighter.record.irradiance_luminance = probe.record.irradiance_luminance;
    EXPECT_EQ(std::memcmp(&probe.record, &brighter.record, sizeof(probe.record)), 0);
    // a third is rounded in the source; it may round a stored texel to its other side
    size_t other = 0;
    for (size_t i = 0; i < probe.texels.size(); ++i)
    {
        ASSERT_LE(compareTexels(probe.texels[i], third.texels[i]), 1) << i;
        other += probe.texels[i] == third.texels[i] ? 0u : 1u;
    }
    EXPECT_LT(other, probe.texels.size() / 1000);
}

TEST(CookProbe, hasSharpMipsAsFineAsTheSky)
{
    const auto waves = [](Double3 d)
    {
        return Float3{static_cast<float>(2 + std::sin(9 * d.x)), static_cast<float>(2 + std::cos(7 * d.y)),
                      static_cast<float>(2 + std::sin(8 * d.z))};
    };
    const Environment sky = makeEnvironment(Layout::lat_long, 256, waves); // 512 x 256: 128 texels a face
    EXPECT_EQ(cookProbe(sky, "sky.hdr", kSide, 16)->record.sharp_mips, 0u);
    EXPECT_EQ(cookProbe(sky, "sky.hdr", kSide, 64)->record.sharp_mips, 1u);
    const Probe plain = cook(sky), probe = cookProbe(sky, "sky.hdr", kSide, 4096).value();
    ASSERT_EQ(probe.record.sharp_mips, 2u);
    ASSERT_EQ(probe.texels.size(), formats::cubeTexelCount(128, 8));
    EXPECT_TRUE(std::ranges::equal(plain.texels, std::span(probe.texels).last(plain.texels.size())))
        << "the others are as without";
    EXPECT_EQ(plain.record.error, probe.record.error);
    const uint32_t* texel = probe.texels.data();
    for (const uint32_t side : {128u, 64u})
        for (uint32_t i = 0; i < 6 * side * side; ++i, ++texel)
        {
            const Double3 direction = panelDirection(
                Layout::cube, i / (side * side), {(i % side + 0.5) / side, (i / side % side + 0.5) / side});
            const Float3 expected = waves(direction);
            const std::array<float, 3> found = formats::decodeSharedExponent(*texel);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(found[static_cast<size_t>(c)] * probe.record.irradiance_luminance, expected[c],
                            0.05)
                    << side << ' ' << i;
        }
}

TEST(CookProbe, windowsASunAndSaysWhatIsCut)
{
    const Probe probe = cook(makeEnvironment(Layout::lat_long, 128,
                                             [](Double3 d) {
                                                 return d.y > 0.9995 ? Float3{9e6f, 9e6f, 9e6f} : Float3{};
                                             }));
    EXPECT_GT(probe.record.window, 0);
    Harmonics stored;
    for (size_t i = 0; i < stored.size(); ++i)
    {
        const std::span<const float, 3> color(&probe.record.harmonics[3 * i], 3);
        stored[i] = {double{color[0]}, double{color[1]}, double{color[2]}};
    }
    EXPECT_GT(minIrradiance(stored), -1e-6);
    // the sun is the first row of texels and gives all of E_probe; a texel of mip 0 is larger than it
    const double solid_angle = 2 * kPi * (1 - std::cos(kPi / 128)), texel = 4.0 / (kSide * kSide);
    EXPECT_LT(probe.record.largest, 4 / solid_angle);
    EXPECT_NEAR(probe.record.largest, 1 / texel, 0.05 / texel) << "it is above a corner of four texels";
    EXPECT_LT(probe.record.error, 0.01);
}

TEST(CookProbe, refusesAnEnvironmentWithoutLight)
{
    for (const float radiance : {0.0f, std::numeric_limits<float>::max()})
    {
        const Result<Probe> probe = cookProbe(makeEnvironment(Layout::lat_long, 4,
                                                              [&](Double3) {
                                                                  return Float3{radiance, radiance, radiance};
                                                              }),
                                              "dark.hdr");
        ASSERT_FALSE(probe.ok());
        EXPECT_EQ(probe.error().issue, Issue::image_unsupported);
        EXPECT_EQ(probe.error().file, "dark.hdr");
    }
}

} // namespace hearth::probes
