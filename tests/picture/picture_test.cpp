// Tests the images, scenes and figures of the bench of pictures.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/bench/aims.h"
#include "tests/picture/comparison.h"
#include "tests/reference/tracer/gltf_material.h"
#include "tests/support/sandbox.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace hearth::picture
{
namespace
{

using reference::Double3;

RadianceImage makeImage(uint32_t width, uint32_t height, Double3 radiance)
{
    return {width, height, std::vector<Double3>(size_t{width} * height, radiance)};
}

int encode(double shown)
{
    return static_cast<int>(reference::srgbFromLinear(shown) * 255 + 0.5);
}

TEST(RadianceImages, areReadAsTheyWereWritten)
{
    const test::Sandbox folder;
    RadianceImage image = makeImage(3, 2, {0.25, 0.5, 1000});
    image.pixels[0] = {1, 2, 3};  // left upper corner
    image.pixels[5] = {-1, 0, 7}; // right lower one
    ASSERT_TRUE(writePfm(folder / "image.pfm", image).ok());
    EXPECT_TRUE(folder.read("image.pfm").starts_with("PF\n3 2\n-1.0\n"));
    const RadianceImage read = readPfm(folder / "image.pfm").value();
    ASSERT_EQ(read.width, 3u);
    ASSERT_EQ(read.height, 2u);
    EXPECT_EQ(read.pixels[0].z, 3);
    EXPECT_EQ(read.pixels[5].x, -1);
    EXPECT_EQ(read.pixels[1].z, 1000);
}

TEST(RadianceImages, areRejectedWhereTheyAreMalformed)
{
    const test::Sandbox folder;
    EXPECT_EQ(readPfm(folder / "none.pfm").error().issue, Issue::input_missing);
    const std::string pixel(12, '\0');
    for (const std::string& text : {std::string("P6\n1 1\n-1.0\n") + pixel, "PF\n1 1\n1.0\n" + pixel,
                                    "PF\n2 1\n-1.0\n" + pixel, std::string("PF\n")})
    {
        folder.write("image.pfm", text);
        EXPECT_EQ(readPfm(folder / "image.pfm").error().issue, Issue::image_malformed) << text;
    }
}

/// Hearth applies its tone curve to each sample: at the rim of a lamp the mean of both sides is shown.
TEST(Develop, appliesTheToneCurveBeforeTheMean)
{
    RadianceImage image = makeImage(4, 2, {0.4, 0.1, 0});
    for (const size_t lit : {size_t{3}, size_t{7}}) // one half of the right pixel
        image.pixels[lit] = {100, 100, 100};
    const reference::Image shown = develop(image, 2);
    ASSERT_EQ(shown.width, 2u);
    ASSERT_EQ(shown.height, 1u);
    EXPECT_EQ(shown.at(0, 0)[0], encode(reference::filmic(0.4)));
    EXPECT_EQ(shown.at(0, 0)[1], encode(reference::filmic(0.1)));
    EXPECT_EQ(shown.at(0, 0)[2], 0);
    EXPECT_EQ(shown.at(1, 0)[2], encode(reference::filmic(100) / 2));
}

TEST(InvertFilmic, findsTheRadianceOfAColour)
{
    for (const double shown : {0.0, 0.01, 0.3, 0.9, 0.99})
        EXPECT_NEAR(reference::filmic(reference::invertFilmic(shown)), shown, 1e-9);
}

/// A picture beside itself differs in nothing; halves that differ are noise, and their mean is compared.
TEST(Compare, tellsSettingsApart)
{
    ReferenceImages images{makeImage(32, 32, {0.2, 0.2, 0.2}),
                           {makeImage(32, 32, {0.3, 0.3, 0.3}), makeImage(32, 32, {0.5, 0.5, 0.5})}};
    const reference::Image full = develop(makeImage(32, 32, {0.4, 0.4, 0.4}), kOversampling);
    const Comparison c = compare("reference", images, {develop(images.open, kOversampling), full, full});
    EXPECT_EQ(c.open_open.flip, 0);
    EXPECT_EQ(c.plain_full.flip, 0);
    EXPECT_EQ(c.full_full.flip, 0);
    EXPECT_GT(c.plain_open.flip, 0.05);
    EXPECT_GT(c.noise, 0.05);
}

TEST(Scenes, haveNamesOfTheirOwnAndAims)
{
    std::set<std::string_view> names;
    for (const Scene& scene : kScenes)
    {
        EXPECT_TRUE(names.insert(scene.name).second) << scene.name;
        EXPECT_GE(std::count_if(bench::kAims.begin(), bench::kAims.end(),
                                [&](const bench::Aim& aim) {
                                    return aim.bench == "picture" &&
                                           aim.figure.ends_with(": " + std::string(scene.name));
                                }),
                  3)
            << scene.name;
    }
}

} // namespace
} // namespace hearth::picture
