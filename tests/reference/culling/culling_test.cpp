// Tests the C++ twin of the shaders' culling decisions against the independent oracle, over random clusters,
// transforms and cameras.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/culling/cpu_culling.h"
#include "tests/reference/culling/culling_oracle.h"

#include "formats/container/container_writer.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

namespace hearth::reference
{
namespace
{

using namespace formats;

constexpr float kGridStep = 1.0f / 4096;

class Random
{
public:
    explicit Random(uint32_t seed) : engine_(seed) {}
    float in(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
    bool chance(float probability) { return in(0, 1) < probability; }
    Float3 point(float reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }
    Float3 direction() { return normalizeOr(point(1), {0, 1, 0}); }

private:
    std::mt19937 engine_;
};

/// Tables of a pack without geometry: clusters of one mesh in pairs of groups, instances of all kinds.
struct Tables
{
    std::vector<InstanceRecord> instances;
    std::vector<MeshRecord> meshes;
    std::vector<GroupRecord> groups;
    std::vector<ClusterRecord> clusters;
    std::vector<MaterialRecord> materials;
};

Affine3 randomTransform(Random& random)
{
    Affine3 transform;
    for (auto& row : transform.m)
        for (int column = 0; column < 3; ++column)
            row[column] = random.in(-1.5f, 1.5f); // sheared, and mirrored half of the time
    for (int row = 0; row < 3; ++row)
        transform.m[row][3] = random.in(-12, 12);
    return transform;
}

Tables randomTables(uint32_t seed)
{
    Random random(seed);
    Tables tables;
    tables.materials.resize(2);
    tables.materials[1].flags = kMaterialDoubleSided;
    for (uint32_t c = 0; c < 64; ++c)
    {
        GroupRecord fine{};
        fine.sphere_center = random.point(2);
        fine.sphere_radius = random.in(0.1f, 1);
        fine.error = random.in(0, 0.05f);
        GroupRecord coarse = fine;
        coarse.sphere_radius += random.in(0, 1);
        coarse.error =
            random.chance(0.1f) ? std::numeric_limits<float>::infinity() : fine.error + random.in(0, 0.1f);
        tables.groups.push_back(coarse);
        tables.groups.push_back(fine);

        ClusterRecord cluster{};
        const Float3 half{random.in(0, 0.5f), random.in(0, 0.5f), random.in(0, 0.5f)};
        cluster.extent_shift = random.chance(0.2f) ? 1 : 0;
        for (int axis = 0; axis < 3; ++axis)
        {
            cluster.base[axis] = static_cast<int32_t>((fine.sphere_center[axis] - half[axis]) / kGridStep);
            cluster.extent[axis] = static_cast<uint16_t>(2 * half[axis] / kGridStep);
        }
        cluster.cone_axis = static_cast<uint16_t>(NormalCode<8>::encode(random.direction()));
        cluster.cone_cutoff =
            random.chance(0.3f) ? kNoCone : static_cast<uint16_t>(random.in(0.02f, 0.9f) * 65536);
        cluster.cone_back = static_cast<uint16_t>(random.in(0, 1) / kGridStep / kConeBackSteps);
        cluster.group = 2 * c;
        cluster.refined_group = random.chance(0.5f) ? 2 * c + 1 : kInvalidIndex;
        cluster.material = random.chance(0.2f) ? 1 : random.chance(0.5f) ? 0 : kInvalidIndex;
        tables.clusters.push_back(cluster);
    }
    MeshRecord mesh{};
    mesh.clusters = {0, 64};
    mesh.grid_step = kGridStep;
    tables.meshes.push_back(mesh);
    for (int i = 0; i < 40; ++i)
    {
        InstanceRecord instance{};
        instance.world_from_object = randomTransform(random);
        instance.scale_max = static_cast<float>(largestStretch(instance.world_from_object) * 1.00001);
        instance.flags = determinant(instance.world_from_object) < 0 ? kInstanceMirrored : 0u;
        tables.instances.push_back(instance);
    }
    return tables;
}

PackView makePackView(const Tables& tables, const std::string& path)
{
    ContainerWriter writer = ContainerWriter::create(path, ContainerKind::part).value();
    EXPECT_TRUE(writer.addRecords<InstanceRecord>(kChunkInstances, tables.instances).ok());
    EXPECT_TRUE(writer.addRecords<MeshRecord>(kChunkMeshes, tables.meshes).ok());
    EXPECT_TRUE(writer.addRecords<GroupRecord>(kChunkGroups, tables.groups).ok());
    EXPECT_TRUE(writer.addRecords<ClusterRecord>(kChunkClusters, tables.clusters).ok());
    EXPECT_TRUE(writer.addRecords<MaterialRecord>(kChunkMaterials, tables.materials).ok());
    EXPECT_TRUE(writer.finish().ok());
    PackView view = PackView::read(ContainerReader::open(path).value()).value();
    std::remove(path.c_str());
    return view;
}

OracleView randomView(Random& random, uint32_t flags)
{
    OracleView view;
    view.camera.position = random.point(10);
    view.camera.target = view.camera.position + random.direction() * random.in(0.5f, 5);
    view.camera.y_fov_rad = random.in(0.2f, 2.2f);
    view.camera.z_near = random.in(0.01f, 1);
    view.width = static_cast<uint32_t>(random.in(1, 2000));
    view.height = static_cast<uint32_t>(random.in(1, 2000));
    view.error_pixels = random.chance(0.2f) ? 0 : random.in(0.05f, 20);
    view.flags = flags;
    return view;
}

std::vector<DrawnCluster> cull(const PackView& pack, const OracleView& view)
{
    return cullExhaustively(
        pack, shared::makeFrameView(view.camera, view.width, view.height, view.error_pixels,
                                    static_cast<uint32_t>(pack.instances().size()), view.flags));
}

TEST(CullExhaustively, agreesWithTheOracleForAnyTransformAndCamera)
{
    const PackView pack = makePackView(randomTables(1), testing::TempDir() + "reference_tables.part");
    Random random(2);
    CullingComparison sum;
    for (const uint32_t flags : {0u, uint32_t{shared::kCullInstances}, uint32_t{shared::kCullFrustum},
                                 uint32_t{shared::kCullCone}, uint32_t{shared::kCullEverything}})
        for (int i = 0; i < 40; ++i)
        {
            const OracleView view = randomView(random, flags);
            const CullingComparison one = compareWithOracle(pack, view, cull(pack, view));
            EXPECT_EQ(one.wrongly_drawn, 0u) << "flags " << flags << " view " << i;
            EXPECT_EQ(one.wrongly_culled, 0u) << "flags " << flags << " view " << i;
            sum.pairs += one.pairs;
            sum.drawn += one.drawn;
            sum.either += one.either;
            sum.outside_frustum += one.outside_frustum;
            sum.facing_away += one.facing_away;
        }
    // The test is meaningful only if each reason decided often, and both answers are seldom right.
    EXPECT_GT(sum.drawn, 5000u);
    EXPECT_GT(sum.outside_frustum, 5000u);
    EXPECT_GT(sum.facing_away, 1000u);
    EXPECT_LT(sum.either, sum.pairs / 50);
    std::printf("%llu pairs, %llu drawn, %llu outside, %llu facing away, %llu either way\n",
                static_cast<unsigned long long>(sum.pairs), static_cast<unsigned long long>(sum.drawn),
                static_cast<unsigned long long>(sum.outside_frustum),
                static_cast<unsigned long long>(sum.facing_away),
                static_cast<unsigned long long>(sum.either));
}

TEST(CullingOracle, noticesAWrongDecision)
{
    const PackView pack = makePackView(randomTables(3), testing::TempDir() + "reference_tables_wrong.part");
    OracleView view;
    view.camera = {.position = {0, 0, 14}, .target = {0, 0, 0}, .y_fov_rad = 1.2f, .z_near = 0.1f};
    view.width = view.height = 512;
    std::vector<DrawnCluster> drawn = cull(pack, view);
    ASSERT_GT(drawn.size(), 100u);
    ASSERT_EQ(judgeCluster(pack, view, drawn[5]).drawn(), Answer::yes);
    drawn.erase(drawn.begin() + 5);
    EXPECT_EQ(compareWithOracle(pack, view, drawn).wrongly_culled, 1u);

    OracleView other = view;
    other.flags = 0;
    EXPECT_GT(compareWithOracle(pack, view, cull(pack, other)).wrongly_drawn, 10u);
}

TEST(LargestStretch, isTheLargestSingularValue)
{
    Affine3 scale;
    scale.m[0][0] = 2;
    scale.m[1][1] = -5;
    scale.m[2][2] = 0.5f;
    EXPECT_NEAR(largestStretch(scale), 5, 1e-9);
    // a shear by k has the singular value k/2 + sqrt(1 + k^2/4)
    Affine3 shear;
    shear.m[0][1] = 3;
    EXPECT_NEAR(largestStretch(shear), 1.5 + std::sqrt(1 + 2.25), 1e-6);
}

} // namespace
} // namespace hearth::reference
