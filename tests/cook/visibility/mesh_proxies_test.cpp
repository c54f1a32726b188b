// Tests that visibility is fitted on the proxies of meshes that have one near them, and that proxies occlude
// in their place.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/visibility/program/visibility_part.h"
#include "tests/cook/pages/sample_part.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hearth::visibility
{

namespace
{

using namespace formats;
using pages::getMessage;
using pages::open;

constexpr uint32_t kFloor = 0, kRoof = 1;

/// Height of the roof above the floor; both are squares of this side.
constexpr float kHeight = 1, kSide = 4;

/// Square around the z axis.
struct Square
{
    float side;
    float z;
    bool faces_up;

    Float3 at(Float3 of_unit_square) const
    {
        const float x = (of_unit_square.x - 0.5f) * side, y = (of_unit_square.y - 0.5f) * side;
        return {faces_up ? x : -x, y, z};
    }
};

mesh::SourceMesh makeSheet(uint32_t n, const Square& square)
{
    mesh::SourceMesh sheet = shapes::grid(n);
    std::ranges::for_each(sheet.positions, [&](Float3& position) { position = square.at(position); });
    std::ranges::fill(sheet.normals, Float3{0, 0, square.faces_up ? 1.0f : -1.0f});
    return sheet;
}

/// Proxy of a mesh, as an artist draws it.
struct SquareProxy
{
    uint32_t mesh;
    Square square;
    float mesh_distance = 0;
    bool is_convex = false;
    float distance = 0;
};

/// A floor below a roof.
class ProxiesOfMeshes : public ::testing::Test
{
protected:
    ProxiesOfMeshes()
    {
        const mesh::SourceMesh meshes[] = {makeSheet(32, {kSide, 0, true}),
                                           makeSheet(4, {kSide, kHeight, false})};
        std::vector<InstanceRecord> instances(2);
        for (uint32_t i = 0; i < 2; ++i)
        {
            instances[i].mesh = i;
            instances[i].scale_max = 1;
        }
        auto writer = ContainerWriter::create(import_path, ContainerKind::part);
        EXPECT_TRUE(writer->addRecords<InstanceRecord>(kChunkInstances, instances).ok());
        for (uint32_t i = 0; i < 2; ++i)
            EXPECT_TRUE(mesh::writeSourceMesh(*writer, i, meshes[i]).ok());
        EXPECT_TRUE(writer->finish().ok());
        EXPECT_EQ(getMessage(clusters::writeClustersPart(open(import_path), clusters_path,
                                                         pages::configureVisibility, {})),
                  "");
    }

    /// Write a proxy part. The proxies are sorted by mesh.
    void writeProxies(std::span<const SquareProxy> proxies) const
    {
        std::vector<ProxyRecord> records;
        std::vector<ProxySectionRecord> sections;
        std::vector<Float3> positions;
        std::vector<uint32_t> indices;
        for (const SquareProxy& proxy : proxies)
        {
            const auto count = static_cast<uint32_t>(records.size());
            ProxyRecord& record = records.emplace_back();
            record.mesh = proxy.mesh;
            record.distance = proxy.distance;
            record.mesh_distance = proxy.mesh_distance;
            record.positions = {4 * count, 4};
            record.indices = {6 * count, 6};
            record.sections = {count, 1};
            sections.push_back({{0, 2}, kInvalidIndex, proxy.is_convex ? 1u : 0u});
            for (const Float3 corner : {Float3{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})
                positions.push_back(proxy.square.at(corner));
            indices.insert(indices.end(), {0, 1, 2, 0, 2, 3});
        }
        auto writer = ContainerWriter::create(proxy_path, ContainerKind::part);
        EXPECT_TRUE(writer->addRecords<ProxyRecord>(kChunkProxies, records).ok());
        EXPECT_TRUE(writer->addRecords<ProxySectionRecord>(kChunkProxySections, sections).ok());
        EXPECT_TRUE(writer->addRecords<Float3>(kChunkProxyPositions, positions).ok());
        EXPECT_TRUE(writer->addRecords<uint32_t>(kChunkProxyIndices, indices).ok());
        EXPECT_TRUE(writer->finish().ok());
    }

    Result<std::optional<std::vector<MeshStatistics>>> tryBake(ProxyUse use,
                                                               std::span<const SquareProxy> proxies) const
    {
        writeProxies(proxies);
        BakeSettings settings;
        settings.proxies = use;
        return writeVisibilityPart(PackView::read(open(import_path)).value(),
                                   PackView::read(open(clusters_path)).value(),
                                   PackView::read(open(proxy_path)).value(), {}, baked_path, settings, {});
    }

    /// Bake, and return the use of proxies for the floor and the roof.
    std::vector<ProxyUse> bake(ProxyUse use, std::span<const SquareProxy> proxies)
    {
        const auto statistics = tryBake(use, proxies);
        EXPECT_TRUE(statistics.ok());
        std::vector<ProxyUse> uses;
        if (statistics.ok())
            for (const MeshStatistics& mesh : **statistics)
                uses.push_back(mesh.proxy);
        return uses;
    }

    /// Return the ambient occlusion of the floor's vertices with |x| and |y| below a distance, each with its
    /// position.
    std::vector<std::pair<Float3, float>> readFloor(float distance) const
    {
        const PackView part = PackView::read(open(baked_path)).value();
        const MeshPages pages = MeshPages::read(part, kFloor).value();
        std::vector<std::pair<Float3, float>> seen;
        for (const LevelArrays::Part& drawn : extractLevel(pages, 0).parts)
        {
            const ClusterGeometry geometry = pages.cluster(drawn.cluster);
            for (uint32_t v = 0; v < geometry.vertexCount(); ++v)
                if (const Float3 p = geometry.position(v); std::max(std::abs(p.x), std::abs(p.y)) < distance)
                    seen.emplace_back(p, shared::decodeVisibilityInFrame(geometry.visibilityCode(v)).m1.z /
                                             shared::kVisibilityPi);
        }
        return seen;
    }

    const SquareProxy floor{kFloor, {kSide, 0, true}}, roof{kRoof, {kSide, kHeight, false}};
    const test::TemporaryFolder folder;
    const std::string import_path = folder.file("import.part"), clusters_path = folder.file("clusters.part"),
                      proxy_path = folder.file("proxy.part"), baked_path = folder.file("baked.part");
};

/// Return the ambient occlusion below the middle of a square roof: one less the form factor of a parallel
/// square (J. R. Howell, "A catalog of radiation heat transfer configuration factors", B-4).
double computeOcclusionBelow(double side, double height)
{
    const double x = side / 2 / height, slant = std::sqrt(1 + x * x);
    return 1 - 4 / (2 * std::numbers::pi) * 2 * x / slant * std::atan(x / slant);
}

} // namespace

TEST_F(ProxiesOfMeshes, areFittedOnWhereMeshesHaveOne)
{
    EXPECT_EQ(bake(ProxyUse::none, {&floor, 1}), (std::vector{ProxyUse::none, ProxyUse::none}));
    const auto without = readFloor(kSide);
    EXPECT_EQ(bake(ProxyUse::fit, {&floor, 1}), (std::vector{ProxyUse::fit, ProxyUse::none}));
    const auto with = readFloor(kSide);
    ASSERT_EQ(without.size(), with.size());
    double sum = 0, greatest = 0;
    for (size_t v = 0; v < with.size(); ++v)
    {
        EXPECT_EQ(with[v].first, without[v].first);
        const double difference = double{with[v].second} - double{without[v].second};
        sum += difference * difference;
        greatest = std::max(greatest, std::abs(difference));
    }
    EXPECT_LT(std::sqrt(sum / static_cast<double>(with.size())), 0.01);
    EXPECT_GT(greatest, 0) << "it is another fit";
}

TEST_F(ProxiesOfMeshes, occludeInPlaceOfTheirMeshes)
{
    // the roof's proxy is a quarter of it, but is said to be near
    const float small_side = kSide / 4;
    const SquareProxy proxies[] = {floor, {kRoof, {small_side, kHeight, false}}};
    for (const auto& [use, side] : {std::pair(ProxyUse::fit, kSide), std::pair(ProxyUse::all, small_side)})
    {
        EXPECT_EQ(bake(use, proxies), (std::vector{use, use}));
        const auto below = readFloor(0.01f);
        ASSERT_FALSE(below.empty());
        for (const auto& [position, occlusion] : below)
            EXPECT_NEAR(occlusion, computeOcclusionBelow(double{side}, double{kHeight}), 0.01) << side;
    }
}

TEST_F(ProxiesOfMeshes, areLeftOutIfTheyAreConvexOrFarAway)
{
    const SquareProxy convex{kFloor, floor.square, 0, true}, far{kRoof, roof.square, kSide / 2, false};
    const SquareProxy proxies[] = {convex, far};
    EXPECT_EQ(bake(ProxyUse::all, proxies), (std::vector{ProxyUse::none, ProxyUse::none}));
    // one that reaches beyond its mesh, by far
    const SquareProxy large{kFloor, {1e30f, 0, true}, 0, false, 1e30f};
    EXPECT_EQ(bake(ProxyUse::all, {&large, 1}), (std::vector{ProxyUse::none, ProxyUse::none}));
    // if it does not say so, it is used, and takes no longer
    const SquareProxy lying{kFloor, {1e30f, 0, true}};
    EXPECT_EQ(bake(ProxyUse::fit, {&lying, 1}), (std::vector{ProxyUse::fit, ProxyUse::none}));
    // the second one of a mesh may do
    const SquareProxy two[] = {convex, floor, far};
    EXPECT_EQ(bake(ProxyUse::all, two), (std::vector{ProxyUse::all, ProxyUse::none}));
}

TEST_F(ProxiesOfMeshes, ofAnotherSourceAreAnError)
{
    const SquareProxy other{7, floor.square};
    const auto baked = tryBake(ProxyUse::fit, {&other, 1});
    ASSERT_FALSE(baked.ok());
    EXPECT_EQ(baked.error().issue, Issue::meaning_reference);
}

} // namespace hearth::visibility
