// Tests that cuts keep the boundary of their source: its loops, and no others. The scene has a terrain with
// holes, closed pebbles on it and open leaves above it, so that islands vanish and grow while others stay.
//
// Promise: each component of the source is in a cut with as many boundary loops as it has in the source, or
// it is not there at all. A closed component is closed. A component that is not there is within the cut's
// error of what is. Not promised: that sheets never touch. Two groups may each make an edge between the same
// two positions of their common border, where four triangles then meet; nothing is open there.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/pack_view.h"
#include "tests/support/cuts.h"
#include "tests/support/shapes.h"
#include "tests/support/surfaces/surface_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace
{

using namespace hearth;
using mesh::SourceMesh;

constexpr uint32_t kTerrainSide = 64;

/// Append a component whose number is in the UVs of all its vertices.
void addComponent(SourceMesh& scene, SourceMesh component, uint32_t number)
{
    component.uvs[0].assign(component.vertexCount(), {static_cast<float>(number), 0});
    scene.face_count += component.face_count;
    if (number == 0)
        scene = std::move(component);
    else
        shapes::append(scene, component);
}

/// Remove the quads of the terrain around some places: each time four, inside the rim.
void cutHoles(SourceMesh& terrain)
{
    std::vector<uint32_t> kept;
    for (size_t t = 0; t < terrain.indices.size(); t += 3)
    {
        const size_t quad = t / 6, i = quad % kTerrainSide, j = quad / kTerrainSide;
        if (i % 20 < 18 || j % 20 < 18 || i > 60 || j > 60)
            kept.insert(kept.end(), {terrain.indices[t], terrain.indices[t + 1], terrain.indices[t + 2]});
    }
    terrain.indices = std::move(kept);
    terrain.triangle_materials.resize(terrain.triangleCount());
}

void place(SourceMesh& mesh, float size, Float3 center)
{
    for (Float3& position : mesh.positions)
        position = position * size + center;
}

/// Quad of two triangles in a plane of its own.
SourceMesh makeLeaf(float turn)
{
    SourceMesh leaf = shapes::grid(1);
    for (Float3& p : leaf.positions)
        p = {p.x * std::cos(turn) - p.y * std::sin(turn), p.y * std::cos(turn) + p.x * std::sin(turn), p.x};
    return leaf;
}

/// Terrain, 240 pebbles of 12 and 48 triangles, and 120 leaves.
SourceMesh makeScene()
{
    SourceMesh scene = shapes::terrain(kTerrainSide);
    const std::vector<Float3> ground = scene.positions;
    cutHoles(scene);
    addComponent(scene, SourceMesh(scene), 0);
    std::mt19937 random(23);
    for (uint32_t number = 1; number <= 360; ++number)
    {
        const float size = 0.004f + 0.00004f * static_cast<float>(random() % 100);
        const Float3 center = ground[random() % ground.size()] + Float3{0, 2.5f * size, 0};
        SourceMesh component =
            number % 3 == 0 ? makeLeaf(static_cast<float>(number)) : shapes::rock(number % 3, 0.3f, number);
        place(component, size, center);
        addComponent(scene, std::move(component), number);
    }
    return scene;
}

/// Triangles of a cut, apart by the component that they come from.
using Components = std::map<uint32_t, std::vector<uint32_t>>;

class BoundaryOfScene : public testing::Test
{
protected:
    static void SetUpTestSuite()
    {
        scene_ = makeScene();
        hierarchy_ = clusters::buildHierarchy(scene_);
        auto decoded = clusters::decodeHierarchy(hierarchy_);
        ASSERT_TRUE(decoded.ok());
        decoded_ = std::move(*decoded);
    }

    /// Return the component of each of a cluster's triangles. No triangle may be of two.
    static std::vector<uint32_t> componentsOfCluster(uint32_t c)
    {
        const formats::ClusterRecord& cluster = hierarchy_.clusters[c];
        const auto geometry =
            formats::ClusterGeometry::at(decoded_.pages[cluster.page], cluster, hierarchy_.mesh);
        std::vector<uint32_t> components;
        for (uint32_t t = 0; t < geometry->triangleCount(); ++t)
        {
            std::set<uint32_t> numbers;
            for (const uint32_t corner : geometry->triangle(t))
                numbers.insert(static_cast<uint32_t>(std::lround(geometry->uv(corner, 0).x)));
            EXPECT_EQ(numbers.size(), 1u) << "a triangle joins two components";
            components.push_back(*numbers.begin());
        }
        return components;
    }

    static Components takeApart(const std::vector<uint8_t>& replaced)
    {
        Components components;
        for (const uint32_t c : clusters::findCutClusters(hierarchy_, replaced))
        {
            const std::vector<uint32_t> numbers = componentsOfCluster(c);
            const auto& positions = decoded_.clusters[c].positions;
            for (size_t t = 0; t < numbers.size(); ++t)
                components[numbers[t]].insert(components[numbers[t]].end(), &positions[t * 3],
                                              &positions[t * 3] + 3);
        }
        return components;
    }

    static double errorOfCut(const std::vector<uint8_t>& replaced)
    {
        double error = 0;
        for (const uint32_t c : clusters::findCutClusters(hierarchy_, replaced))
            error = std::max(error, double{formats::clusterError(hierarchy_.clusters[c], hierarchy_.groups)});
        return error;
    }

    /// All levels, and random cuts.
    static std::vector<std::vector<uint8_t>> chooseCuts()
    {
        std::vector<std::vector<uint8_t>> chosen;
        for (const auto& level : hierarchy_.levels)
            chosen.push_back(cuts::cutAtError(hierarchy_, double{level.max_error}));
        std::mt19937 random(5);
        for (int i = 0; i < 6; ++i)
            chosen.push_back(cuts::randomCut(hierarchy_, 0.5 + 0.09 * i, random));
        return chosen;
    }

    static inline SourceMesh scene_;
    static inline clusters::Hierarchy hierarchy_;
    static inline clusters::DecodedHierarchy decoded_;
};

TEST_F(BoundaryOfScene, hasTheLoopsOfEachComponentOrTheComponentIsGone)
{
    const Components source = takeApart(std::vector<uint8_t>(hierarchy_.groups.size(), 0));
    ASSERT_EQ(source.size(), 361u);
    std::map<uint32_t, Boundary> boundaries;
    size_t closed = 0, open = 0;
    for (const auto& [number, triangles] : source)
    {
        boundaries[number] = findBoundary(triangles);
        EXPECT_TRUE(boundaries[number].complex_edges.empty());
        ++(boundaries[number].loops.empty() ? closed : open);
    }
    EXPECT_EQ(boundaries[0].loops.size(), 1u + 9) << "the terrain's rim and holes";
    EXPECT_EQ(closed, 240u);
    EXPECT_EQ(open, 121u);

    size_t gone = 0, left = 0;
    for (const std::vector<uint8_t>& cut : chooseCuts())
    {
        const Components components = takeApart(cut);
        std::vector<uint32_t> all;
        for (const auto& [number, triangles] : components)
        {
            all.insert(all.end(), triangles.begin(), triangles.end());
            const Boundary boundary = findBoundary(triangles);
            EXPECT_EQ(boundary.loops.size(), boundaries[number].loops.size()) << "component " << number;
            EXPECT_TRUE(boundary.other_open_edges.empty()) << "component " << number;
        }
        const SurfaceDistance to_cut(decoded_.positions, all);
        const double error = errorOfCut(cut);
        for (const auto& [number, triangles] : source)
        {
            ++(components.contains(number) ? left : gone);
            if (!components.contains(number))
                for (const uint32_t position : triangles)
                    EXPECT_LE(to_cut.to(decoded_.positions[position]), error * 1.0001) << number;
        }
    }
    EXPECT_GT(gone, 300u) << "or the test sees no component vanish";
    EXPECT_GT(left, 300u);
}

TEST_F(BoundaryOfScene, isTheSourcesAtEveryCut)
{
    const Boundary source = cuts::findSourceBoundary(hierarchy_, decoded_);
    EXPECT_EQ(source.loops.size(), 10u + 120);
    for (const std::vector<uint8_t>& cut : chooseCuts())
    {
        const Boundary boundary = findBoundary(cuts::trianglesOfCut(hierarchy_, decoded_, cut));
        EXPECT_EQ(findCrack(source, boundary), "");
        EXPECT_LE(boundary.loops.size(), source.loops.size());
    }
}

/// True if findCrack sees a change of a cut.
template <typename Change>
bool seesCrack(const Boundary& source, std::vector<uint32_t> triangles, Change change)
{
    change(triangles);
    return !findCrack(source, findBoundary(triangles)).empty();
}

TEST_F(BoundaryOfScene, showsAPlantedCrackInAnyComponent)
{
    const Boundary source = cuts::findSourceBoundary(hierarchy_, decoded_);
    std::set<uint32_t> on_boundary;
    for (const BoundaryLoop& loop : source.loops)
        on_boundary.insert(loop.positions.begin(), loop.positions.end());
    // all leaves are there still, and some pebbles lost triangles
    const auto fine = cuts::cutAtError(hierarchy_, 0.0005);
    const Components components = takeApart(fine);
    std::vector<uint32_t> all;
    for (const auto& [number, triangles] : components)
        all.insert(all.end(), triangles.begin(), triangles.end());
    EXPECT_EQ(findCrack(source, findBoundary(all)), "");
    const auto fresh = static_cast<uint32_t>(decoded_.positions.size());
    size_t first = 0, planted = 0;
    for (const auto& [number, triangles] : components)
    {
        const size_t step = number == 0 ? triangles.size() / 3 / 40 * 3 : triangles.size();
        for (size_t t = number == 0 ? 0 : triangles.size() - 3; t < triangles.size(); t += step)
        {
            // a triangle with two edges on the boundary may go like a collapsed one; leaves have no other
            const auto ends = std::count_if(&triangles[t], &triangles[t] + 3,
                                            [&](uint32_t p) { return on_boundary.contains(p); });
            if (ends == 3 || (number != 0 && number % 12 != 1 && number % 12 != 2))
                continue;
            ++planted;
            EXPECT_TRUE(seesCrack(source, all,
                                  [&](std::vector<uint32_t>& changed)
                                  {
                                      changed.erase(changed.begin() + static_cast<ptrdiff_t>(first + t),
                                                    changed.begin() + static_cast<ptrdiff_t>(first + t + 3));
                                  }))
                << "a triangle of component " << number << " is missing";
            EXPECT_TRUE(seesCrack(source, all,
                                  [&](std::vector<uint32_t>& changed) { changed[first + t + 1] = fresh; }))
                << "a corner of component " << number << " has moved";
        }
        first += triangles.size();
    }
    EXPECT_GT(planted, 60u);
}

TEST(Boundary, countsLoopsOfKnownSurfaces)
{
    const std::vector<uint32_t> closed{0, 1, 2, 0, 3, 1, 1, 3, 2, 2, 3, 0};
    EXPECT_TRUE(findBoundary(closed).loops.empty());
    const std::vector<uint32_t> open(closed.begin(), closed.end() - 3);
    ASSERT_EQ(findBoundary(open).loops.size(), 1u);
    EXPECT_EQ(findBoundary(open).loops[0].positions.size(), 3u);
    const std::vector<uint32_t> touching{0, 1, 2, 0, 3, 4};
    EXPECT_EQ(findBoundary(touching).loops.size(), 2u) << "sheets that touch at a position are apart";
    const std::vector<uint32_t> fin{0, 1, 2, 1, 0, 3, 0, 1, 4};
    EXPECT_EQ(findBoundary(fin).complex_edges.size(), 1u);
    EXPECT_TRUE(findBoundary(fin).loops.empty());
    EXPECT_EQ(findBoundary(fin).other_open_edges.size(), 7u)
        << "its six edges, and the complex one: three triangles";
    const std::vector<uint32_t> same_way{0, 1, 2, 0, 1, 3};
    EXPECT_EQ(findBoundary(same_way).complex_edges.size(), 1u) << "OpenMesh refuses the second triangle";
    for (const auto& triangles : {closed, open, touching, fin, same_way})
        EXPECT_EQ(findBoundary(triangles).refused_triangles, 0u);
}

TEST(Boundary, ofASimplifiedLoopFollowsTheSources)
{
    const std::vector<uint32_t> source{0, 1, 9, 1, 2, 9, 2, 3, 9, 3, 4, 9, 4, 0, 9};
    const Boundary boundary = findBoundary(source);
    EXPECT_EQ(findCrack(boundary, findBoundary(std::vector<uint32_t>{0, 2, 9, 2, 4, 9, 4, 0, 9})), "");
    EXPECT_EQ(findCrack(boundary, findBoundary(std::vector<uint32_t>{0, 2, 4})), "");
    EXPECT_NE(findCrack(boundary, findBoundary(std::vector<uint32_t>{0, 4, 2})), "") << "the other way round";
    EXPECT_NE(findCrack(boundary, findBoundary(std::vector<uint32_t>{0, 1, 2, 2, 3, 4})), "") << "in two";
    EXPECT_NE(findCrack(boundary, findBoundary(std::vector<uint32_t>{0, 2, 9, 2, 4, 9})), "")
        << "not on the loop";
}

} // namespace
