// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/reference/culling/cut_checker.h"

#include "tests/reference/double3.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

namespace hearth::reference
{

using namespace formats;

namespace
{

/// Minimum and maximum number of drawn clusters on a path to the root.
struct WayCount
{
    uint32_t least = 0;
    uint32_t most = 0;
};

} // namespace

CoverageReport checkCoverage(const PackView& view, uint32_t mesh, std::span<const uint32_t> cut)
{
    const Range clusters = view.meshes()[mesh].clusters;
    std::vector<bool> drawn(clusters.count, false);
    for (const uint32_t cluster : cut)
        drawn[cluster - clusters.first] = true;

    // The table is ordered from coarse to fine: the simplified clusters of a group precede the clusters of
    // the group.
    std::map<uint32_t, WayCount> above_group; // over the clusters that the group was simplified to
    std::vector<WayCount> ways(clusters.count);
    CoverageReport report;
    for (uint32_t i = 0; i < clusters.count; ++i)
    {
        const ClusterRecord& cluster = view.clusters()[clusters.first + i];
        const auto above = above_group.find(cluster.group - view.groups()[cluster.group].set_offset);
        ways[i] = above == above_group.end() ? WayCount{} : above->second;
        ways[i].least += drawn[i];
        ways[i].most += drawn[i];
        if (cluster.refined_group != kInvalidIndex)
        {
            const auto [entry, first] = above_group.try_emplace(cluster.refined_group, ways[i]);
            if (!first)
                entry->second = {std::min(entry->second.least, ways[i].least),
                                 std::max(entry->second.most, ways[i].most)};
        }
        if (cluster.level == 0)
        {
            ++report.source_clusters;
            report.missing += ways[i].least == 0;
            report.overlapping += ways[i].most > 1;
        }
    }
    return report;
}

namespace
{

using PointKey = std::tuple<float, float, float>;
using EdgeKey = std::pair<PointKey, PointKey>;

/// Key of a position; -0 and 0 are equal.
PointKey makeKey(Float3 p)
{
    return {p.x + 0.0f, p.y + 0.0f, p.z + 0.0f};
}

/// Count, for each edge, its uses from the smaller to the greater end minus the uses in the opposite
/// direction.
std::map<EdgeKey, int> countEdges(const Triangles& triangles)
{
    std::map<EdgeKey, int> balance;
    for (const auto& t : triangles)
        for (size_t i = 0; i < 3; ++i)
        {
            const PointKey a = makeKey(t[i]), b = makeKey(t[(i + 1) % 3]);
            if (a == b)
                continue;
            if (a < b)
                ++balance[{a, b}];
            else
                --balance[{b, a}];
        }
    return balance;
}

Double3 toPoint(const PointKey& key)
{
    return Double3(Float3{std::get<0>(key), std::get<1>(key), std::get<2>(key)});
}

double distanceToSegment(Double3 p, Double3 a, Double3 b)
{
    const Double3 edge = b - a;
    const double t = std::clamp(dot(p - a, edge) / dot(edge, edge), 0.0, 1.0);
    return length(p - a - edge * t);
}

double distanceToEdges(Double3 p, const std::vector<EdgeKey>& edges)
{
    double nearest = std::numeric_limits<double>::infinity();
    for (const EdgeKey& edge : edges)
        nearest = std::min(nearest, distanceToSegment(p, toPoint(edge.first), toPoint(edge.second)));
    return nearest;
}

std::vector<EdgeKey> openEdges(const std::map<EdgeKey, int>& balance)
{
    std::vector<EdgeKey> open;
    for (const auto& [edge, uses] : balance)
        if (uses != 0)
            open.push_back(edge);
    return open;
}

} // namespace

EdgeReport checkEdges(const Triangles& cut, const Triangles& source, double tolerance)
{
    const std::map<EdgeKey, int> cut_balance = countEdges(cut), source_balance = countEdges(source);
    const std::vector<EdgeKey> source_open = openEdges(source_balance);
    EdgeReport report;
    report.edges = cut_balance.size();
    for (const EdgeKey& edge : openEdges(cut_balance))
    {
        ++report.open_edges;
        const auto in_source = source_balance.find(edge);
        if (in_source != source_balance.end() && in_source->second != 0)
            continue;
        const double distance = std::max(distanceToEdges(toPoint(edge.first), source_open),
                                         distanceToEdges(toPoint(edge.second), source_open));
        report.worst_distance = std::max(report.worst_distance, distance);
        report.cracks += distance > tolerance;
    }
    return report;
}

Triangles trianglesOfClusters(const PackGeometry& geometry, std::span<const uint32_t> clusters)
{
    Triangles triangles;
    for (const uint32_t cluster : clusters)
        for (const auto& corners : geometry.triangles(cluster))
            triangles.push_back(corners);
    return triangles;
}

double signedVolume6(const Triangles& triangles)
{
    double sum = 0;
    for (const auto& t : triangles)
        sum += dot(Double3(t[0]), cross(Double3(t[1]), Double3(t[2])));
    return sum;
}

} // namespace hearth::reference
