// Tests the check of convex parts, and the order of triangles and positions in the tables of proxies.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/proxy/surface/convex.h"
#include "cook/proxy/surface/proxy_tables.h"
#include "formats/base/index.h"
#include "tests/cook/proxy/surfaces.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace hearth::proxy::test
{

namespace
{

/// Sphere of radius 1 of rings and sectors, with one vertex at each pole.
Surface makeGlobe(uint32_t rings, uint32_t sectors)
{
    Surface globe;
    globe.positions.push_back({0, 0, 1});
    for (uint32_t ring = 1; ring < rings; ++ring)
        for (uint32_t sector = 0; sector < sectors; ++sector)
        {
            const double polar = std::numbers::pi * ring / rings;
            const double turn = 2 * std::numbers::pi * sector / sectors;
            globe.positions.push_back({static_cast<float>(std::sin(polar) * std::cos(turn)),
                                       static_cast<float>(std::sin(polar) * std::sin(turn)),
                                       static_cast<float>(std::cos(polar))});
        }
    globe.positions.push_back({0, 0, -1});
    const auto at = [&](uint32_t ring, uint32_t sector)
    { return 1 + (ring - 1) * sectors + sector % sectors; };
    const uint32_t south = 1 + (rings - 1) * sectors;
    for (uint32_t sector = 0; sector < sectors; ++sector)
    {
        globe.add({0, at(1, sector), at(1, sector + 1)}, 0);
        for (uint32_t ring = 1; ring + 1 < rings; ++ring)
        {
            globe.add({at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1)}, 0);
            globe.add({at(ring, sector), at(ring + 1, sector + 1), at(ring, sector + 1)}, 0);
        }
        globe.add({at(rings - 1, sector), south, at(rings - 1, sector + 1)}, 0);
    }
    return globe;
}

} // namespace

TEST(ConvexParts, areSolidsBehindThePlanesOfTheirTriangles)
{
    Surface globe = makeGlobe(16, 24);
    EXPECT_EQ(findConvexFault(globe), ConvexFault::none);
    Surface turned = globe;
    for (size_t t = 0; t < turned.triangleCount(); ++t)
        hearth::test::turn(turned, t);
    EXPECT_EQ(findConvexFault(turned), ConvexFault::inside_out);
    Surface open = globe;
    open.indices.resize(open.indices.size() - 3);
    open.materials.pop_back();
    EXPECT_EQ(findConvexFault(open), ConvexFault::open);
    globe.positions.front().z = 0.9f;
    EXPECT_EQ(findConvexFault(globe), ConvexFault::dented);
}

TEST(ConvexParts, haveAVolume)
{
    const Surface sheet{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2, 0, 2, 1}, {0, 0}};
    EXPECT_EQ(findConvexFault(sheet), ConvexFault::inside_out);
}

TEST(ConvexParts, areOneSolid)
{
    // two globes beside each other: each is convex, both together are not
    Surface two = makeGlobe(6, 8);
    Surface other = two;
    for (Float3& position : other.positions)
        position.x += 4;
    hearth::test::append(two, other);
    EXPECT_EQ(findConvexFault(two), ConvexFault::dented);
}

TEST(ConvexParts, haveThousandsOfPositionsAtMost)
{
    EXPECT_EQ(findConvexFault(makeGlobe(64, 128)), ConvexFault::none) << "8066 positions";
    EXPECT_EQ(findConvexFault(makeGlobe(66, 128)), ConvexFault::too_large) << "8322 positions";
}

TEST(ProxyTables, trianglesAreSortedByMaterialAndPositionsByUse)
{
    Surface surface{{{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}, {}};
    surface.add({4, 3, 2}, kInvalidIndex);
    surface.add({1, 2, 3}, 1);
    surface.add({2, 4, 3}, 0);
    sortByMaterial(surface);
    EXPECT_EQ(surface.materials, (std::vector<uint32_t>{0, 1, kInvalidIndex}));
    EXPECT_EQ(surface.indices, (std::vector<uint32_t>{0, 1, 2, 3, 0, 2, 1, 2, 0}));
    ASSERT_EQ(surface.positions.size(), 4u) << "no triangle has the first";
    EXPECT_EQ(surface.positions[0], (Float3{1, 0, 0}));
    EXPECT_EQ(surface.positions[3], (Float3{0, 0, 0}));
    const Surface once = surface;
    sortByMaterial(surface);
    EXPECT_EQ(surface.indices, once.indices);
    EXPECT_EQ(surface.positions, once.positions);
    EXPECT_EQ(makeMaterialSections(surface).size(), 3u);
}

} // namespace hearth::proxy::test
