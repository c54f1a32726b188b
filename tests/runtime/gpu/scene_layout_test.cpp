// Tests the arrangement of a pack for drawing, and the conversion of a scene's lights. No device is needed.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/scene/scene_layout.h"
#include "runtime/gpu/scene/scene_shading.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace hearth::test
{

namespace
{

using namespace formats;
using gpu::Facing;

MaterialRecord materialWith(uint32_t flags, AlphaMode mode)
{
    MaterialRecord material = plainMaterial();
    material.flags = flags;
    material.alpha_mode = static_cast<uint32_t>(mode);
    return material;
}

/// Fill with every kind of material in one mesh, and instances of it with and without mirroring.
void fillMixed(TestScene& scene)
{
    const uint32_t materials[] = {scene.addMaterial(materialWith(0, AlphaMode::opaque)),
                                  scene.addMaterial(materialWith(kMaterialDoubleSided, AlphaMode::opaque)),
                                  scene.addMaterial(materialWith(0, AlphaMode::mask)),
                                  scene.addMaterial(materialWith(0, AlphaMode::blend)), kInvalidIndex};
    mesh::SourceMesh mesh = shapes::rock(12, 0.2f);
    mesh.triangle_materials.resize(mesh.triangleCount());
    for (size_t t = 0; t < mesh.triangleCount(); ++t)
        mesh.triangle_materials[t] = materials[t * 5 / mesh.triangleCount()];
    scene.addMesh(mesh);
    Affine3 mirror;
    mirror.m[1][1] = -1;
    for (int i = 0; i < 3; ++i)
        scene.addInstance(0, i == 1 ? mirror : Affine3{});
}

} // namespace

TEST(SceneLayout, everyClusterOfEveryInstanceIsInOneWorkItem)
{
    TestScene test;
    fillMixed(test);
    const PackView pack = test.build();
    const auto layout = gpu::makeSceneLayout(pack);
    ASSERT_TRUE(layout.ok());
    std::set<std::pair<uint32_t, uint32_t>> seen;
    for (const shared::WorkItem& item : layout->items)
    {
        EXPECT_GE(item.count, 1u);
        EXPECT_LE(item.count, shared::kWorkItemClusters);
        for (uint32_t i = 0; i < item.count; ++i)
            EXPECT_TRUE(seen.emplace(item.instance, layout->order[item.first + i]).second);
    }
    EXPECT_EQ(seen.size(), pack.instances().size() * pack.clusters().size());
    EXPECT_EQ(layout->instanced_clusters, seen.size());
}

TEST(SceneLayout, binsAgreeWithMaterialAndInstance)
{
    TestScene test;
    fillMixed(test);
    const PackView pack = test.build();
    const auto layout = gpu::makeSceneLayout(pack);
    ASSERT_TRUE(layout.ok());
    // opaque culled, mirrored and two-sided; mask and blend culled and mirrored
    EXPECT_EQ(layout->bins.size(), 7u);
    uint32_t next = 0;
    for (const gpu::SceneBin& bin : layout->bins)
    {
        EXPECT_EQ(bin.items.first_item, next);
        next += bin.items.item_count;
        for (uint32_t i = bin.items.first_item; i < next; ++i)
            for (uint32_t c = 0; c < layout->items[i].count; ++c)
            {
                const shared::WorkItem& item = layout->items[i];
                const uint32_t material = pack.clusters()[layout->order[item.first + c]].material;
                const uint32_t flags = material == kInvalidIndex ? 0 : pack.materials()[material].flags;
                const bool tested = material != kInvalidIndex && pack.materials()[material].alpha_mode != 0;
                EXPECT_EQ(bin.alpha_tested, tested);
                EXPECT_EQ(bin.material_row, tested ? material : 0);
                const Facing facing = (flags & kMaterialDoubleSided) != 0 ? Facing::doubleSided
                                      : item.instance == 1                ? Facing::mirrored
                                                                          : Facing::culled;
                EXPECT_EQ(bin.facing, facing);
                EXPECT_EQ(item.flags, facing == Facing::doubleSided ? shared::kItemDoubleSided : 0);
            }
    }
    EXPECT_EQ(next, layout->items.size());
}

TEST(SceneLayout, pagesLieApartAndInsideTheirSlices)
{
    TestScene test;
    test.addMesh(withMaterial(shapes::rock(40, 0.3f), kInvalidIndex));
    test.addInstance(0, Affine3{});
    const PackView pack = test.build();
    const auto layout = gpu::makeSceneLayout(pack);
    ASSERT_TRUE(layout.ok());
    ASSERT_GT(pack.pages().size(), 3u);
    uint32_t end = 0;
    for (size_t page = 0; page < pack.pages().size(); ++page)
    {
        EXPECT_GE(layout->pool.page_addresses[page], end);
        end = layout->pool.page_addresses[page] + pack.pages()[page].size / 4;
    }
    EXPECT_EQ(layout->pool.slice_words[0], end);
    for (size_t c = 0; c < pack.clusters().size(); ++c)
    {
        const ClusterRecord& cluster = pack.clusters()[c];
        EXPECT_EQ(layout->draws[c].address, layout->pool.page_addresses[cluster.page] + cluster.page_word +
                                                uvBaseWords(pack.meshes()[0].attributes));
        EXPECT_EQ(layout->draws[c].counts,
                  cluster.vertex_count | cluster.triangle_count << 9u | cluster.level << 17u);
    }
}

TEST(SceneLayout, E4004_moreGeometryThanThePoolHolds)
{
    TestScene test;
    test.addInstance(test.addMesh(makeQuad(1, 1)), Affine3{});
    PackModel model = test.model();
    model.pages[0].size = kMaxPageBytes; // only the tables are read
    model.pages.resize(8193, model.pages[0]);
    const AlignedBytes bytes = model.bytes();
    auto reader = ContainerReader::fromBytes(bytes.span(), "big");
    ASSERT_TRUE(reader.ok());
    const auto pack = PackView::read(std::move(*reader));
    ASSERT_TRUE(pack.ok());
    const auto layout = gpu::makeSceneLayout(*pack);
    ASSERT_FALSE(layout.ok());
    EXPECT_EQ(layout.error().issue, Issue::device_limit);
    EXPECT_NE(formatMessage(layout.error()).find("512 MiB"), std::string::npos);
}

TEST(PoolLayout, holdsThePinnedPagesAndSlotsWithinTheBudget)
{
    TestScene test;
    test.addInstance(test.addMesh(withMaterial(shapes::rock(40, 0.3f), kInvalidIndex)), Affine3{});
    const PackView pack = test.build();
    const pack::PageGraph graph = pack::PageGraph::of(pack);
    const size_t others = graph.pageCount() - graph.pinned().size();
    ASSERT_GT(others, 3u);
    for (uint64_t budget = graph.pinnedBytes(); budget < 70000 * others; budget += 12345)
    {
        const auto layout = gpu::placePinnedPages(pack, graph, budget);
        ASSERT_TRUE(layout.ok());
        EXPECT_LE(layout->bytes(), budget);
        EXPECT_LE(layout->slot_addresses.size(), others);
        if (layout->slot_addresses.size() < others)
        {
            EXPECT_GT(layout->bytes() + layout->slot_bytes, budget) << "another slot would have fitted";
        }
        uint32_t end = 0;
        for (const uint32_t page : graph.pinned())
        {
            EXPECT_EQ(layout->page_addresses[page], end);
            end += graph.sizeBytes(page) / 4;
        }
        for (const uint32_t address : layout->slot_addresses)
        {
            EXPECT_EQ(address, end);
            end += layout->slot_bytes / 4;
        }
        for (uint32_t page = 0; page < graph.pageCount(); ++page)
            EXPECT_EQ(layout->page_addresses[page] == gpu::kNoAddress, !graph.isPinned(page));
    }
    const auto whole =
        gpu::placePinnedPages(pack, graph, graph.pinnedBytes() + others * gpu::findPoolSlotBytes(graph));
    ASSERT_TRUE(whole.ok());
    EXPECT_EQ(whole->slot_addresses.size(), others) << "the share of a budget that holds all pages";
    const auto refused = gpu::placePinnedPages(pack, graph, graph.pinnedBytes() - 1);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().issue, Issue::streaming_budget);
}

TEST(PoolLayout, slotsDoNotCrossSlicesAndEndWithThePool)
{
    // 20000 pages of 60000 bytes: more than fit into the pool. Only their sizes are read.
    TestScene test;
    test.addInstance(test.addMesh(makeQuad(1, 1)), Affine3{});
    const PackView pack = test.build();
    std::vector<pack::PageNode> nodes(
        20000, {.size_bytes = 60000, .holds_root = false, .needs = {}, .companions = {}});
    nodes[0].holds_root = true;
    const pack::PageGraph graph(nodes);
    const auto layout = gpu::placePinnedPages(pack, graph, uint64_t{1} << 40);
    ASSERT_TRUE(layout.ok());
    constexpr uint32_t kSliceWords = 1u << shared::kPoolSliceAddressBits;
    EXPECT_EQ(layout->slot_bytes, 60032u);
    EXPECT_EQ(layout->slot_addresses.size(), 4 * (kSliceWords * 4 / 60032) - 1);
    for (const uint32_t address : layout->slot_addresses)
        ASSERT_LE(address % kSliceWords + layout->slot_bytes / 4, kSliceWords);
    EXPECT_LE(layout->slot_addresses.back(), 4 * (kSliceWords - 1));
}

TEST(InstanceInverse, undoesTheLinearPart)
{
    std::mt19937 random(1);
    for (int i = 0; i < 100; ++i)
    {
        InstanceRecord instance{};
        instance.world_from_object = randomAffine(random, 0);
        const shared::InstanceInverse inverse = shared::makeInstanceInverse(instance);
        ASSERT_EQ(inverse.object_from_world_x.w, 1);
        const Float3 point{uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1)};
        const Float3 world = transformVector(instance.world_from_object, point);
        const Float3 back{shared::dot3(shared::row3(inverse.object_from_world_x), world),
                          shared::dot3(shared::row3(inverse.object_from_world_y), world),
                          shared::dot3(shared::row3(inverse.object_from_world_z), world)};
        EXPECT_LT(length(back - point), 1e-4f);
    }
}

TEST(InstanceInverse, saysSoWhereThereIsNone)
{
    InstanceRecord instance{};
    instance.world_from_object.m[1][1] = 0;
    EXPECT_EQ(shared::makeInstanceInverse(instance).object_from_world_x.w, 0);
}

TEST(SceneLighting, aSceneWithoutLightsGetsOneSun)
{
    TestScene test;
    const shared::SceneLighting lighting = gpu::makeLighting(test.build());
    EXPECT_EQ(lighting.lights.size(), 1u);
    EXPECT_LT(lighting.lights[0].direction.y, 0);
}

TEST(SceneLighting, brightScenesAreScaledDownToTheKeyAndDimOnesAreNot)
{
    const auto getIntensity = [](float lux)
    {
        TestScene test;
        LightRecord sun{};
        sun.color = {1, 1, 1};
        sun.intensity = lux;
        test.addLight(sun);
        return gpu::makeLighting(test.build()).lights[0].intensity.x;
    };
    EXPECT_FLOAT_EQ(getIntensity(0.5f), 0.5f);
    EXPECT_NEAR(getIntensity(100000), shared::kKeyIlluminance, 1e-4f);
}

TEST(SceneLighting, moreLightsThanFitAreLeftOut)
{
    TestScene test;
    LightRecord lamp{};
    lamp.color = {1, 1, 1};
    for (uint32_t i = 0; i < shared::kMaxLights + 3; ++i)
        test.addLight(lamp);
    EXPECT_EQ(gpu::makeLighting(test.build()).lights.size(), shared::kMaxLights);
}

} // namespace hearth::test
