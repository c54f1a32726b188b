// Tests shading with surfaces whose image is known: textures, normals, lights.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/support/gpu_fixture.h"
#include "tests/support/test_scene.h"

#include <cmath>
#include <optional>

namespace hearth::test
{

namespace
{

using namespace formats;

int srgbByte(float linear)
{
    const float encoded =
        linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
    return static_cast<int>(encoded * 255 + 0.5f);
}

/// Return the byte that a radiance is shown as.
int shown(double radiance)
{
    // J. Hejl, R. Burgess-Dawson, 2010; the result is for a display of gamma 2.2
    const double x = std::max(0.0, radiance - 0.004);
    const double display = x * (6.2 * x + 0.5) / (x * (6.2 * x + 1.7) + 0.06);
    return srgbByte(static_cast<float>(std::pow(display, 2.2)));
}

uint32_t gray(uint32_t value)
{
    return 0xFF000000u | value << 16 | value << 8 | value;
}

MaterialRecord unlitMaterial()
{
    MaterialRecord material = plainMaterial();
    material.flags = kMaterialUnlit;
    return material;
}

LightRecord light(LightType type, float intensity)
{
    LightRecord record{};
    record.type = static_cast<uint32_t>(type);
    record.color = {1, 1, 1};
    record.intensity = intensity;
    record.outer_cone_rad = 0.785f;
    return record;
}

/// Camera that sees exactly the square of side 2 around the origin at z = 0.
shared::Camera squareCamera()
{
    return {.position = {0, 0, 2}, .target = {0, 0, 0}, .y_fov_rad = 2 * std::atan(0.5f), .z_near = 0.01f};
}

class ShadingTest : public GpuTest
{
protected:
    /// Draw the scene with squareCamera on 64 x 64 pixels.
    Image drawSquare(TestScene& test, uint32_t debug_view = shared::kViewFinal)
    {
        const PackView pack = test.build();
        const auto scene = upload(pack);
        return draw(*scene, squareCamera(), {.width = 64, .height = 64, .debug_view = debug_view});
    }

    /// Draw a square of this material that fills the image.
    Image drawMaterial(TestScene& test, const MaterialRecord& material,
                       uint32_t debug_view = shared::kViewFinal)
    {
        test.addInstance(test.addMesh(withMaterial(makeQuad(2, 2), test.addMaterial(material))), Affine3{});
        return drawSquare(test, debug_view);
    }

    static void expectNormal(uint32_t color, Float3 normal)
    {
        normal = normal / length(normal);
        EXPECT_NEAR(channel(color, 0), (normal.x * 0.5f + 0.5f) * 255, 1.6f);
        EXPECT_NEAR(channel(color, 1), (normal.y * 0.5f + 0.5f) * 255, 1.6f);
        EXPECT_NEAR(channel(color, 2), (normal.z * 0.5f + 0.5f) * 255, 1.6f);
    }
};

} // namespace

TEST_F(ShadingTest, unlitColoursReachTheImageUnchanged)
{
    TestScene test;
    MaterialRecord material = unlitMaterial();
    material.base_color = {0.2f, 0.5f, 0.8f, 1};
    const Image image = drawMaterial(test, material);
    for (const uint32_t color : image.color)
    {
        ASSERT_NEAR(channel(color, 0), srgbByte(0.2f), 1);
        ASSERT_NEAR(channel(color, 1), srgbByte(0.5f), 1);
        ASSERT_NEAR(channel(color, 2), srgbByte(0.8f), 1);
    }
}

TEST_F(ShadingTest, texturesStandUprightAndKeepTheirBytes)
{
    TestScene test;
    MaterialRecord material = unlitMaterial();
    material.base_color_texture = makeTextureRef(
        test.addImage(TexelFormat::rgba8_srgb, 2, 2, {0xFF0000FF, 0xFF00FF00, 0xFFFF0000, 0xFF808080}));
    material.base_color_texture.nearest = 1;
    const Image image = drawMaterial(test, material);
    EXPECT_EQ(image.at(10, 10), 0xFF0000FFu);
    EXPECT_EQ(image.at(50, 10), 0xFF00FF00u);
    EXPECT_EQ(image.at(10, 50), 0xFFFF0000u);
    EXPECT_EQ(image.at(50, 50), 0xFF808080u);
}

TEST_F(ShadingTest, sixteenBitsAreSampled)
{
    if (!renderer().device().texel_formats[static_cast<size_t>(TexelFormat::rgba16_unorm)])
        GTEST_SKIP() << "the device cannot filter 16 bits";
    // shares of 65535 that 8 bits of a linear texture cannot tell from black, and those of the screen can
    TestScene test;
    MaterialRecord material = unlitMaterial();
    material.base_color_texture = makeTextureRef(
        test.addImage(TexelFormat::rgba16_unorm, 1, 1, {80u << 16 | 40u, 65535u << 16 | 160u}));
    const Image image = drawMaterial(test, material);
    EXPECT_EQ(channel(image.at(32, 32), 0), 2);
    EXPECT_EQ(channel(image.at(32, 32), 1), 4);
    EXPECT_EQ(channel(image.at(32, 32), 2), 8);
}

TEST_F(ShadingTest, theMipLevelFollowsTheSizeOnTheScreen)
{
    // mips of 0, 100 and 200: the colour shows the sampled level, in hundredths
    constexpr uint32_t kSize = 128;
    std::vector<uint32_t> texels(kSize * kSize, gray(0));
    texels.resize(texels.size() + kSize * kSize / 4, gray(100));
    texels.resize(texels.size() + kSize * kSize / 16, gray(200));
    for (const float size : {2.0f, 1.41421356f, 1.0f, 0.70710678f})
    {
        TestScene test;
        MaterialRecord material = unlitMaterial();
        material.base_color_texture =
            makeTextureRef(test.addImage(TexelFormat::rgba8_unorm, kSize, kSize, texels));
        test.addInstance(test.addMesh(withMaterial(makeQuad(size, size), test.addMaterial(material))),
                         Affine3{});
        const Image image = drawSquare(test);
        // 128 texels on 32 * size pixels
        const float level = std::min(std::log2(128 / (32 * size)), 2.0f);
        for (const uint32_t x : {22u, 32u, 41u})
            EXPECT_NEAR(channel(image.at(x, 32), 0), srgbByte(level * 100 / 255), 2) << size;
    }
}

TEST_F(ShadingTest, uvTransformAndUvSetAreFollowed)
{
    TestScene test;
    MaterialRecord material = unlitMaterial();
    material.base_color_texture =
        makeTextureRef(test.addImage(TexelFormat::rgba8_srgb, 2, 1, {gray(10), gray(240)}));
    material.base_color_texture.nearest = 1;
    material.base_color_texture.uv_set = 1;
    // swaps u and v, and shifts the new u by half the texture
    const float transform[6] = {0, 1, 0.5f, 1, 0, 0};
    std::copy(std::begin(transform), std::end(transform), material.base_color_texture.uv_transform);
    mesh::SourceMesh quad = withMaterial(makeQuad(2, 2), test.addMaterial(material));
    quad.uvs[1] = quad.uvs[0];
    quad.uvs[0].assign(4, {0.25f, 0.25f});
    test.addInstance(test.addMesh(quad), Affine3{});
    const Image image = drawSquare(test);
    for (const uint32_t x : {5u, 60u})
    {
        EXPECT_EQ(image.at(x, 5), gray(240));
        EXPECT_EQ(image.at(x, 60), gray(10));
    }
}

TEST_F(ShadingTest, vertexColoursMultiply)
{
    TestScene test;
    MaterialRecord material = unlitMaterial();
    material.base_color = {0.5f, 1, 1, 1};
    mesh::SourceMesh quad = withMaterial(makeQuad(2, 2), test.addMaterial(material));
    quad.colors = {{0, 1, 0, 1}, {1, 1, 0, 1}, {1, 1, 0, 1}, {0, 1, 0, 1}};
    test.addInstance(test.addMesh(quad), Affine3{});
    const Image image = drawSquare(test);
    for (const uint32_t x : {3u, 20u, 60u})
    {
        const float red = (static_cast<float>(x) + 0.5f) / 64;
        EXPECT_NEAR(channel(image.at(x, 30), 0), srgbByte(0.5f * red), 1);
        EXPECT_EQ(channel(image.at(x, 30), 1), 255);
        EXPECT_EQ(channel(image.at(x, 30), 2), 0);
    }
}

TEST_F(ShadingTest, normalsFollowShearedAndMirroredInstances)
{
    std::mt19937 random(5);
    for (int i = 0; i < 12; ++i)
    {
        TestScene test;
        MaterialRecord material = plainMaterial();
        material.flags = kMaterialDoubleSided;
        const Affine3 instance = randomAffine(random, 0);
        test.addInstance(test.addMesh(withMaterial(makeQuad(9, 9), test.addMaterial(material))), instance);
        const Image image = drawSquare(test, shared::kViewNormals);
        // normal of the plane, on the side of the eye
        Float3 normal = cross(transformVector(instance, {1, 0, 0}), transformVector(instance, {0, 1, 0}));
        if (normal.z < 0)
            normal = -normal;
        if (image.visibility[32 * 64 + 32] != shared::kVisibilitySky)
            expectNormal(image.at(32, 32), normal);
    }
}

TEST_F(ShadingTest, normalMapsTiltAlongTangentAndBitangent)
{
    // 0.48 along the tangent, 0.6 along the bitangent, 0.64 along the normal
    const uint32_t texel = 0xFF000000u | 209u << 16 | 204u << 8 | 189u;
    for (const bool mirrored : {false, true})
        for (const bool tangents : {false, true})
        {
            TestScene test;
            MaterialRecord material = plainMaterial();
            material.normal_texture = makeTextureRef(test.addImage(TexelFormat::rgba8_unorm, 1, 1, {texel}));
            mesh::SourceMesh quad = withMaterial(makeQuad(2, 2), test.addMaterial(material));
            if (!tangents)
                quad.tangents.clear();
            Affine3 instance;
            instance.m[0][0] = mirrored ? -1.0f : 1.0f;
            test.addInstance(test.addMesh(quad), instance);
            const Image image = drawSquare(test, shared::kViewNormals);
            // green points up in the image, u to the right unless mirrored
            expectNormal(image.at(32, 32), {mirrored ? -0.48f : 0.48f, 0.6f, 0.64f});
        }
}

TEST_F(ShadingTest, theSecondSideOfATwoSidedSurfaceIsLitFromItsOwnSide)
{
    TestScene test;
    MaterialRecord material = plainMaterial();
    material.flags = kMaterialDoubleSided;
    Affine3 turned;
    turned.m[0][0] = turned.m[2][2] = -1;
    test.addInstance(test.addMesh(withMaterial(makeQuad(2, 2), test.addMaterial(material))), turned);
    expectNormal(drawSquare(test, shared::kViewNormals).at(32, 32), {0, 0, 1});
}

TEST_F(ShadingTest, occlusionDarkensTheSkyAndEmissionAdds)
{
    const auto brightness = [&](uint32_t occlusion, float emissive)
    {
        TestScene test;
        test.addLight(light(LightType::directional, 0)); // no default sun
        MaterialRecord material = plainMaterial();
        material.occlusion_texture =
            makeTextureRef(test.addImage(TexelFormat::rgba8_unorm, 1, 1, {gray(occlusion)}));
        material.emissive = {emissive, emissive, emissive};
        return channel(drawMaterial(test, material).at(32, 32), 0);
    };
    EXPECT_EQ(brightness(0, 0), 0);
    EXPECT_GT(brightness(128, 0), 50);
    EXPECT_GT(brightness(255, 0), brightness(128, 0) + 30);
    EXPECT_GT(brightness(0, 1), 200);
}

/// Beside lights emission is in nits: the camera that dims the lights dims it, too.
TEST_F(ShadingTest, daylightIsTheSkyAndTheSun)
{
    // a wall that faces the sun's quarter, with the sky around it
    TestScene test;
    test.addInstance(test.addMesh(withMaterial(makeQuad(1, 1), test.addMaterial(plainMaterial()))),
                     Affine3{});
    const PackView pack = test.build();
    const auto scene = upload(pack);
    constexpr Float3 kWall{0, 0, 0}, kUp{0, 1000, 2}, kDown{0, -1000, 2};
    const auto draw_at = [&](const std::optional<shared::Daylight>& daylight, Float3 target)
    {
        const gpu::DaylightChange change = gpu::changeDaylight(*scene, daylight).value();
        shared::Camera camera = squareCamera();
        camera.target = target;
        camera.up = target == kWall ? Float3{0, 1, 0} : Float3{0, 0, 1};
        return draw(*scene, camera, {.width = 64, .height = 64, .daylight = &change});
    };
    const Image before = draw_at(std::nullopt, kWall);
    const Image evening = draw_at(shared::Daylight{.elevation_deg = 8}, kWall);
    EXPECT_NE(evening.color, before.color);
    EXPECT_EQ(draw(*scene, squareCamera(), {.width = 64, .height = 64}).color, evening.color)
        << "it stays until it is set anew";
    for (const float elevation : {5.0f, 30.0f, 80.0f})
    {
        const shared::Daylight front{.elevation_deg = elevation, .azimuth_deg = 180};
        shared::Daylight behind = front;
        behind.azimuth_deg = 0;
        const shared::DaylightColors colors = shared::makeDaylight(front);
        for (int c = 0; c < 3; ++c)
        {
            EXPECT_NEAR(channel(draw_at(front, kUp).at(32, 32), c), shown(double{(&colors.zenith.x)[c]}), 1)
                << c;
            EXPECT_NEAR(channel(draw_at(front, kDown).at(32, 32), c), shown(double{(&colors.ground.x)[c]}), 1)
                << c;
        }
        EXPECT_GT(channel(draw_at(front, kWall).at(32, 32), 0), channel(draw_at(behind, kWall).at(32, 32), 0))
            << elevation;
    }
    EXPECT_EQ(draw_at(std::nullopt, kWall).color, before.color) << "sky and sun as loaded";
}

/// A pack's sun becomes that of the daylight, whatever its own exposure is; lamps stay.
TEST_F(ShadingTest, daylightReplacesThePacksSun)
{
    const auto draw_scene = [&](float lux, bool lamp)
    {
        TestScene test;
        test.addInstance(test.addMesh(withMaterial(makeQuad(2, 2), test.addMaterial(plainMaterial()))),
                         Affine3{});
        if (lamp)
            test.addLight(light(LightType::point, 0));
        if (lux > 0)
            test.addLight(light(LightType::directional, lux));
        const PackView pack = test.build();
        const auto scene = upload(pack);
        const gpu::DaylightChange change =
            gpu::changeDaylight(*scene, shared::Daylight{.elevation_deg = 20, .azimuth_deg = 150}).value();
        EXPECT_EQ(change.sun.has_value(), lux > 0 || !lamp);
        return draw(*scene, squareCamera(), {.width = 64, .height = 64, .daylight = &change}).color;
    };
    const std::vector<uint32_t> expected = draw_scene(0, false);
    EXPECT_EQ(draw_scene(1, false), expected);
    EXPECT_EQ(draw_scene(100'000, true), expected);
    EXPECT_NE(draw_scene(0, true), expected) << "without a sun there is the sky alone";
}

TEST_F(ShadingTest, emissionFollowsTheExposure)
{
    // a black metal reflects nothing at normal incidence
    MaterialRecord material = plainMaterial();
    material.base_color = {0, 0, 0, 1};
    material.metallic = 1;
    const auto drawNits = [&](float nits, std::optional<float> lux)
    {
        TestScene test;
        if (lux)
            test.addLight(light(LightType::directional, *lux));
        material.emissive = {nits, nits, nits};
        return channel(drawMaterial(test, material).at(32, 32), 0);
    };
    const double key = double{shared::kKeyIlluminance};
    // white paper under 100,000 lux reflects 31,831 nits, which the exposure makes the key over pi
    EXPECT_NEAR(drawNits(31831, 100000.0f), shown(key / 3.14159265), 1);
    EXPECT_NEAR(drawNits(1000, 100000.0f), shown(1000 * key / 100000), 1);
    EXPECT_LT(drawNits(1000, 100000.0f), drawNits(31831, 100000.0f) / 3);
    EXPECT_NEAR(drawNits(0.3f, 10 * shared::kKeyIlluminance), shown(0.03), 1);
    // dim lights are not made brighter, and without lights there is nothing to follow
    EXPECT_NEAR(drawNits(0.3f, 0.5f), shown(0.3), 1);
    EXPECT_NEAR(drawNits(0.3f, std::nullopt), shown(0.3), 1);
}

TEST_F(ShadingTest, pointAndSpotLightsEndWhereTheySay)
{
    const auto drawWith = [&](LightRecord record)
    {
        TestScene test;
        record.world_from_light = translated({0, 0, 1});
        test.addLight(record);
        MaterialRecord material = plainMaterial();
        material.occlusion_texture = makeTextureRef(test.addImage(TexelFormat::rgba8_unorm, 1, 1, {gray(0)}));
        return drawMaterial(test, material);
    };
    LightRecord lamp = light(LightType::point, 3);
    EXPECT_GT(channel(drawWith(lamp).at(32, 32), 0), 150);
    EXPECT_GT(channel(drawWith(lamp).at(0, 0), 0), 20);
    lamp.range = 1.2f; // the corners are 1.73 m away
    EXPECT_GT(channel(drawWith(lamp).at(32, 32), 0), 50);
    EXPECT_EQ(channel(drawWith(lamp).at(0, 0), 0), 0);
    LightRecord spot = light(LightType::spot, 3);
    spot.outer_cone_rad = 0.4636f; // half a metre at one metre: halfway to the side
    const Image cone = drawWith(spot);
    EXPECT_GT(channel(cone.at(32, 32), 0), 150);
    EXPECT_GT(channel(cone.at(32 + 12, 32), 0), 0);
    EXPECT_EQ(channel(cone.at(32 + 18, 32), 0), 0);
}

TEST_F(ShadingTest, strongLightsAreExposedToTheSameImage)
{
    const auto drawWith = [&](float lux)
    {
        TestScene test;
        test.addLight(light(LightType::directional, lux));
        return drawMaterial(test, plainMaterial()).color;
    };
    EXPECT_EQ(drawWith(100), drawWith(120000));
    EXPECT_NE(drawWith(1), drawWith(2));
    EXPECT_LT(channel(drawWith(120000)[0], 0), 250) << "daylight does not blow out";
}

TEST_F(ShadingTest, aSurfaceAcrossTheEyePlaneIsShadedWithoutHoles)
{
    // a floor that runs under the eye and far behind it
    TestScene test;
    MaterialRecord material = unlitMaterial();
    material.flags |= kMaterialDoubleSided;
    material.base_color_texture = makeTextureRef(test.addImage(TexelFormat::rgba8_srgb, 1, 1, {gray(200)}));
    test.addInstance(test.addMesh(withMaterial(makeQuad(2000, 2000), test.addMaterial(material))), Affine3{});
    const PackView pack = test.build();
    const auto scene = upload(pack);
    const shared::Camera camera{
        .position = {0, 0, 0.1f}, .target = {0, 1, 0.05f}, .up = {0, 0, 1}, .z_near = 0.01f};
    const Image image = draw(*scene, camera, {.width = 64, .height = 64});
    for (uint32_t y = 34; y < 64; ++y)
        for (uint32_t x = 0; x < 64; ++x)
            ASSERT_EQ(image.at(x, y), gray(200)) << x << " " << y;
}

TEST_F(ShadingTest, everyMaterialShadesItsOwnPixels)
{
    TestScene test;
    for (uint32_t i = 0; i < 40; ++i)
    {
        MaterialRecord material = unlitMaterial();
        material.base_color_texture =
            makeTextureRef(test.addImage(TexelFormat::rgba8_srgb, 1, 1, {gray(5 * i + 20)}));
        const float y = 0.975f - 0.05f * static_cast<float>(i);
        test.addInstance(test.addMesh(withMaterial(makeQuad(2, 0.05f), test.addMaterial(material))),
                         translated({0, y, 0}));
    }
    const PackView pack = test.build();
    const auto scene = upload(pack);
    const Image image = draw(*scene, squareCamera(), {.width = 80, .height = 80});
    for (uint32_t i = 0; i < 40; ++i)
        EXPECT_EQ(image.at(40, 2 * i + 1), gray(5 * i + 20)) << i;
}

} // namespace hearth::test
