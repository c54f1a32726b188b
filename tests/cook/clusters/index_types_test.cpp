// Tests that index types do not mix, and that arrays and ranges of indices count as they should.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/index_types.h"

#include <gtest/gtest.h>

#include <concepts>
#include <span>
#include <vector>

namespace
{

using namespace hearth::clusters;

template <typename Array, typename Index>
concept Indexes = requires(const Array& array, Index index) { array[index]; };

template <typename A, typename B>
concept Compares = requires(A a, B b) { a == b; };

using PositionsOfWedges = IdVector<WedgeId, PositionId>;

// a wedge finds its position; a position, a vertex and a number find nothing
static_assert(Indexes<PositionsOfWedges, WedgeId>);
static_assert(!Indexes<PositionsOfWedges, PositionId>);
static_assert(!Indexes<PositionsOfWedges, VertexId>);
static_assert(!Indexes<PositionsOfWedges, uint32_t>);
static_assert(!Indexes<PositionsOfWedges, size_t>);
static_assert(!Indexes<IdSpan<WedgeId, const PositionId>, PositionId>);
static_assert(!Compares<WedgeId, PositionId>);
static_assert(!Compares<WedgeId, uint32_t>);
static_assert(!std::convertible_to<uint32_t, WedgeId>);
static_assert(!std::convertible_to<PositionsOfWedges, IdSpan<PositionId, const PositionId>>);
static_assert(!std::convertible_to<std::span<const PositionId>, IdSpan<WedgeId, const PositionId>>);
static_assert(!std::convertible_to<IdSpan<WedgeId, const PositionId>, IdSpan<WedgeId, PositionId>>);
static_assert(!std::constructible_from<IdSpan<WedgeId, PositionId>, const PositionsOfWedges&>);

// they cost what a number costs
static_assert(sizeof(WedgeId) == sizeof(uint32_t));
static_assert(sizeof(PositionsOfWedges) == sizeof(std::vector<PositionId>));
static_assert(sizeof(IdSpan<WedgeId, const PositionId>) == sizeof(std::span<const PositionId>));

TEST(InvalidIndex, isNoneOfEachType)
{
    const WedgeId wedge = kInvalid;
    EXPECT_TRUE(wedge == kInvalid);
    EXPECT_TRUE(WedgeId{0} != kInvalid);
    EXPECT_EQ(toIndex(wedge), hearth::kInvalidIndex);
    EXPECT_GT(wedge, WedgeId{0xFFFFFFFE}) << "it is behind all others";
}

TEST(IdVector, takesItsIndicesInOrder)
{
    IdVector<WedgeId, int> values;
    EXPECT_EQ(values.nextId(), WedgeId{0});
    values.push_back(5);
    values.push_back(6);
    EXPECT_EQ(values.nextId(), WedgeId{2});
    EXPECT_TRUE(values.contains(WedgeId{1}));
    EXPECT_FALSE(values.contains(WedgeId{2}));
    EXPECT_FALSE(values.contains(kInvalid));
    std::vector<int> seen;
    for (const WedgeId wedge : values.ids())
        seen.push_back(values[wedge]);
    EXPECT_EQ(seen, values.values());
    const IdSpan<WedgeId, int> view = values;
    view[WedgeId{1}] = 7;
    EXPECT_EQ(values[WedgeId{1}], 7);
}

TEST(Corners, belongToTheirTriangles)
{
    const CornerVector<int> values(std::vector<int>{10, 11, 12, 20, 21, 22});
    EXPECT_EQ(values.triangleCount(), 2u);
    EXPECT_EQ(values.triangle(TriangleId{1}), (std::array{20, 21, 22}));
    uint32_t k = 0;
    for (const CornerId corner : makeCorners(TriangleId{1}))
    {
        EXPECT_EQ(cornerTriangle(corner), TriangleId{1});
        EXPECT_EQ(cornerNumber(corner), k);
        EXPECT_EQ(corner, makeCorner(TriangleId{1}, k));
        EXPECT_EQ(nextHalfEdge(corner), makeCorner(TriangleId{1}, (k + 1) % 3));
        EXPECT_EQ(previousHalfEdge(nextHalfEdge(corner)), corner);
        ++k;
    }
    EXPECT_EQ(k, 3u);
}

} // namespace
