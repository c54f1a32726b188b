// Tests the examples that are installed with the runtime, a separate project: one renders the same image as
// hearth-render, one finds what a ray hits.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/compare/image.h"
#include "tests/consumer/installation.h"

#include <algorithm>
#include <cstdlib>

namespace hearth::test
{

namespace
{

constexpr uint32_t kWidth = 640, kHeight = 480; // of the example's image

class Example : public Installation
{
protected:
    static void SetUpTestSuite()
    {
        Installation::SetUpTestSuite();
        run(HEARTH_CMAKE
            " -S prefix/share/doc/hearth/development/examples -B examples -G Ninja "
            "-DCMAKE_PREFIX_PATH=\"$PWD/prefix\" -DCMAKE_C_FLAGS='-Wall -Wextra -Wpedantic -Werror "
            "-Wno-missing-field-initializers'");
        run(HEARTH_CMAKE " --build examples");
    }

    void SetUp() override
    {
        if (shell("prefix/bin/hearth-render --name-device").exit_code != 0)
            GTEST_SKIP() << "there is no Vulkan device";
    }

    /// Cook a source into a pack of the folder.
    static void cook(const std::string& source, const std::string& pack)
    {
        run("prefix/bin/hearth cook '" + source + "' -o " + pack);
    }

    /// Render a pack by the example with the validation layer enabled.
    static viewer::Image draw(const std::string& pack)
    {
        const std::string said =
            run("VK_INSTANCE_LAYERS=VK_LAYER_KHRONOS_validation examples/draw_image " + pack + " image.png");
        EXPECT_EQ(said, "");
        Result<viewer::Image> image = viewer::readPng(folder() / "image.png");
        EXPECT_TRUE(image.ok()) << formatMessage(image.error());
        return image.ok() ? std::move(image).value() : viewer::Image(kWidth, kHeight);
    }
};

/// Return the largest difference of a channel; 255 if the sizes differ.
int largestStep(const viewer::Image& a, const viewer::Image& b)
{
    int largest = a.rgb.size() == b.rgb.size() ? 0 : 255;
    for (size_t i = 0; i < std::min(a.rgb.size(), b.rgb.size()); ++i)
        largest = std::max(largest, std::abs(int{a.rgb[i]} - int{b.rgb[i]}));
    return largest;
}

} // namespace

TEST_F(Example, drawsTheImageOfHearthRender)
{
    cook(HEARTH_SOURCE_FOLDER "/tests/consumer/game/assets/sign.gltf", "sign.hearth");
    const viewer::Image drawn = draw("sign.hearth");
    ASSERT_EQ(drawn.width, kWidth);
    ASSERT_EQ(drawn.height, kHeight);
    // the board's left half is red, its right half green
    const uint8_t* left = drawn.at(130, 240);
    const uint8_t* right = drawn.at(320, 240);
    EXPECT_GT(left[0], 2 * left[1]);
    EXPECT_GT(right[1], 2 * right[0]);
    run("prefix/bin/hearth-render sign.hearth --scene-camera 0 --size 640x480 --samples 1 -o rendered.png");
    const Result<viewer::Image> rendered = viewer::readPng(folder() / "rendered.png");
    ASSERT_TRUE(rendered.ok()) << formatMessage(rendered.error());
    EXPECT_LE(largestStep(drawn, *rendered), 1);
}

TEST_F(Example, showsAllOfAPackWithoutCameras)
{
    folder().write("triangle.obj", "v -1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    cook("triangle.obj", "triangle.hearth");
    const viewer::Image drawn = draw("triangle.hearth");
    size_t surface = 0;
    for (uint32_t y = 0; y < kHeight; ++y)
        for (uint32_t x = 0; x < kWidth; ++x)
        {
            const bool is_white = drawn.at(x, y)[0] > 180; // the sky is darker
            surface += is_white ? 1u : 0u;
            const bool is_margin = x == 0 || x + 1 == kWidth || y == 0 || y + 1 == kHeight;
            EXPECT_FALSE(is_white && is_margin) << "the image cuts it at " << x << " " << y;
        }
    EXPECT_GT(surface, size_t{kWidth} * kHeight / 20);
}

TEST_F(Example, castsARayAtWhatHasAName)
{
    folder().write("floor.obj", "v -1 2 -1\nv -1 2 1\nv 1 2 1\nf 1 2 3\n");
    cook("floor.obj", "floor.hearth");
    EXPECT_EQ(run("examples/cast_ray floor.hearth floor"), "node floor\nmaterial default\nposition 0 2 0\n");
    const ProgramEnd missing = shell("examples/cast_ray floor.hearth wall");
    EXPECT_EQ(missing.exit_code, 1);
    EXPECT_NE(missing.err.find("the pack has no instance called wall"), std::string::npos) << missing.err;
}

TEST_F(Example, saysWhatIsWrong)
{
    folder().write("bad.hearth", "no pack");
    const ProgramEnd bad = shell("examples/draw_image bad.hearth image.png");
    EXPECT_EQ(bad.exit_code, 1);
    EXPECT_NE(bad.err.find("bad.hearth: error: "), std::string::npos) << bad.err;
    const ProgramEnd nothing = shell("examples/draw_image");
    EXPECT_EQ(nothing.exit_code, 1);
    EXPECT_NE(nothing.err.find("usage: draw_image PACK.hearth OUT.png"), std::string::npos) << nothing.err;
}

} // namespace hearth::test
