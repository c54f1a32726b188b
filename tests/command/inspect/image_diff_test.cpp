// Tests image comparison: hearth-compare alone, and hearth diff of two packs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/reference/png_image.h"
#include "tests/support/sandbox.h"
#include "tests/support/small_parts.h"

#include <cmath>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using reference::Image;

class ImageDiff : public ::testing::Test
{
protected:
    ProgramEnd run(const std::string& program, const std::vector<std::string>& arguments)
    {
        std::vector<std::string> command{HEARTH_BIN "/" + program};
        command.insert(command.end(), arguments.begin(), arguments.end());
        return folder.run(command);
    }

    void write(const std::string& name, const Image& image) const
    {
        ASSERT_TRUE(reference::writePng(folder / name, image).ok());
    }

    Sandbox folder;
};

Image grey(uint32_t width, uint32_t height)
{
    Image image(width, height);
    image.rgb.assign(image.rgb.size(), 100);
    return image;
}

} // namespace

TEST_F(ImageDiff, figuresAreOfTheImagesAlone)
{
    write("a.png", grey(32, 16));
    Image other = grey(32, 16);
    other.at(3, 5)[1] = 160;
    other.at(4, 5)[0] = 90;
    write("b.png", other);

    const ProgramEnd same = run("hearth-compare", {"a.png", "--with", "a.png", "-o", "same.png"});
    ASSERT_EQ(same.exit_code, 0) << same.err;
    const Json none = Json::parse(same.out).value();
    EXPECT_EQ(none["schema"], "hearth.compare/1");
    EXPECT_EQ(none["flip"]["mean"], 0.0);
    EXPECT_EQ(none["rms"], 0.0);
    EXPECT_EQ(none["different_pixels"], 0);
    const Image black = reference::readPng(folder / "same.png").value();
    EXPECT_EQ(black.rgb, Image(32, 16).rgb);

    ASSERT_EQ(
        run("hearth-compare", {"a.png", "--with", "b.png", "-o", "heat.png", "--stats", "figures"}).exit_code,
        0);
    const Json some = Json::parse(folder.read("figures")).value();
    EXPECT_EQ(some["different_pixels"], 2);
    EXPECT_EQ(some["largest_step"], 60);
    EXPECT_NEAR(some["rms"].get<double>(), std::sqrt((60.0 * 60 + 10 * 10) / (32 * 16 * 3)), 1e-4);
    EXPECT_GT(some["flip"]["mean"].get<double>(), 0);
    EXPECT_LE(some["flip"]["percentile_99"].get<double>(), some["flip"]["percentile_99.9"].get<double>());
    const Image heat = reference::readPng(folder / "heat.png").value();
    EXPECT_GT(int{heat.at(3, 5)[0]} + heat.at(3, 5)[1] + heat.at(3, 5)[2], 60);
    EXPECT_EQ(int{heat.at(31, 0)[0]}, 0) << "far from it nothing differs";
}

TEST_F(ImageDiff, whatCannotBeComparedIsAnError)
{
    write("a.png", grey(32, 16));
    write("wide.png", grey(33, 16));
    folder.write("text.png", "no image");
    EXPECT_EQ(run("hearth-compare", {"a.png"}).exit_code, 2);
    EXPECT_EQ(run("hearth-compare", {"a.png", "--with", "wide.png", "-o", "heat.png"}).exit_code, 2);
    EXPECT_EQ(run("hearth-compare", {"a.png", "--with", "nowhere.png", "-o", "heat.png"}).exit_code, 66);
    EXPECT_NE(run("hearth-compare", {"a.png", "--with", "text.png", "-o", "heat.png"}).exit_code, 0);
    EXPECT_FALSE(folder.has("heat.png"));
}

TEST_F(ImageDiff, packsAreDrawnAndCompared)
{
    PackModel model = smallPack();
    model.materials[0].alpha_mode = static_cast<uint32_t>(formats::AlphaMode::opaque);
    writePackFile(model, folder / "a.hearth");
    model.materials[0].emissive = {0, 4, 0};
    model.materials[0].emissive_texture.image = kInvalidIndex;
    writePackFile(model, folder / "b.hearth");
    const ProgramEnd end = run("hearth", {"diff", "a.hearth", "b.hearth", "--image", "heat.png", "--camera",
                                          "1,1,4,1,0,0,60", "--size", "64x48", "--format", "json"});
    EXPECT_EQ(end.exit_code, 1) << end.err;
    const Json image = Json::parse(end.out).value()["image"];
    EXPECT_EQ(image["heat_map"], "heat.png");
    EXPECT_GT(image["figures"]["different_pixels"].get<double>(), 0);
    EXPECT_LT(image["figures"]["different_pixels"].get<double>(), 64 * 48) << "the sky is the same";
    EXPECT_GT(image["figures"]["flip"]["mean"].get<double>(), 0.0);
    EXPECT_EQ(reference::readPng(folder / "heat.png").value().width, 64u);
    EXPECT_EQ(folder.list(), (std::vector<std::string>{"a.hearth", "b.hearth", "heat.png"}));

    const ProgramEnd wrong =
        run("hearth", {"diff", "a.hearth", "b.hearth", "--image", "none.png", "--scene-camera", "9"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_EQ(countOccurrences(wrong.err, "a.hearth: error: --scene-camera 9") +
                  countOccurrences(wrong.err, "b.hearth: error: --scene-camera 9"),
              1u)
        << wrong.err;
    EXPECT_FALSE(folder.has("none.png"));

    // without a camera the whole scene is in view
    const ProgramEnd fitted = run("hearth", {"diff", "a.hearth", "b.hearth", "--image", "fitted.png",
                                             "--size", "64x48", "--format", "json"});
    EXPECT_EQ(fitted.exit_code, 1) << fitted.err;
    const auto pixels =
        Json::parse(fitted.out).value()["image"]["figures"]["different_pixels"].get<uint64_t>();
    EXPECT_GT(pixels, 64 * 48 / 50) << "it is not far away";
    EXPECT_LT(pixels, 64 * 48) << "the sky is the same";
}

} // namespace hearth::test
