// Draws the sky of a source's image-based light: the camera sees each face in its direction.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/images/float_image.h"
#include "tests/command/sky_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hearth::test
{

namespace
{

/// Return a colour for each side of the world, of full and of no light.
Double3 colorSides(Double3 d)
{
    const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    if (x > y && x > z)
        return d.x > 0 ? Double3{1, 0, 0} : Double3{0, 1, 1};
    if (y > z)
        return d.y > 0 ? Double3{0, 1, 0} : Double3{1, 0, 1};
    return d.z > 0 ? Double3{0, 0, 1} : Double3{1, 1, 0};
}

} // namespace

TEST(SkyPicture, showsEachFaceInItsDirection)
{
    Sandbox folder;
    writeGltfUnderSky(folder, "house", colorSides);
    const std::string bin = std::string(HEARTH_BIN) + "/";
    const ProgramEnd cooked = folder.run({bin + "hearth", "cook", "house.gltf", "-o", "house.hearth",
                                          "--visibility=off", "--bricks=off", "--no-cache"});
    ASSERT_EQ(cooked.exit_code, 0) << cooked.err;
    // the triangle is far below the eye
    const Double3 eye{0, 50, 0};
    for (const Double3 look :
         {Double3{1, 0, 0}, {-1, 0, 0}, {0.001, 1, 0}, {0.1, -1, 0.1}, {0, 0, 1}, {0, 0, -1}})
    {
        const Double3 target = eye + look;
        std::string camera;
        for (const double number : {eye.x, eye.y, eye.z, target.x, target.y, target.z})
            camera += std::to_string(number) + ",";
        camera += "20"; // degrees
        const ProgramEnd drawn = folder.run(
            {bin + "hearth-render", "house.hearth", "--size", "8x8", "--camera", camera, "-o", "view.exr"});
        ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
        const std::string file = folder.read("view.exr");
        const auto image = import::decodeExrFloats({std::as_bytes(std::span(file)), "view.exr", {}});
        ASSERT_TRUE(image.ok()) << formatMessage(image.error());
        const Double3 expected = colorSides(look);
        const Float3 middle = image->texels[4 * 8 + 4];
        const float exposure = std::max({middle.x, middle.y, middle.z});
        EXPECT_GT(exposure, 0);
        EXPECT_NEAR(middle.x / exposure, expected.x, 0.01) << camera;
        EXPECT_NEAR(middle.y / exposure, expected.y, 0.01) << camera;
        EXPECT_NEAR(middle.z / exposure, expected.z, 0.01) << camera;
    }
}

} // namespace hearth::test
