// Tests the figures of seen surfaces on scenes whose light and occlusion are known.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/picture/surface_figures.h"
#include "tests/support/lit_scene.h"

#include <gtest/gtest.h>

namespace hearth::picture
{
namespace
{

using namespace reference;
using Double3 = reference::Double3;

constexpr uint32_t kSide = 16; ///< of images, pixels

/// Scene of squares under the default sun, which shines along (0.5, -0.8, -0.6), seen from a point.
class SeenSurfacesTest : public ::testing::Test
{
protected:
    void addSquare(float side, Float3 center, Float3 normal)
    {
        const uint32_t material = test_.addMaterial(material_);
        test_.addInstance(test_.addMesh(test::withMaterial(test::makeQuad(side, side), material)),
                          test::shining(center, -normal));
    }

    SeenSurfaces look(Float3 eye, Float3 target)
    {
        pack_.emplace(test_.build());
        geometry_.emplace(PackGeometry::decode(*pack_).value());
        textures_.emplace(TextureSet::load(*pack_).value());
        scene_.emplace(*geometry_, *textures_, nullptr);
        return {*scene_,
                *pack_,
                {.position = eye, .target = target, .up = {0.1f, 0.9f, 0.3f}, .y_fov_rad = 0.02f},
                kSide,
                kSide};
    }

    test::TestScene test_;
    formats::MaterialRecord material_ = test::plainMaterial();
    std::optional<formats::PackView> pack_;
    std::optional<PackGeometry> geometry_;
    std::optional<TextureSet> textures_;
    std::optional<ShadedScene> scene_;
};

/// Image that shows one radiance everywhere.
Image makeShown(double radiance)
{
    return develop({kSide, kSide, std::vector(size_t{kSide} * kSide, Double3{radiance, radiance, radiance})},
                   1);
}

Image makeGrey(uint8_t value)
{
    Image image(kSide, kSide);
    std::fill(image.rgb.begin(), image.rgb.end(), value);
    return image;
}

TEST_F(SeenSurfacesTest, compareTheLightOfWallsThatTheSunDoesNotReach)
{
    addSquare(10, {0, 0, 0}, {1, 0, 0}); // faces away from the sun
    const SeenSurfaces seen = look({3, 0, 0}, {0, 0, 0});
    const std::optional<double> walls = seen.compareWalls(makeShown(0.1), makeShown(0.2));
    ASSERT_TRUE(walls.has_value());
    EXPECT_NEAR(*walls, 0.5, 0.02); // of 8 bits
}

TEST_F(SeenSurfacesTest, leaveOutSunnyWallsAndGround)
{
    addSquare(10, {0, 0, 0}, {-1, 0, 0});
    EXPECT_FALSE(look({-3, 0, 0}, {0, 0, 0}).compareWalls(makeShown(0.1), makeShown(0.2)).has_value());
    test_ = {};
    addSquare(10, {0, 0, 0}, {0, 1, 0});
    addSquare(100, {0, 9, 0}, {0, -1, 0}); // shadows the ground
    EXPECT_FALSE(look({3, 3, 0}, {0, 0, 0}).compareWalls(makeShown(0.1), makeShown(0.2)).has_value());
}

TEST_F(SeenSurfacesTest, measureTheOcclusionOfAnOpenPlaneAndBesideAWall)
{
    addSquare(10, {0, 0, 0}, {0, 1, 0});
    EXPECT_EQ(look({1, 3, 0}, {0, 0, 0}).measureOcclusion(makeGrey(255), 16).rms, 0);
    EXPECT_NEAR(look({1, 3, 0}, {0, 0, 0}).measureOcclusion(makeGrey(51), 16).rms, 0.8, 1e-6);
    // a long wall that hides the sky up to an angle takes (1 - its cosine) / 2 of it
    addSquare(400, {-0.5f, 0.5f - 200, 0}, {1, 0, 0});
    EXPECT_NEAR(look({0.01f, 0.5f, 0.01f}, {0, 0, 0}).measureOcclusion(makeGrey(218), 256).rms, 0, 0.02);
}

TEST_F(SeenSurfacesTest, seeTheSkyThroughUnlitDomes)
{
    addSquare(10, {0, 0, 0}, {0, 1, 0});
    material_.flags |= formats::kMaterialUnlit;
    addSquare(100, {0, 20, 0}, {0, -1, 0});
    EXPECT_EQ(look({1, 3, 0}, {0, 0, 0}).measureOcclusion(makeGrey(255), 16).rms, 0);
}

} // namespace
} // namespace hearth::picture
