// Tests which proxies cast shadows, and how far their triangles are moved.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/frame/proxy_casters.h"
#include "runtime/frame/shadow_fit.h"
#include "runtime/gpu/scene/shadow_cache.h"
#include "tests/runtime/scene_proxies.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <limits>

namespace hearth::test
{

namespace
{

constexpr float kInfinite = std::numeric_limits<float>::infinity();

/// Scene of a rock with a proxy, of one material.
struct RockScene
{
    explicit RockScene(const formats::MaterialRecord& material = plainMaterial(), float distance = 0.25f)
    {
        const uint32_t number = scene.addMaterial(material);
        scene.addInstance(scene.addMesh(withMaterial(shapes::rock(12, 0.2f), number)), Affine3{});
        addProxy(scene.model(), 0, shapes::rock(4, 0), distance, true);
    }

    TestScene scene;
};

uint32_t countCastingTriangles(RockScene rock)
{
    return shared::findProxyCasters(rock.scene.build()).rows[0].triangle_count;
}

} // namespace

TEST(ProxyCasters, areThoseThatStandForAllOfAMesh)
{
    const uint32_t triangles = 12 * 4 * 4;
    EXPECT_EQ(countCastingTriangles(RockScene()), triangles);

    formats::MaterialRecord masked = plainMaterial();
    masked.alpha_mode = static_cast<uint32_t>(formats::AlphaMode::mask);
    EXPECT_EQ(countCastingTriangles(RockScene(masked)), 0u);
    formats::MaterialRecord blended = plainMaterial();
    blended.alpha_mode = static_cast<uint32_t>(formats::AlphaMode::blend);
    EXPECT_EQ(countCastingTriangles(RockScene(blended)), 0u);
    formats::MaterialRecord unlit = plainMaterial();
    unlit.flags |= formats::kMaterialUnlit;
    EXPECT_EQ(countCastingTriangles(RockScene(unlit)), 0u);

    EXPECT_EQ(countCastingTriangles(RockScene(plainMaterial(), kInfinite)), 0u) << "an unknown distance";
    RockScene parts;
    addProxy(parts.scene.model(), 0, shapes::rock(2, 0), 0.25f, true);
    EXPECT_EQ(countCastingTriangles(std::move(parts)), 0u) << "one of two parts";
}

TEST(ProxyCasters, areNoneOfDeformedMeshes)
{
    PackModel model = smallPack();
    ASSERT_EQ(model.proxies[1].mesh, model.deformed_meshes[0].mesh);
    model.proxies[1].distance = model.proxies[1].mesh_distance = 1;
    const AlignedBytes bytes = model.bytes();
    const auto pack =
        formats::PackView::read(formats::ContainerReader::fromBytes(bytes.span(), "small.hearth").value());
    ASSERT_TRUE(pack.ok());
    const shared::ProxyCasters casters = shared::findProxyCasters(*pack);
    EXPECT_EQ(casters.rows[model.proxies[1].mesh].triangle_count, 0u);
    EXPECT_TRUE(casters.boxes[model.proxies[1].mesh].empty());
}

TEST(ProxyCasters, haveTwiceTheLesserDistanceAndTheBoxOfTheirPositions)
{
    RockScene rock;
    rock.scene.model().proxies[0].mesh_distance = kInfinite; // of what is inside
    const shared::ProxyCasters casters = shared::findProxyCasters(rock.scene.build());
    EXPECT_EQ(casters.rows[0].distance, 0.5f);
    EXPECT_EQ(casters.rows[0].is_closed, 1u);
    for (const Float3 position : shapes::rock(4, 0).positions)
        for (int axis = 0; axis < 3; ++axis)
        {
            EXPECT_LE(casters.boxes[0].min[axis], position[axis]);
            EXPECT_GE(casters.boxes[0].max[axis], position[axis]);
        }
    EXPECT_NEAR(casters.boxes[0].max.y, 1, 1e-5f);
}

TEST(ProxyCasters, trianglesThatFaceTheLightMoveByAllOfTheDistance)
{
    const shared::ShadowLight sun = shared::makeSunShadow({0, -1, 0}, {{-1, -1, -1}, {1, 1, 1}});
    const shared::ShadowLight lamp = shared::makeSpotShadow({0, 4, 0}, {0, -1, 0}, 0.1f);
    for (const shared::ShadowLight& light : {sun, lamp})
    {
        const Float3 below{0, -3, 0};
        const auto share = [&](float degrees)
        {
            const float angle = degrees * 0.0174532925f;
            return shared::proxyOffsetShare(light, below, {std::sin(angle), std::cos(angle), 0});
        };
        EXPECT_EQ(share(0), 1);
        EXPECT_NEAR(share(90), 1, 1e-5f);
        EXPECT_NEAR(share(105), 0.5f, 0.02f);
        EXPECT_NEAR(share(120), 0, 1e-5f);
        EXPECT_EQ(share(180), 0);
    }
}

/// Levels of a mesh whose proxy casts come and go without a change of shadows, and the eye has no say in
/// them; moves do.
TEST(ProxyCasters, mapsStayWhilePagesComeAndGoAndTheEyeMoves)
{
    RockScene rock;
    const formats::PackView pack = rock.scene.build();
    shared::Light light{};
    light.type = static_cast<uint32_t>(formats::LightType::spot);
    light.position = {0, 4, 0};
    light.direction = {0, -1, 0};
    light.cone_scale = 10;
    light.cone_offset = -7.0710678f;
    std::vector<gpu::ShadowCaster> spots;
    gpu::addShadowCasters(light, 0, 0, {{-1, -1, -1}, {1, 1, 1}}, 0.1f, spots);
    uint32_t group = 0; // the coarsest that has a coarser version
    for (uint32_t i = 0; i < pack.groups().size(); ++i)
        if (pack.groups()[i].error < kInfinite && pack.groups()[i].error > pack.groups()[group].error)
            group = i;
    for (const gpu::Casters casters : {gpu::Casters::clusters, gpu::Casters::proxies})
    {
        const gpu::ShadowOptions options{.max_maps = 1, .moving_layers = false, .casters = casters};
        gpu::ShadowCache cache(pack, options);
        const auto countStale = [&](Float3 eye)
        {
            const shared::FrameView view =
                shared::makeFrameView({.position = eye, .target = {0, 0, 0}}, 640, 480, 1, 1);
            gpu::ShadowPlan plan = gpu::planShadows(spots, options, view, {});
            return cache.plan(plan, view).size();
        };
        const Float3 eye{0, 1, 3}, other_eye{2, 1, 1};
        const size_t stale = casters == gpu::Casters::clusters ? 1 : 0;
        EXPECT_EQ(countStale(eye), 1u);
        EXPECT_EQ(countStale(eye), 0u);
        const pack::ResidentGroups::Change change{group, true};
        cache.publish({&change, 1});
        EXPECT_EQ(countStale(eye), stale);
        EXPECT_EQ(countStale(other_eye), stale);
        gpu::InstanceMove move{.instance = 0, .record = {}, .inverse = {}};
        std::memcpy(static_cast<void*>(&move.record), pack.instances().data(), sizeof(move.record));
        cache.move({&move, 1});
        EXPECT_EQ(countStale(other_eye), 1u);
    }
}

} // namespace hearth::test
