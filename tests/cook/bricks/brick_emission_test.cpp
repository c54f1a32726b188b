// Tests the light that the bricks of emissive bodies send out against closed forms: of a convex body with one
// radiance L, the mean irradiance at a distance D is L A / (4 D^2), whatever its shape (A. Cauchy, 1832).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/light/emission.h"
#include "cook/bricks/light/face_lighting.h"
#include "formats/gpu_shared/brick_lighting.h"
#include "sample_assets/shapes/glb_writer.h"
#include "sample_assets/shapes/sample_math.h"
#include "sample_assets/shapes/scene_parts.h"
#include "sample_assets/shapes/shapes.h"
#include "tests/cook/bricks/bricks_scene.h"
#include "tests/cook/bricks/source_parts.h"
#include "tests/support/sanitized.h"

#include <gtest/gtest.h>
#include <numbers>

namespace hearth::bricks
{
namespace
{

using namespace samples;

constexpr float kVoxel = 0.1f; ///< metres
constexpr float kRadiance = 4; ///< of the bodies, red

constexpr uint32_t kDirections = 64, kRays = 16384;

Float4 randomRotation(Random& random)
{
    const auto [x, y, z] = randomFrame(random);
    return rotationAbout(narrow(x), static_cast<float>(uniform(random, 0, 3)));
}

Float3 randomPoint(Random& random)
{
    return narrow(uniformPoint(random, -0.3, 0.3));
}

TriangleMesh makeBall(float radius)
{
    std::vector<Float2> profile;
    for (int i = 0; i <= 24; ++i)
    {
        const float angle = samples::kPi * static_cast<float>(i) / 24;
        profile.push_back({i % 24 == 0 ? 0.0f : radius * sine(angle), radius * cosine(angle)});
    }
    return makeLathe(profile, 48);
}

float computeArea(const TriangleMesh& mesh)
{
    float area = 0;
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    {
        const Float3 a = mesh.positions[mesh.indices[i]];
        area += 0.5f * length(cross(mesh.positions[mesh.indices[i + 1]] - a,
                                    mesh.positions[mesh.indices[i + 2]] - a));
    }
    return area;
}

class BrickEmission : public ::testing::Test
{
protected:
    /// Cook a scene at kVoxel. Surfaces reflect nothing: all light comes straight from the body.
    void cook(const TriangleMesh& body, const TriangleMesh& wall = {})
    {
        Document document;
        const int lamp = addEmissiveMaterial(document, "lamp", {1, 0.5f, 0.25f}, kRadiance);
        document.materials[static_cast<size_t>(lamp)].base_color = {0, 0, 0, 1};
        samples::addObject(document, "body", {{body, lamp}});
        if (!wall.indices.empty())
            samples::addObject(document, "wall", {{wall, addPlainMaterial(document, "black", {0, 0, 0})}});
        ASSERT_TRUE(writeFile(folder_ / "body.glb", encodeGlb(document)).ok());
        sources_.clear();
        sources_.push_back(makeSourceParts(folder_, "body.glb"));
        const StaticScene scene = collectStaticScene(sources_).value();
        GridSettings settings;
        settings.voxel_size = double{kVoxel};
        grid_.emplace(cookGrid(scene, settings).value());
        flux_ = traceEmission(scene, *grid_).value();
    }

    /// Return the irradiance over pi at a position, facing a direction.
    float irradianceAt(Float3 position, Float3 normal) const
    {
        const BrickView view = makeBrickView(grid_->tables);
        const FaceLighting lighting(view);
        const Float3 at = (position - view.masks.grid.origin) / kVoxel;
        return shared::brickGather(lighting.scene(), {}, shared::brickStartAt(at, at, normal), kRays, 1).x;
    }

    test::Sandbox folder_;
    std::vector<SourceParts> sources_;
    std::optional<CookedGrid> grid_;
    EmittedFlux flux_;
};

/// Directions that are evenly spread over the sphere.
std::vector<Float3> spreadDirections()
{
    std::vector<Float3> directions;
    for (uint32_t i = 0; i < kDirections; ++i)
    {
        const float z = 1 - (2 * static_cast<float>(i) + 1) / kDirections;
        const float angle = 2.39996323f * static_cast<float>(i), radius = std::sqrt(1 - z * z);
        directions.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
    return directions;
}

} // namespace

TEST_F(BrickEmission, isThatOfConvexBodiesWhateverTheirShapeAndPlace)
{
    constexpr float kDistance = 2;
    Random random(11);
    const std::vector<TriangleMesh> shapes{makeBall(0.12f),
                                           makeBall(0.21f),
                                           makeBall(0.37f),
                                           makeBox({0, 0, 0}, {0.25f, 0.15f, 0.2f}, 1),
                                           makeBox({0, 0, 0}, {0.3f, 0.02f, 0.25f}, 1),
                                           makeBox({0, 0, 0}, {0.03f, 0.3f, 0.03f}, 1)};
    for (size_t i = 0; i < shapes.size(); i += test::kSanitized ? 3 : 1)
    {
        const Float3 center = randomPoint(random);
        const TriangleMesh body =
            transformed(shapes[i], {.translation = center, .rotation = randomRotation(random)});
        cook(body);
        const float area = computeArea(body);
        EXPECT_NEAR(flux_.sent.x, kRadiance * area / (kVoxel * kVoxel), 0.01 * flux_.sent.x) << i;
        EXPECT_NEAR(flux_.credited.x, flux_.sent.x, 0.01 * flux_.sent.x) << i;
        float mean = 0;
        for (const Float3 direction : spreadDirections())
            mean += irradianceAt(center + direction * kDistance, -direction) / kDirections;
        const float expected = kRadiance * area / (4 * std::numbers::pi_v<float> * kDistance * kDistance);
        std::printf("body %zu: %.3f of its light\n", i, mean / expected);
        EXPECT_NEAR(mean / expected, 1, 0.06) << i;
    }
}

/// The strip hangs nearer to a black wall than a voxel. The wall hides nothing of it from the front.
TEST_F(BrickEmission, ofAStripBeforeAWallReachesTheRoom)
{
    constexpr float kDistance = 3;
    const Float3 half{0.02f, 0.02f, 0.2f};
    Random random(12);
    for (const float gap : {0.2f, 0.5f, 1.0f})
        for (int turn = 0; turn < 2; ++turn)
        {
            const Placement place{.translation = randomPoint(random),
                                  .rotation = turn == 0 ? Float4{0, 0, 0, 1} : randomRotation(random)};
            const Float3 middle{gap * kVoxel + half.x, 0, 0};
            cook(transformed(makeBox(middle, half, 1), place),
                 transformed(makeBox({-0.1f, 0, 0}, {0.1f, 1, 1}, 1), place));
            float sum = 0, expected = 0;
            for (const Float3 direction : spreadDirections())
            {
                if (direction.x < 0.2f)
                    continue; // behind the wall, or along it
                const Float3 seen_from = middle + direction * kDistance;
                sum += irradianceAt(place.translation + rotate(place.rotation, seen_from),
                                    -rotate(place.rotation, direction));
                const float visible_area =
                    4 * (half.y * half.z * std::abs(direction.x) + half.x * half.z * std::abs(direction.y) +
                         half.x * half.y * std::abs(direction.z));
                expected += kRadiance * visible_area / (std::numbers::pi_v<float> * kDistance * kDistance);
            }
            std::printf("gap of %.1f voxels, %s: %.3f of its light\n", double{gap},
                        turn == 0 ? "on the grid" : "turned", double{sum / expected});
            EXPECT_NEAR(sum / expected, 1, 0.16) << gap << " " << turn;
        }
}

/// Two lamps of the same radiance, one of twice the area; then apart.
TEST_F(BrickEmission, isSharedByWhatInstancesSend)
{
    const auto findShares = [&](Float3 offset)
    {
        Document document;
        const int lamp = addEmissiveMaterial(document, "lamp", {1, 0.5f, 0}, kRadiance);
        document.materials[static_cast<size_t>(lamp)].base_color = {0, 0, 0, 1};
        // back to back, in one voxel if they are not moved apart
        samples::addObject(document, "small",
                           {{makeBox({0.05f, 0.05f, 0.05f}, {0.01f, 0.01f, 0.01f}, 1), lamp}});
        samples::addObject(
            document, "large",
            {{transformed(makeBox({0.05f, 0.08f, 0.05f}, {0.02f, 0.01f, 0.01f}, 1), {.translation = offset}),
              lamp}});
        EXPECT_TRUE(writeFile(folder_ / "body.glb", encodeGlb(document)).ok());
        sources_.clear();
        sources_.push_back(makeSourceParts(folder_, "body.glb"));
        const StaticScene scene = collectStaticScene(sources_).value();
        GridSettings settings;
        settings.voxel_size = double{kVoxel};
        settings.min = Double3{-1, -1, -1};
        settings.max = Double3{1, 1, 1};
        grid_.emplace(cookGrid(scene, settings).value());
        EXPECT_TRUE(traceEmission(scene, *grid_).ok());
        return findEmissionShares(scene, makeBrickView(grid_->tables)).value();
    };
    const std::vector<EmissionShare> joint = findShares({});
    ASSERT_FALSE(joint.empty());
    for (size_t i = 0; i < joint.size(); i += 2)
    {
        ASSERT_EQ(joint[i].face, joint[i + 1].face);
        // areas are 6 and 10 squares of a side; each hides a part of the other
        EXPECT_NEAR(joint[i].share.x, 0.375f, 0.06f);
        EXPECT_NEAR(joint[i].share.x + joint[i + 1].share.x, 1, 1e-5f);
        EXPECT_NEAR(joint[i].share.y, joint[i].share.x, 1e-5f);
        EXPECT_EQ(joint[i].share.z, 0) << "no instance sends blue";
    }
    size_t faces = 0;
    for (const uint32_t code : grid_->tables.emission)
        faces += code != 0 ? 1u : 0u;
    EXPECT_GE(joint.size(), 2 * faces);
    for (const EmissionShare& share : findShares({0.5f, 0, 0}))
        EXPECT_EQ(share.share.x, 1) << "of a voxel with one instance";
}

} // namespace hearth::bricks
