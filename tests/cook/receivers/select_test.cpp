// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/receivers/select/select.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>

#include <random>

namespace
{

using namespace hearth;
using receivers::KeptLight;
using receivers::SelectOptions;

std::vector<KeptLight> select(const std::vector<Float3>& light, bool is_steady = false,
                              const SelectOptions& options = {})
{
    std::vector<KeptLight> kept;
    receivers::selectLights(light, is_steady, options, kept);
    return kept;
}

Float3 gray(double value)
{
    const auto v = static_cast<float>(value);
    return {v, v, v};
}

/// Return the weights with which lamps are kept, of gray lamps.
std::vector<double> weights(const std::vector<Float3>& light, const std::vector<KeptLight>& kept)
{
    std::vector<double> shares(light.size());
    for (const KeptLight& lamp : kept)
        shares[lamp.lamp] = lamp.color.x / double{light[lamp.lamp].x};
    return shares;
}

TEST(SelectLights, keepsTheSumOfAllChannelByChannel)
{
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    for (size_t i = 0; i < test::trials(2000); ++i)
    {
        std::vector<Float3> light(1 + random() % 40);
        Double3 sum{};
        for (Float3& lamp : light)
        {
            const float far = unit(random) * unit(random) * unit(random);
            lamp = {far * unit(random), far * unit(random), far * unit(random)};
            sum = sum + widen(lamp);
        }
        SelectOptions options;
        options.max_colors = 2 + static_cast<uint32_t>(random() % 11);
        const std::vector<KeptLight> kept = select(light, random() % 2 == 0, options);
        ASSERT_LE(kept.size(), options.max_colors);
        Double3 all{};
        for (size_t k = 0; k < kept.size(); ++k)
        {
            all = all + kept[k].color;
            ASSERT_TRUE(k == 0 || kept[k - 1].lamp < kept[k].lamp);
        }
        ASSERT_NEAR(all.x, sum.x, 1e-12 * sum.x);
        ASSERT_NEAR(all.y, sum.y, 1e-12 * sum.y);
        ASSERT_NEAR(all.z, sum.z, 1e-12 * sum.z);
    }
}

TEST(SelectLights, dimsLampsOfTwoToFourPercentSmoothly)
{
    // beside 1: shares of 5, 3.5, 3, 2.5 and 1.5 % of the sum
    const std::vector<Float3> light{gray(0.845), gray(0.05),  gray(0.035),
                                    gray(0.03),  gray(0.025), gray(0.015)};
    SelectOptions options;
    options.low = 0.02;
    options.high = 0.04;
    const std::vector<double> kept = weights(light, select(light, false, options));
    const double scale = kept[0];
    EXPECT_NEAR(kept[1] / scale, 1, 1e-6);
    EXPECT_NEAR(kept[2] / scale, 1 - 1.0 / 256, 1e-5); // 1 - (1 / 4)^4
    EXPECT_NEAR(kept[3] / scale, 1 - 1.0 / 16, 1e-5);
    EXPECT_NEAR(kept[4] / scale, 1 - 81.0 / 256, 1e-5);
    EXPECT_EQ(kept[5], 0);
    EXPECT_NEAR(scale, 1 / (1 - 0.035 / 256 - 0.03 / 16 - 0.025 * 81 / 256 - 0.015), 1e-6);
}

TEST(SelectLights, keepsAsManyAsTwelve)
{
    // Texels that four lamps reach vanish in the reference implementation, and it has 31 lights at most.
    std::vector<Float3> light(40, gray(0));
    for (const size_t lamp : {1u, 7u, 20u, 31u, 32u, 39u})
        light[lamp] = gray(1);
    const std::vector<KeptLight> kept = select(light);
    ASSERT_EQ(kept.size(), 6u);
    EXPECT_EQ(kept[4].lamp, 32u);
    EXPECT_EQ(kept[5].lamp, 39u);
    for (const KeptLight& lamp : kept)
        EXPECT_NEAR(lamp.color.y, 1, 1e-12);
}

TEST(SelectLights, keepsTheBrightestOfManyWeakLamps)
{
    EXPECT_EQ(select(std::vector<Float3>(100, gray(1))).size(), 12u); // a hundredth of the sum each
    std::vector<Float3> light(100, gray(1));
    light[77] = gray(1.5);
    const std::vector<double> kept = weights(light, select(light));
    EXPECT_EQ(std::max_element(kept.begin(), kept.end()) - kept.begin(), 77);
}

TEST(SelectLights, luminanceIsOfRec709)
{
    // The reference implementation adds .7152 to green in place of the product.
    EXPECT_NEAR(receivers::luminance({1, 0, 0}), 0.2126, 1e-6);
    EXPECT_NEAR(receivers::luminance({0, 1, 0}), 0.7152, 1e-6);
    EXPECT_NEAR(receivers::luminance({0, 0, 1}), 0.0722, 1e-6);
    // with that slip the dark green lamp would be worth more than the red one
    SelectOptions two;
    two.max_colors = 2;
    const std::vector<KeptLight> kept = select({gray(1), {1, 0, 0}, {0, 0.1f, 0}}, false, two);
    ASSERT_EQ(kept.size(), 2u);
    EXPECT_EQ(kept[1].lamp, 1u);
}

TEST(SelectLights, keepsABlueLampOfLittleLuminance)
{
    // 0.7 % of the luminance, and a tenth of all blue
    EXPECT_EQ(select({gray(1), {0, 0, 0.1f}}).size(), 2u);
    EXPECT_EQ(select({gray(1), {0, 0, 0.009f}}).size(), 1u);
}

TEST(SelectLights, steadyLightIsKeptAndTakesItsShareOfWhatIsDropped)
{
    const std::vector<KeptLight> kept = select({gray(1), gray(0.5), gray(0.01)}, true);
    ASSERT_EQ(kept.size(), 2u);
    EXPECT_NEAR(kept[0].color.x, 1 + 0.01 / 1.5, 1e-6);
    EXPECT_NEAR(kept[1].color.x, 0.5 + 0.005 / 1.5, 1e-6);
    // darker than all lamps, and yet not dropped
    std::vector<Float3> light(20, gray(1));
    light[0] = gray(1e-6);
    const std::vector<KeptLight> dark = select(light, true);
    ASSERT_EQ(dark.size(), 12u);
    EXPECT_EQ(dark[0].lamp, 0u);
}

TEST(SelectLights, keepsNothingOfDarkness)
{
    EXPECT_TRUE(select({}).empty());
    EXPECT_TRUE(select({gray(0), gray(0)}).empty());
    EXPECT_TRUE(select({gray(0), gray(0)}, true).empty());
}

/// Walk past lamps in small steps, and return the largest change of a kept colour between two steps, as a
/// share of the sum.
double measureJump(const SelectOptions& options, size_t lamps, double step)
{
    std::vector<double> last;
    double jump = 0;
    for (double x = 0; x < 20; x += step)
    {
        std::vector<Float3> light;
        double sum = 0;
        for (size_t i = 0; i < lamps; ++i)
        {
            const double off = x - 20.0 * (static_cast<double>(i) + 0.3) / static_cast<double>(lamps);
            light.push_back(gray(1 / (off * off + 2 + 0.1 * static_cast<double>(i))));
            sum += double{light.back().x};
        }
        std::vector<double> colors(lamps);
        for (const KeptLight& lamp : select(light, false, options))
            colors[lamp.lamp] = lamp.color.x / sum;
        for (size_t i = 0; i < last.size(); ++i)
            jump = std::max(jump, std::abs(colors[i] - last[i]));
        last = std::move(colors);
    }
    return jump;
}

TEST(SelectLights, changesWithoutJumps)
{
    SelectOptions three;
    three.max_colors = 3;
    // halving the step halves the change, which a jump would withstand
    for (const auto& [options, lamps] :
         {std::pair{SelectOptions{}, size_t{8}}, {SelectOptions{}, size_t{30}}})
    {
        const double coarse = measureJump(options, lamps, 2e-3), fine = measureJump(options, lamps, 1e-3);
        EXPECT_LT(fine, 0.6 * coarse) << lamps;
        EXPECT_LT(fine, 2e-3) << lamps;
    }
    EXPECT_LT(measureJump(three, 8, 1e-3), 0.01);
}

} // namespace
