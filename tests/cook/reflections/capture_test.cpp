// Tests what probes capture beside closed forms of light, for rooms of the real importer and cookers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/reflections/capture/capture.h"

#include "cook/bricks/light/scene_light.h"
#include "sample_assets/shapes/glb_writer.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"
#include "tests/cook/bricks/source_parts.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <cstdio>
#include <numbers>

namespace hearth::reflections
{
namespace
{

using namespace samples;
using environment::Layout;

constexpr uint32_t kSide = 16;

class CaptureTest : public ::testing::Test
{
protected:
    void read(const Document& document)
    {
        ASSERT_TRUE(writeFile(folder_ / "scene.glb", encodeGlb(document)).ok());
        sources_.push_back(bricks::makeSourceParts(folder_, "scene.glb"));
        scene_ = bricks::collectStaticScene(sources_).value();
        lighting_ = bricks::makeSceneLighting(scene_);
        surfaces_ = std::make_unique<Surfaces>(Surfaces::read(scene_).value());
    }

    Capture capture(Float3 position) const
    {
        return captureRadiance(*surfaces_, lighting_, {}, position, kSide);
    }

    test::Sandbox folder_;
    std::vector<bricks::SourceParts> sources_;
    bricks::StaticScene scene_;
    shared::SceneLighting lighting_;
    std::unique_ptr<Surfaces> surfaces_;
};

/// Box of 4 x 3 x 5 m whose faces look inwards.
TriangleMesh makeRoom()
{
    TriangleMesh room = makeBox({0, 1.5f, 0}, {2, 1.5f, 2.5f}, 1);
    for (size_t i = 0; i + 2 < room.indices.size(); i += 3)
        std::swap(room.indices[i], room.indices[i + 1]);
    setFlatNormals(room);
    return room;
}

Double3 mean(const environment::Environment& cube)
{
    Double3 sum;
    for (const Float3& texel : cube.texels)
        sum = sum + widen(texel) * (1.0 / static_cast<double>(cube.texels.size()));
    return sum;
}

} // namespace

TEST_F(CaptureTest, shiningRoomHasTheLightOfAFurnace)
{
    Document document;
    addObject(document, "room",
              {{makeRoom(), addEmissiveMaterial(document, "walls", {1, 0.5f, 0.25f}, 0.2f)}});
    read(document);
    const Capture seen = capture({0.4f, 1, 0.3f});
    const double reflected = double{bricks::meanAlbedo(scene_.material(0, 0)).x};
    ASSERT_GT(reflected, 0.2);
    const double expected = 0.2 * double{lighting_.exposure} / (1 - reflected);
    const Double3 found = mean(seen.radiance);
    EXPECT_NEAR(found.x, expected, 0.02 * expected);
    EXPECT_NEAR(found.y, expected / 2, 0.01 * expected);
    EXPECT_NEAR(found.z, expected / 4, 0.005 * expected);
    double squares = 0;
    for (const Float3& texel : seen.radiance.texels)
        squares += (double{texel.x} - expected) * (double{texel.x} - expected);
    const double noise = std::sqrt(squares / static_cast<double>(seen.radiance.texels.size())) / expected;
    std::printf("noise of 32 paths a texel: %.1f %% rms\n", 100 * noise);
    EXPECT_LE(noise, 0.12);
    EXPECT_EQ(seen.sky_share, Float4{});
    EXPECT_EQ(seen.black_share, 0);
}

TEST_F(CaptureTest, floorUnderALampHasItsIlluminance)
{
    Document document;
    const int paint = addPlainMaterial(document, "paint", {0.6f, 0.3f, 0.1f});
    addObject(document, "floor", {{makeBox({0, -0.1f, 0}, {20, 0.1f, 20}, 1), paint}});
    samples::Light bulb;
    bulb.name = "bulb";
    bulb.intensity = 2;
    addLight(document, bulb, {0.5f, 2, 0}, {0, 0, 0, 1});
    read(document);
    const Capture seen = capture({0, 1, 0});
    const Float3 albedo = bricks::meanAlbedo(scene_.material(0, 0));
    const auto& radiance = seen.radiance;
    for (uint32_t i = 0; i < kSide * kSide; ++i)
    {
        const environment::PanelArea area = radiance.area(i % kSide, i / kSide);
        const Double3 direction =
            panelDirection(Layout::cube, 3, {(area.u0 + area.u1) / 2, (area.v0 + area.v1) / 2});
        const Double3 at = direction * (-1 / direction.y); // on the floor, seen from 1 m above it
        const Double3 offset = Double3{0.5, 2, 0} - Double3{at.x, 0, at.z};
        const double illuminance = double{lighting_.lights[0].intensity.x} * 2 / std::pow(length(offset), 3);
        // the sky, which nothing hides, adds its share
        const double sky = double{shared::kSkyHorizon.x} * 0.9;
        const double found = double{radiance.texels[radiance.index(3, i % kSide, i / kSide)].x};
        EXPECT_NEAR(found, double{albedo.x} * (illuminance / std::numbers::pi + sky),
                    0.05 * found + 0.1 * double{albedo.x} * sky);
    }
    // the lamp itself: I / d^2 from 1.118 m, times the harmonics of its direction, which no radiance has
    const Double3 to_lamp{0.5, 1, 0};
    const double distance = length(to_lamp);
    const double irradiance = double{lighting_.lights[0].intensity.y} / (distance * distance);
    EXPECT_NEAR(seen.lamp_harmonics[0], irradiance * 0.282095, 0.001 * irradiance);
    EXPECT_NEAR(seen.lamp_harmonics[1], irradiance * 0.488603 * to_lamp.y / distance, 0.001 * irradiance);
    EXPECT_NEAR(seen.lamp_harmonics[2], irradiance * 0.488603 * to_lamp.x / distance, 0.001 * irradiance);
    EXPECT_NEAR(seen.lamp_harmonics[3], 0, 0.001 * irradiance);
    EXPECT_NEAR(seen.sky_share.w, 0.5, 0.03) << "the upper half";
    EXPECT_NEAR(seen.sky_share.w + seen.sky_share.y, 1, 0.03) << "about the normal of the floor";
    EXPECT_NEAR(seen.sky_share.x, 0, 0.01);
}

TEST_F(CaptureTest, openSkyIsSeenAsItIs)
{
    Document document;
    const int paint = addPlainMaterial(document, "paint", {0.5f, 0.5f, 0.5f});
    addObject(document, "crumb", {{makeBox({100, 0, 0}, {0.01f, 0.01f, 0.01f}, 1), paint}});
    read(document);
    const Capture seen = capture({});
    EXPECT_EQ(seen.lamp_harmonics, (std::array<float, 9>{}));
    for (uint32_t i = 0; i < kSide * kSide; ++i)
    {
        const environment::PanelArea area = seen.radiance.area(i % kSide, i / kSide);
        const Float3 direction =
            narrow(panelDirection(Layout::cube, 4, {(area.u0 + area.u1) / 2, (area.v0 + area.v1) / 2}));
        EXPECT_NEAR(seen.radiance.texels[seen.radiance.index(4, i % kSide, i / kSide)].y,
                    shared::skyRadiance(lighting_.sky, direction).y, 0.01f);
    }
    EXPECT_NEAR(seen.sky_share.w, 1, 1e-4);
    EXPECT_NEAR(seen.sky_share.y, 0, 1e-3);
}

TEST_F(CaptureTest, solidIsBlackFromInside)
{
    Document document;
    const int paint = addPlainMaterial(document, "paint", {0.5f, 0.5f, 0.5f});
    addObject(document, "block", {{makeBox({}, {1, 1, 1}, 1), paint}});
    read(document);
    const Capture seen = capture({0.2f, 0, 0});
    EXPECT_NEAR(seen.black_share, 1, 1e-6);
    EXPECT_EQ(length(mean(seen.radiance)), 0);
}

TEST_F(CaptureTest, boxEndsAtTheWalls)
{
    Document document;
    addObject(document, "room", {{makeRoom(), addPlainMaterial(document, "paint", {0.5f, 0.5f, 0.5f})}});
    read(document);
    const Box3 room = findBox(*surfaces_, {0.5f, 1, -2});
    EXPECT_NEAR(length(room.min - Float3{-2, 0, -2.5f}), 0, 1e-3f);
    EXPECT_NEAR(length(room.max - Float3{2, 3, 2.5f}), 0, 1e-3f);
    const Box3 open = findBox(*surfaces_, {10, 1, 0});
    EXPECT_NEAR(open.min.x, 2, 1e-3f);
    EXPECT_GT(open.max.x, 20);
}

TEST_F(CaptureTest, bytesDoNotDependOnThreads)
{
    Document document;
    addObject(document, "room",
              {{makeRoom(), addEmissiveMaterial(document, "walls", {1, 0.5f, 0.25f}, 0.2f)}});
    read(document);
    const std::vector<Float3> many = capture({0.4f, 1, 0.3f}).radiance.texels;
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    EXPECT_EQ(capture({0.4f, 1, 0.3f}).radiance.texels, many);
}

} // namespace hearth::reflections
