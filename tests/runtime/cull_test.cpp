// The culling passes against their C++ twin: every buffer, every bit.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/cook/shapes.h"
#include "tests/runtime/gpu_fixture.h"
#include "tests/runtime/test_scene.h"

#include <bit>

namespace hearth::test
{

namespace
{

using namespace shared;

template <typename T>
std::vector<T> recordsAs(const auto& records)
{
    std::vector<T> result(records.size());
    if (!result.empty())
        std::memcpy(static_cast<void*>(result.data()), records.data(), records.size_bytes());
    return result;
}

template <typename T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

/// What the passes write, computed one element after the other.
struct Twin
{
    std::vector<InstanceState> states;
    std::vector<WorkResult> results;
    std::vector<uint32_t> totals;
    std::vector<VisibleCluster> visible;
    std::vector<BinDraw> bin_draws;
    std::vector<uint32_t> material_draws;
};

WorkResult twinResult(const FrameView& view, const gpu::SceneLayout& layout, const WorkItem& item,
                      const std::vector<Instance>& instances, const std::vector<InstanceState>& states,
                      const std::vector<Cluster>& clusters, const std::vector<Group>& groups)
{
    WorkResult result{};
    for (uint32_t lane = 0; lane < item.count; ++lane)
    {
        const Cluster& cluster = clusters[layout.order[item.first + lane]];
        const Group& refined =
            groups[cluster.refined_group == kNoGroup ? cluster.group : cluster.refined_group];
        if (decideCluster(view, instances[item.instance], states[item.instance], cluster,
                          groups[cluster.group], refined, (item.flags & kItemDoubleSided) != 0))
            (lane < 32 ? result.mask_low : result.mask_high) |= 1u << (lane % 32);
    }
    return result;
}

uint32_t countOf(const WorkResult& result)
{
    return static_cast<uint32_t>(std::popcount(result.mask_low) + std::popcount(result.mask_high));
}

Twin makeTwin(const formats::PackView& pack, const gpu::SceneLayout& layout, const FrameView& view)
{
    const auto instances = recordsAs<Instance>(pack.instances());
    const auto clusters = recordsAs<Cluster>(pack.clusters());
    const auto groups = recordsAs<Group>(pack.groups());

    Twin twin;
    for (uint32_t i = 0; i < instances.size(); ++i)
        twin.states.push_back(
            decideInstance(view, instances[i], layout.inverses[i], layout.bounds[instances[i].mesh]));

    uint32_t slot = 0, block_start = 0;
    std::vector<uint32_t> slot_of_item;
    twin.material_draws.assign((layout.material_rows + 1) * 4, 0);
    for (uint32_t i = 0; i < layout.items.size(); ++i)
    {
        if (i % kScanBlockItems == 0)
            twin.totals.push_back(block_start = slot);
        const WorkItem& item = layout.items[i];
        WorkResult result = twinResult(view, layout, item, instances, twin.states, clusters, groups);
        result.offset = slot - block_start;
        slot_of_item.push_back(slot);
        slot += countOf(result);
        twin.results.push_back(result);
        for (uint32_t lane = 0; lane < item.count; ++lane)
            if (((lane < 32 ? result.mask_low : result.mask_high) >> (lane % 32) & 1) != 0)
            {
                const uint32_t cluster = layout.order[item.first + lane];
                twin.visible.push_back({item.instance, cluster});
                twin.material_draws[layout.draws[cluster].material * 4] = 3;
                twin.material_draws[layout.draws[cluster].material * 4 + 1] = 1;
            }
    }
    twin.totals.push_back(slot);
    slot_of_item.push_back(slot);
    for (const gpu::SceneBin& bin : layout.bins)
    {
        const uint32_t first = slot_of_item[bin.items.first_item];
        const uint32_t end = slot_of_item[bin.items.first_item + bin.items.item_count];
        twin.bin_draws.push_back({kClusterVertices, end - first, 0, 0, first, 0, 0, 0});
    }
    return twin;
}

/// Rocks, terrain and foliage with every kind of bin, thrown about with sheared and mirrored transforms.
void fillScene(TestScene& scene, std::mt19937& random, int instances, float reach)
{
    formats::MaterialRecord two_sided = plainMaterial();
    two_sided.flags = formats::kMaterialDoubleSided;
    formats::MaterialRecord masked = plainMaterial();
    masked.alpha_mode = static_cast<uint32_t>(formats::AlphaMode::mask);
    const uint32_t plain = scene.addMaterial(plainMaterial());
    const uint32_t sheet = scene.addMaterial(two_sided);
    const uint32_t holes = scene.addMaterial(masked);

    mesh::SourceMesh mixed = withMaterial(shapes::rock(12, 0.3f, 5), plain);
    for (size_t t = 0; t < mixed.triangle_materials.size(); t += 3)
        mixed.triangle_materials[t] = t % 2 == 0 ? holes : sheet;
    const uint32_t meshes[] = {scene.addMesh(withMaterial(shapes::rock(16, 0.2f), plain)),
                               scene.addMesh(withMaterial(shapes::terrain(24), sheet)),
                               scene.addMesh(withMaterial(shapes::foliage(300), holes)),
                               scene.addMesh(mixed)};
    for (int i = 0; i < instances; ++i)
        scene.addInstance(meshes[random() % 4], randomAffine(random, reach));
}

shared::Camera randomCamera(std::mt19937& random, float reach)
{
    const auto point = [&](float r) {
        return Float3{uniform(random, -r, r), uniform(random, -r, r), uniform(random, -r, r)};
    };
    shared::Camera camera;
    camera.position = point(reach * 1.5f);
    camera.target = point(reach * 0.5f);
    camera.y_fov_rad = uniform(random, 0.2f, 1.8f);
    camera.z_near = uniform(random, 0.001f, 1.0f);
    return camera;
}

class CullTest : public GpuTest
{
protected:
    void expectTwin(const formats::PackView& pack, const gpu::Scene& scene, const gpu::SceneLayout& layout,
                    const shared::Camera& camera, const DrawOptions& options)
    {
        const Picture picture = draw(scene, camera, options);
        const Twin twin = makeTwin(pack, layout,
                                   makeFrameView(camera, options.width, options.height, options.error_pixels,
                                                 scene.instance_count, options.flags));
        EXPECT_TRUE(sameBits(read<InstanceState>(scene.buffers.states, twin.states.size()), twin.states));
        EXPECT_TRUE(sameBits(read<WorkResult>(scene.buffers.results, twin.results.size()), twin.results));
        EXPECT_TRUE(sameBits(read<uint32_t>(scene.buffers.totals, twin.totals.size()), twin.totals));
        EXPECT_TRUE(sameBits(read<BinDraw>(scene.buffers.bin_draws, twin.bin_draws.size()), twin.bin_draws));
        EXPECT_TRUE(sameBits(read<uint32_t>(scene.buffers.material_draws, twin.material_draws.size()),
                             twin.material_draws));
        EXPECT_TRUE(sameBits(picture.list.slots, twin.visible));
        drawn_ += twin.visible.size();
    }

    size_t drawn_ = 0;
};

} // namespace

TEST_F(CullTest, equalsItsTwinBitForBitOnRandomScenes)
{
    std::mt19937 random(7);
    for (const float reach : {4.0f, 60.0f})
    {
        TestScene test;
        fillScene(test, random, 70, reach);
        const formats::PackView pack = test.build();
        const auto layout = gpu::makeSceneLayout(pack);
        ASSERT_TRUE(layout.ok());
        const auto scene = upload(pack);
        for (int view = 0; view < 24; ++view)
        {
            const float error = view % 6 == 0 ? 0.0f : std::exp2(uniform(random, -2.0f, 6.0f));
            const auto flags =
                static_cast<uint32_t>(view % 3 == 0 ? random() & kCullEverything : kCullEverything);
            expectTwin(pack, *scene, *layout, randomCamera(random, reach),
                       {.width = 64, .height = 48, .error_pixels = error, .flags = flags});
        }
    }
    EXPECT_GT(drawn_, 1000u);
}

TEST_F(CullTest, equalsItsTwinWhereManyBlocksAreScanned)
{
    std::mt19937 random(11);
    TestScene test;
    const uint32_t material = test.addMaterial(plainMaterial());
    const uint32_t mesh = test.addMesh(withMaterial(makeQuad(1, 1), material));
    // one work item each: 300 blocks of the scan, more than one workgroup takes in one step
    for (int i = 0; i < 300 * 1024 + 5; ++i)
        test.addInstance(mesh, translated({uniform(random, -90, 90), uniform(random, -90, 90), 0}));
    const formats::PackView pack = test.build();
    const auto layout = gpu::makeSceneLayout(pack);
    ASSERT_TRUE(layout.ok());
    ASSERT_EQ(layout->items.size(), 300u * 1024 + 5);
    const auto scene = upload(pack);
    shared::Camera camera;
    camera.position = {0, 0, 70};
    expectTwin(pack, *scene, *layout, camera, {.width = 64, .height = 48});
    EXPECT_GT(drawn_, 10000u);
    EXPECT_LT(drawn_, 300u * 1024);
}

TEST_F(CullTest, leavesOutTheLastClustersWhereTheListIsFull)
{
    std::mt19937 random(3);
    TestScene test;
    fillScene(test, random, 20, 3);
    const formats::PackView pack = test.build();
    shared::Camera camera;
    camera.position = {0, 0, 15};
    const auto whole = upload(pack);
    const Picture all = draw(*whole, camera);
    const auto capacity = static_cast<uint32_t>(all.list.slots.size() / 2);
    ASSERT_GT(capacity, 10u);

    const auto small = upload(pack, {.max_visible_clusters = capacity});
    const Picture half = draw(*small, camera);
    EXPECT_EQ(half.list.counters.drawn_clusters, all.list.counters.drawn_clusters);
    EXPECT_EQ(half.list.counters.dropped_clusters, all.list.slots.size() - capacity);
    ASSERT_EQ(half.list.slots.size(), capacity);
    EXPECT_EQ(std::memcmp(half.list.slots.data(), all.list.slots.data(), capacity * sizeof(VisibleCluster)),
              0);
}

TEST_F(CullTest, drawsNothingOfAnEmptyScene)
{
    TestScene test;
    const formats::PackView pack = test.build();
    const auto scene = upload(pack);
    const Picture picture = draw(*scene, {});
    EXPECT_EQ(picture.list.counters.drawn_clusters, 0u);
    for (const uint32_t id : picture.visibility)
        ASSERT_EQ(id, kNothingVisible);
    // the sky: brighter above than below
    EXPECT_GT(channel(picture.at(80, 2), 2), channel(picture.at(80, 117), 2));
}

} // namespace hearth::test
