// Tests the sky rays against closed forms: open plane, furnace test, creases, and the gain of a bounce.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/tracer/sky_tracer.h"
#include "tests/support/lit_scene.h"

#include <gtest/gtest.h>

namespace hearth::reference
{
namespace
{

using namespace formats;

constexpr uint32_t kRays = 1024;

/// Quads in the world under a uniform sky without lights: the reflected light equals the visible part.
class SkyTracerTest : public ::testing::Test
{
protected:
    /// Add a square about the origin that faces +y, rotated by `tilted` about the x axis (radians; its side
    /// at +z rises and it turns to face -z), then moved.
    void addSquare(double side, double tilted = 0, Float3 moved = {})
    {
        Affine3 t = translated(moved);
        const auto c = static_cast<float>(std::cos(tilted)), s = static_cast<float>(std::sin(tilted));
        // the quad faces +z: x, then y to -z, z to y; then the tilt
        const Float3 columns[] = {{1, 0, 0}, {0, -s, -c}, {0, c, -s}};
        for (size_t axis = 0; axis < 3; ++axis)
        {
            t.m[0][axis] = columns[axis].x;
            t.m[1][axis] = columns[axis].y;
            t.m[2][axis] = columns[axis].z;
        }
        mesh::SourceMesh quad = test::withMaterial(
            test::makeQuad(static_cast<float>(side), static_cast<float>(side)), test_.addMaterial(material_));
        test_.addInstance(test_.addMesh(quad), t);
    }

    static Affine3 translated(Float3 offset) { return test::translated(offset); }

    /// Surface point under a ray, with the material's own or another roughness.
    struct Seen
    {
        ShadedPoint point;
        Double3 view;
    };
    Seen look(Double3 from, Double3 at)
    {
        if (!scene_)
        {
            pack_.emplace(test_.build());
            geometry_.emplace(PackGeometry::decode(*pack_).value());
            textures_.emplace(TextureSet::load(*pack_).value());
            scene_.emplace(*geometry_, *textures_, nullptr);
        }
        const Double3 direction = normalize(at - from);
        const auto point = scene_->nearest({from, direction}, 0);
        EXPECT_TRUE(point.has_value());
        return {point.value_or(ShadedPoint{}), -direction};
    }

    SkyAccess trace(const Seen& seen, const SkyTracing& tracing = {.rays = kRays}) const
    {
        return traceSky(*scene_, seen.point, seen.view, tracing, 5);
    }

    test::TestScene test_;
    MaterialRecord material_ = test::plainMaterial();
    std::optional<PackView> pack_;
    std::optional<PackGeometry> geometry_;
    std::optional<TextureSet> textures_;
    std::optional<ShadedScene> scene_;
};

TEST_F(SkyTracerTest, seesAllOfTheSkyFromAnOpenPlaneAndThenSaysWhatTheRuntimeDoes)
{
    addSquare(10);
    const Seen seen = look({1, 2, 0.5}, {0, 0, 0});
    const SkyAccess access = trace(seen);
    for (const Double3 share : {access.diffuse, access.specular})
    {
        EXPECT_EQ(share.x, 1);
        EXPECT_EQ(share.z, 1);
    }
    const SkyResponse open = underSky(seen.point.coating, scene_->lighting(), seen.view);
    const Double3 traced = tracedSky(*scene_, seen.point, seen.view, {.rays = 8}, 3);
    EXPECT_DOUBLE_EQ(traced.x, open.diffuse.x + open.specular.x);
    EXPECT_DOUBLE_EQ(traced.y, open.diffuse.y + open.specular.y);
}

TEST_F(SkyTracerTest, integratesTheGradientToTheIrradianceOfTheRuntime)
{
    addSquare(10);
    const Seen seen = look({1, 2, 0.5}, {0, 0, 0});
    const SkyAccess access = trace(seen, {.rays = 1 << 14});
    const Double3 expected = scene_->lighting().irradiance({0, 1, 0});
    EXPECT_NEAR(access.irradiance.x, expected.x, 0.006 * expected.x);
    EXPECT_NEAR(access.irradiance.y, expected.y, 0.006 * expected.y);
    EXPECT_NEAR(access.irradiance.z, expected.z, 0.012 * expected.z);
}

/// Half of the sky by the cosine; all of the sky in the reflection along the bisector.
TEST_F(SkyTracerTest, seesHalfOfTheSkyInACrease)
{
    // z rises behind z = 0: a wall as high as the floor is long, both far larger than the tested area
    constexpr float kSide = 200;
    addSquare(kSide, 0, {0, 0, kSide / 2});
    addSquare(kSide, -std::acos(-1) / 2, {0, kSide / 2, 0});
    material_.roughness = 0.05f;
    const Seen seen = look({0.3, 0.5, 3}, {0, 0, 0.01});
    const SkyAccess access = trace(seen, {.rays = 1 << 13});
    // Exactly 1/2 under a uniform sky. The gradient only weights the heights, which the wall covers alike
    // left and right.
    EXPECT_NEAR(access.diffuse.x, 0.5, 0.01);
    EXPECT_NEAR(access.diffuse.z, 0.5, 0.01);
}

TEST_F(SkyTracerTest, aMirrorSeesTheSkyOrTheWallAndNothingBetween)
{
    constexpr float kSide = 200;
    material_.roughness = 0;
    material_.metallic = 1;
    addSquare(kSide, 0, {0, 0, kSide / 2});
    addSquare(kSide, -std::acos(-1) / 2, {0, kSide / 2, 0});
    EXPECT_NEAR(trace(look({0, 2, 5}, {0, 0, 1})).specular.y, 0, 0.01) << "what it mirrors is the wall";
    EXPECT_NEAR(trace(look({0, 2, 1}, {0, 0, 5})).specular.y, 1, 0.01) << "what it mirrors is the sky";
}

/// In a closed box of albedo rho whose walls emit e, n bounces give e (1 + rho + ... + rho^n): the furnace
/// test.
TEST_F(SkyTracerTest, addsUpInAFurnace)
{
    constexpr double kAlbedo = 0.5, kEmitted = 0.3;
    material_.base_color = {0.5f, 0.5f, 0.5f, 1};
    material_.emissive = {0.3f, 0.3f, 0.3f};
    const double quarter = std::acos(-1) / 2;
    addSquare(2, 0, {0, -1, 0});
    addSquare(2, 2 * quarter, {0, 1, 0});
    addSquare(2, -quarter, {0, 0, -1});
    addSquare(2, quarter, {0, 0, 1});
    for (const float side : {-1.0f, 1.0f})
    {
        Affine3 t = translated({side, 0, 0}); // the quad's +z to -side x
        t.m[0][0] = t.m[2][2] = 0;
        t.m[0][2] = -side;
        t.m[2][0] = side;
        test_.addInstance(
            test_.addMesh(test::withMaterial(test::makeQuad(2, 2), test_.addMaterial(material_))), t);
    }
    const Seen seen = look({0, 0, 0}, {0.2, -1, 0.3});
    for (const uint32_t bounces : {0u, 1u, 3u})
    {
        const SkyAccess access = trace(seen, {.rays = 64, .bounces = bounces, .shadows = true});
        EXPECT_EQ(access.diffuse.x, 0);
        double expected = 0;
        for (uint32_t i = 0; i < bounces; ++i)
            expected += kEmitted * std::pow(kAlbedo, i);
        EXPECT_NEAR(access.bounced_irradiance.x, expected, 1e-6) << bounces;
        EXPECT_NEAR(access.bounced_reflection.y, expected, 1e-6) << bounces;
    }
}

TEST_F(SkyTracerTest, letsTheOcclusionTextureCountWhereItSaysLess)
{
    addSquare(10);
    Seen seen = look({1, 2, 0.5}, {0, 0, 0});
    seen.point.coating.occlusion = 0.4;
    const SkyResponse open = underSky(seen.point.coating, scene_->lighting(), seen.view);
    const Double3 traced = tracedSky(*scene_, seen.point, seen.view, {.rays = 8}, 3);
    EXPECT_NEAR(traced.x, 0.4 * (open.diffuse.x + open.specular.x), 1e-12);
}

TEST_F(SkyTracerTest, isTheSameTwiceAndDiffersWithTheSeed)
{
    addSquare(4);
    addSquare(4, 1.2, {0, 0.3f, 0});
    const Seen seen = look({0.1, 3, 1.5}, {0.3, 0, 1});
    const SkyTracing tracing{.rays = 64, .bounces = 2};
    const SkyAccess a = traceSky(*scene_, seen.point, seen.view, tracing, 1);
    const SkyAccess b = traceSky(*scene_, seen.point, seen.view, tracing, 1);
    const SkyAccess c = traceSky(*scene_, seen.point, seen.view, tracing, 2);
    EXPECT_EQ(a.diffuse.x, b.diffuse.x);
    EXPECT_EQ(a.bounced_irradiance.y, b.bounced_irradiance.y);
    EXPECT_NE(a.irradiance.x, c.irradiance.x);
    EXPECT_LT(a.diffuse.x, 1);
    EXPECT_GT(a.diffuse.x, 0);
}

} // namespace
} // namespace hearth::reference
