// Draws packs before and after a way to glTF and back: people see no difference.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/export/round_trip.h"
#include "tests/reference/flip.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

namespace hearth::test
{

namespace
{

using reference::Image;

/// Draw a pack with hearth-render, all of it in the picture.
Image draw(Sandbox& folder, const std::string& pack)
{
    const ProgramEnd end = folder.run({HEARTH_BIN "/hearth-render", pack, "-o", "drawn.png", "--size",
                                       "320x240", "--samples", "1", "--fit"});
    EXPECT_EQ(end.exit_code, 0) << end.err;
    auto image = reference::readPng(folder / "drawn.png");
    EXPECT_TRUE(image.ok());
    return image.ok() ? std::move(*image) : Image(1, 1);
}

void expectSamePicture(const std::string& source, const std::string& name)
{
    constexpr double kMaxFlip = .002;
    const RoundTrip trip(source, plainTexels());
    ASSERT_EQ(trip.fault(), "") << name;
    Sandbox folder;
    const Image first = draw(folder, trip.firstPath()), second = draw(folder, trip.secondPath());
    const double difference = reference::flip(first, second).mean();
    std::printf("%-24s FLIP %.5f\n", name.c_str(), difference);
    EXPECT_LE(difference, kMaxFlip) << name;
    Image black = first;
    std::fill(black.rgb.begin(), black.rgb.end(), uint8_t{0});
    EXPECT_GT(reference::flip(first, black).mean(), 10 * kMaxFlip) << name << " shows nothing";
    if (const char* const kept = std::getenv("HEARTH_KEEP_IMAGES"))
        for (const auto& [image, suffix] : {std::pair(&first, "_first"), std::pair(&second, "_second")})
            EXPECT_TRUE(reference::writePng(std::string(kept) + "/" + name + suffix + ".png", *image).ok());
}

} // namespace

TEST(RoundTripImage, ofSamplesIsTheSame)
{
    Sandbox folder;
    for (const char* kind : {"room", "character", "grass", "spheres"})
    {
        ASSERT_EQ(folder
                      .run({HEARTH_BIN "/hearth-samples", kind, "--triangles", "6000", "--texture-size", "64",
                            "-o", "sample.glb"})
                      .exit_code,
                  0);
        expectSamePicture(folder / "sample.glb", kind);
    }
}

TEST(RoundTripImage, ofModelsIsTheSame)
{
    const char* const assets = std::getenv("HEARTH_ASSETS");
    if (assets == nullptr)
        GTEST_SKIP() << "HEARTH_ASSETS is not set";
    for (const char* model : {"animation/milktruck/CesiumMilkTruck.gltf", "skinned/fox/Fox.glb",
                              "extensions/pbr_next_all/sphere.gltf", "alpha/sunflower/sunflower.gltf",
                              "pbr-embedded/specular_test/SpecularTest.glb",
                              "texture-transform/texture_transform_blender/09_texture_transform.gltf"})
    {
        const std::string path = std::string(assets) + "/good/" + model;
        const size_t name = path.rfind('/') + 1;
        expectSamePicture(path, path.substr(name, path.rfind('.') - name));
    }
}

} // namespace hearth::test
