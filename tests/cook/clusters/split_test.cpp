// Tests the splitting of triangles into clusters: the result of each split does not depend on the search
// method.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/partition/split.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <vector>

namespace
{

using namespace hearth;
using namespace hearth::clusters;

/// Triangles with three own vertices each, so that a cluster's vertices identify them. 85 fill a cluster.
struct Soup
{
    std::vector<SplitItem> items;
    CornerVector<VertexId> corners;
    IdVector<TriangleId, float> errors;

    Soup(size_t count, auto&& center) : corners(count * 3), errors(count, 0)
    {
        for (uint32_t t = 0; t < count; ++t)
            items.push_back({center(t), TriangleId{t}});
        for (const CornerId corner : corners.ids())
            corners[corner] = VertexId{toIndex(corner)};
    }

    /// Return the triangles of each cluster.
    std::vector<std::set<uint32_t>> clusters(std::vector<SplitItem> from) const
    {
        ClusterStore store;
        splitIntoClusters(from, {corners, errors, 0}, store);
        std::vector<std::set<uint32_t>> result;
        for (const ClusterShape& shape : store.shapes)
        {
            result.emplace_back();
            for (const VertexId vertex : store.clusterVertices(shape))
                result.back().insert(toIndex(vertex) / 3);
        }
        return result;
    }
};

Float3 randomCenter(std::mt19937& random, uint32_t steps)
{
    const auto coordinate = [&] { return static_cast<float>(random() % steps); };
    const float x = coordinate(), y = coordinate(), z = coordinate();
    return {x, y, z};
}

TEST(Split, takesTheSameTrianglesInAnyOrder)
{
    // many equal centres: ties are broken by triangle index. The last split is at medians first.
    for (const auto& [count, steps] : {std::pair{300u, 2u}, {1000u, 3u}, {2000u, 1000u}, {9000u, 5u}})
    {
        std::mt19937 random(count);
        const Soup soup(count, [&](uint32_t) { return randomCenter(random, steps); });
        const auto expected = soup.clusters(soup.items);
        size_t triangles = 0;
        for (const auto& cluster : expected)
            triangles += cluster.size();
        EXPECT_EQ(triangles, count);
        std::vector<SplitItem> shuffled = soup.items;
        std::shuffle(shuffled.begin(), shuffled.end(), random);
        EXPECT_EQ(soup.clusters(shuffled), expected) << count << " triangles";
    }
}

TEST(Split, cutsALineWhereASortWould)
{
    // along a line each cluster is a run of the sorted triangles, wherever the bins' borders are
    std::mt19937 random(3);
    std::vector<uint32_t> order(6000);
    std::iota(order.begin(), order.end(), 0u);
    std::shuffle(order.begin(), order.end(), random);
    for (const float power : {1.0f, 8.0f}) // evenly spread, and nearly all in one bin
    {
        const Soup soup(order.size(),
                        [&](uint32_t t)
                        {
                            const float along = static_cast<float>(order[t]) / 6000;
                            return Float3{1, std::pow(along, power), 2};
                        });
        uint32_t next = 0;
        for (const auto& cluster : soup.clusters(soup.items))
        {
            std::vector<uint32_t> places;
            for (const uint32_t triangle : cluster)
                places.push_back(order[triangle]);
            std::sort(places.begin(), places.end());
            for (const uint32_t place : places)
                ASSERT_EQ(place, next++);
        }
        EXPECT_EQ(next, order.size());
    }
}

TEST(Split, filesTheFarthestItemInTheLastBin)
{
    // box sizes for which scaled coordinates round up: an extra bin would be written past the end of the bins
    std::mt19937 random(5);
    for (int round = 0; round < 200; ++round)
    {
        const float side = std::exp(std::uniform_real_distribution<float>(-60, 60)(random));
        const float low = std::uniform_real_distribution<float>(-3, 3)(random) * side;
        const Soup soup(200,
                        [&](uint32_t t) {
                            return t == 77 ? Float3{low + side, low, low} : Float3{low, low + side, low};
                        });
        size_t triangles = 0;
        for (const auto& cluster : soup.clusters(soup.items))
            triangles += cluster.size();
        ASSERT_EQ(triangles, 200u);
    }
}

} // namespace
