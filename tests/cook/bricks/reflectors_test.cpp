// Tests what surrounds lamps against closed forms: a dull half sphere, whose inside sends the light of every
// point evenly to the whole sphere, and a mirror.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/reflectors.h"
#include "formats/base/atomic_file.h"
#include "formats/gpu_shared/brick_lighting.h"
#include "formats/scene/scene_lighting.h"
#include "sample_assets/shapes/glb_writer.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"
#include "tests/cook/bricks/source_parts.h"

#include <gtest/gtest.h>

namespace hearth::bricks
{
namespace
{

using namespace samples;

constexpr float kVoxel = 0.1f;
constexpr Float4 kUnturned{0, 0, 0, 1};

/// Half of a sphere above the height 0, open below, whose inside is the front.
TriangleMesh makeDome(float radius)
{
    std::vector<Float2> profile;
    for (int i = 24; i >= 0; --i)
    {
        const float angle = samples::kPi * static_cast<float>(i) / 48;
        profile.push_back({i == 0 ? 0.0f : radius * sine(angle), radius * cosine(angle)});
    }
    return makeLathe(profile, 96);
}

/// Direction at an angle to -y.
Float3 downAt(float degrees)
{
    const float angle = degrees * samples::kPi / 180;
    return {0.6f * sine(angle), -cosine(angle), 0.8f * sine(angle)};
}

class Reflectors : public ::testing::Test
{
protected:
    /// Find the reflectors of a scene, and give them to its lights.
    void find(const Document& document)
    {
        ASSERT_TRUE(writeFile(folder_ / "lamp.glb", encodeGlb(document)).ok());
        const std::vector<SourceParts> sources{makeSourceParts(folder_, "lamp.glb")};
        const StaticScene scene = collectStaticScene(sources).value();
        const GridFrame frame{{-2, -2, -2}, double{kVoxel}, {40, 40, 40}};
        records_ = findReflectors(scene, frame, 0).value();
        lighting_ = shared::sceneLighting(sources[0].scene.lights(), scene.box());
        shared::addReflectors(lighting_, records_);
    }

    test::Sandbox folder_;
    std::vector<formats::ReflectorRecord> records_;
    shared::SceneLighting lighting_;
};

TEST_F(Reflectors, ofADullDomeAreThoseOfItsOpening)
{
    Document document;
    addObject(document, "dome", {{makeDome(0.15f), addPlainMaterial(document, "dull", {0.5f, 0.5f, 0.2f})}});
    addLight(document, {.name = "lamp", .intensity = 3}, {0, 0, 0}, kUnturned);
    find(document);
    ASSERT_EQ(records_.size(), 1u);
    const shared::Light& lamp = lighting_.lights[0];
    // a dielectric of roughness 1 gives back .01996 at its surface, and the rest of its base colour
    const auto opened = [](float base)
    {
        const float albedo = base * (1 - 0.01996f) + 0.01996f;
        return 2 * albedo / (2 - albedo); // over pi: half of the lamp's light, half of which leaves each time
    };
    for (const float angle : {0.0f, 10.0f, 30.0f, 50.0f, 70.0f})
    {
        SCOPED_TRACE(angle);
        const Float3 share = shared::reflectorShare(lamp, downAt(angle));
        const float cosine = -downAt(angle).y;
        EXPECT_NEAR(share.x, opened(0.5f) * cosine, 0.03f);
        EXPECT_NEAR(share.z, opened(0.2f) * cosine, 0.02f);
        EXPECT_EQ(share.x, share.y);
        EXPECT_NEAR(shared::reflectorPassed(lamp, downAt(angle)), 1, 0.01f);
    }
    for (const float angle : {120.0f, 180.0f})
    {
        EXPECT_NEAR(shared::reflectorShare(lamp, downAt(angle)).x, 0, 0.01f);
        EXPECT_EQ(shared::reflectorPassed(lamp, downAt(angle)), 0);
    }
    // what is farther away than the dome gets both, what is nearer nothing
    const shared::BrickGrid grid{{-2, -2, -2}, kVoxel, 40, 40, 40, 0};
    for (const float distance : {0.25f, 0.8f})
    {
        const Float3 at = (Float3{0, -distance, 0} - grid.origin) / kVoxel;
        const auto light =
            shared::brickUnshadowedLight(grid, shared::brickStartAt(at, at, {0, 1, 0}), lamp, {});
        const bool is_far = distance > shared::kReflectorReach * kVoxel;
        EXPECT_NEAR(light.irradiance.x,
                    is_far ? lamp.intensity.x * (1 + opened(0.5f)) / (samples::kPi * distance * distance) : 0,
                    0.03f * lamp.intensity.x);
    }
}

TEST_F(Reflectors, ofAMirrorAreTheLampsImage)
{
    Document document;
    addObject(document, "mirror",
              {{makeBox({0, -0.05f - 0.1f, 0}, {0.2f, 0.05f, 0.2f}, 1),
                addPlainMaterial(document, "silver", {0.9f, 0.9f, 0.9f}, 0.1f, 1)}});
    addLight(document, {.name = "lamp"}, {0, 0, 0}, kUnturned);
    find(document);
    ASSERT_EQ(records_.size(), 1u);
    const shared::Light& lamp = lighting_.lights[0];
    // the image shines up, as far as the mirror reaches: to 63 degrees at its sides
    for (const float angle : {0.0f, 20.0f, 45.0f})
    {
        EXPECT_NEAR(shared::reflectorShare(lamp, -downAt(angle)).x, 0.9f, 0.05f) << angle;
        EXPECT_NEAR(shared::reflectorPassed(lamp, -downAt(angle)), 1, 0.01f) << angle;
    }
    // samples are far apart opposite to the axis
    for (const float angle : {0.0f, 20.0f, 35.0f})
        EXPECT_NEAR(shared::reflectorPassed(lamp, downAt(angle)), 0, 0.01f) << angle;
    EXPECT_NEAR(shared::reflectorShare(lamp, downAt(30)).x, 0, 0.01f);
}

TEST_F(Reflectors, areOfLampsThatStandStillBesideSurfaces)
{
    Document document;
    addObject(document, "dome", {{makeDome(0.15f), addPlainMaterial(document, "dull", {0.5f, 0.5f, 0.5f})}});
    addLight(document, {.name = "sun", .kind = LightKind::directional}, {0, 0, 0}, kUnturned);
    addLight(document, {.name = "in the open"}, {0, -1, 0}, kUnturned);
    addLight(document, {.name = "below"}, {0, 0, 0}, kUnturned);
    find(document);
    ASSERT_EQ(records_.size(), 3u);
    EXPECT_EQ(records_[0].gain, shared::kNoReflector);
    EXPECT_EQ(records_[1].gain, shared::kNoReflector);
    EXPECT_NE(records_[2].gain, shared::kNoReflector);
    EXPECT_EQ(shared::reflectorPassed(lighting_.lights[1], {0, 1, 0}), 1);
    // none has one where the lamp moves
    document.lights.pop_back();
    document.nodes.pop_back();
    document.roots.pop_back();
    addLight(document, {.name = "moving"}, {0, 0, 0}, kUnturned);
    document.animations.push_back(
        {"swing",
         {{.node = document.roots.back(), .times = {0, 1}, .values = {kUnturned, {0, 0.6f, 0, 0.8f}}}}});
    find(document);
    EXPECT_TRUE(records_.empty());
}

/// A spot that shines down into the open has no light on the dome above it.
TEST_F(Reflectors, areOfWhatASpotShinesAt)
{
    Document document;
    addObject(document, "dome", {{makeDome(0.15f), addPlainMaterial(document, "dull", {0.5f, 0.5f, 0.5f})}});
    for (const float turn : {-1.0f, 1.0f}) // about x by 90 degrees: down, and up
        addLight(document, {.name = "spot", .kind = LightKind::spot}, {0, 0, 0},
                 {turn * 0.70710678f, 0, 0, 0.70710678f});
    find(document);
    ASSERT_EQ(records_.size(), 2u);
    EXPECT_EQ(records_[0].gain, shared::kNoReflector);
    EXPECT_NE(records_[1].gain, shared::kNoReflector);
}

} // namespace
} // namespace hearth::bricks
