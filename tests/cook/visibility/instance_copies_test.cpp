// Tests that instances which see little of the sky have a copy of their mesh in the part, within its bytes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/program/visibility_part.h"
#include "formats/pack/instance_meshes.h"
#include "tests/cook/pages/sample_part.h"

namespace hearth::visibility
{

namespace
{

using namespace formats;
using pages::getMessage;
using pages::open;

// Meshes, and instances of the rock: three in the open, and two in pits.
constexpr uint32_t kRock = 0, kPit = 1;
const std::vector<Float3> kOpenPlaces{{-40, 0, 0}, {-60, 0, 0}, {-80, 0, 0}}, kPits{{0, 0, 0}, {20, 0, 0}};

/// Return a pit: the inside of a sphere, without its cap.
mesh::SourceMesh makePit()
{
    mesh::SourceMesh pit = shapes::rock(24, 0);
    std::vector<uint32_t> inside;
    for (size_t t = 0; t < pit.indices.size(); t += 3)
    {
        const uint32_t a = pit.indices[t], b = pit.indices[t + 1], c = pit.indices[t + 2];
        if (pit.positions[a].y < 0.6f)
            inside.insert(inside.end(), {a, c, b});
    }
    pit.indices = inside;
    pit.triangle_materials.resize(inside.size() / 3);
    for (Float3& position : pit.positions)
        position = position * 3;
    return pit;
}

InstanceRecord makeInstance(uint32_t mesh, Float3 place)
{
    InstanceRecord record{};
    record.mesh = mesh;
    record.scale_max = 1;
    for (int axis = 0; axis < 3; ++axis)
        record.world_from_object.m[axis][3] = place[axis];
    return record;
}

class InstanceCopies : public ::testing::Test
{
protected:
    InstanceCopies()
    {
        std::vector<mesh::SourceMesh> meshes{shapes::rock(24, 0.3f), makePit()};
        for (mesh::SourceMesh& mesh : meshes)
        {
            mesh.normals.clear();
            for (const Float3& position : mesh.positions)
                mesh.normals.push_back(normalizeOr(position, {0, 1, 0}));
        }
        std::vector<InstanceRecord> instances;
        for (const Float3 place : kPits)
        {
            instances.push_back(makeInstance(kPit, place));
            instances.push_back(makeInstance(kRock, place));
        }
        for (const Float3 place : kOpenPlaces)
            instances.push_back(makeInstance(kRock, place));
        auto writer = ContainerWriter::create(import_path, ContainerKind::part);
        EXPECT_TRUE(writer->addRecords<InstanceRecord>(kChunkInstances, instances).ok());
        for (uint32_t i = 0; i < meshes.size(); ++i)
            EXPECT_TRUE(mesh::writeSourceMesh(*writer, i, meshes[i]).ok());
        EXPECT_TRUE(writer->finish().ok());
        EXPECT_EQ(getMessage(clusters::writeClustersPart(open(import_path), clusters_path,
                                                         pages::configureVisibility, {})),
                  "");
    }

    /// Bake the part; return the mesh that each instance draws.
    std::vector<uint32_t> bake(double copies)
    {
        const PackView scene = PackView::read(open(import_path)).value();
        BakeSettings settings;
        settings.copies = copies;
        const auto statistics = writeVisibilityPart(scene, PackView::read(open(clusters_path)).value(), scene,
                                                    {}, baked_path, settings, {});
        EXPECT_TRUE(statistics.ok());
        return readInstanceMeshes(scene, PackView::read(open(baked_path)).value()).value();
    }

    const test::TemporaryFolder folder;
    const std::string import_path = folder.file("import.part"), clusters_path = folder.file("clusters.part"),
                      baked_path = folder.file("baked.part");
};

} // namespace

TEST_F(InstanceCopies, areOfThoseThatSeeLittle)
{
    EXPECT_EQ(bake(16), (std::vector<uint32_t>{kPit, 2, kPit, 2, kRock, kRock, kRock}));
    const PackView part = PackView::read(open(baked_path)).value();
    EXPECT_EQ(getMessage(checkHierarchy(part)), "");
    ASSERT_EQ(part.meshes().size(), 3u) << "rocks in pits are alike";
}

TEST_F(InstanceCopies, takeNoMoreThanTheirBytes)
{
    EXPECT_EQ(bake(0), (std::vector<uint32_t>{kPit, kRock, kPit, kRock, kRock, kRock, kRock}));
    EXPECT_EQ(PackView::read(open(baked_path)).value().container().find(kChunkInstanceMeshes), nullptr);
}

} // namespace hearth::visibility
