// Tests the pictures of baked light in reports.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/report/light_images.h"

#include "pipelines/light_pictures/light_picture.h"
#include "pipelines/report/page_data.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_parts.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

uint32_t bigEndianWord(const std::string& bytes, size_t at)
{
    uint32_t word = 0;
    for (size_t i = 0; i < 4; ++i)
        word = word << 8 | static_cast<uint8_t>(bytes[at + i]);
    return word;
}

/// Check that an image is PNG of this size. PNG, 11.2.2.
void expectPng(const std::string& png, uint32_t width, uint32_t height)
{
    ASSERT_GT(png.size(), 33u);
    EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(bigEndianWord(png, 16), width);
    EXPECT_EQ(bigEndianWord(png, 20), height);
}

} // namespace

TEST(LightImages, showProbesAndReceivers)
{
    const Sandbox sandbox;
    writePackFile(smallPack(), sandbox / "small.hearth");
    const std::vector<report::LightImage> images = report::drawLightOfPack(sandbox / "small.hearth");
    ASSERT_EQ(images.size(), 2u);
    expectPng(images[0].png, 12, 3);
    EXPECT_EQ(images[0].facts[0].second, "2 × 2 texels, 2 mips");
    EXPECT_EQ(images[1].name, "receivers");
    const formats::ReceiverAtlasRecord atlas = smallPack().receiver_atlases[0];
    expectPng(images[1].png, atlas.width, atlas.height);
    const std::string data = report::imagesData({}, images);
    EXPECT_NE(data.find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
    EXPECT_NE(data.find("\"name\":\"receivers\""), std::string::npos);
}

TEST(LightImages, areLeftOutWithoutAValidPack)
{
    const Sandbox sandbox;
    EXPECT_TRUE(report::drawLightOfPack(sandbox / "none.hearth").empty());
    PackModel broken = smallPack();
    broken.probes[0].mip_count = 1;
    writePackFile(broken, sandbox / "broken.hearth");
    EXPECT_TRUE(report::drawLightOfPack(sandbox / "broken.hearth").empty());
}

TEST(LightImages, shrinkToMeans)
{
    light_pictures::LightPicture picture{3, 3, {}};
    for (int i = 0; i < 9; ++i)
        picture.texels.push_back(Float3{1, 2, 4} * static_cast<float>(i));
    const light_pictures::LightPicture small = light_pictures::shrink(picture, 2);
    ASSERT_EQ(small.texels.size(), 4u);
    // texels 0, 1, 3, 4; then 2, 5 of the right edge; 6, 7 of the bottom; the corner
    EXPECT_EQ(small.texels, (std::vector<Float3>{{2, 4, 8}, {3.5f, 7, 14}, {6.5f, 13, 26}, {8, 16, 32}}));
}

} // namespace hearth::test
