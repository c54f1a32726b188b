// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/levels/reduce.h"

#include "cook/clusters/core/bounds.h"
#include "cook/clusters/core/group_mesh.h"
#include "cook/clusters/core/islands.h"
#include "cook/clusters/error/deformed_deviation.h"
#include "cook/clusters/error/deviation.h"
#include "cook/clusters/partition/split.h"
#include "cook/clusters/simplify/cell_merge.h"
#include "cook/clusters/simplify/simplify.h"
#include "cook/clusters/surface/surface_fit.h"

#include <algorithm>
#include <utility>

namespace hearth::clusters
{

namespace
{

/// Keeps the influences of coincident vertices equal, like those of wedges on both sides of a texture seam:
/// else the seam would open in some pose.
class CoincidentInfluences
{
public:
    CoincidentInfluences(const PreparedMesh& mesh, const GroupMesh& group, mesh::SourceMesh& made)
        : source_(mesh.vertices), group_(group), made_(made), new_vertices_at_(group.positions.size())
    {
    }

    /// Copy the influences of an earlier made vertex at the same position to a made vertex, if they moved
    /// alike.
    void share(uint32_t wedge, uint32_t vertex)
    {
        auto& others = new_vertices_at_[group_.position_id_of_wedge[wedge]];
        for (const NewVertex& other : others)
            if (moveAlike(group_.vertex_of_wedge[other.wedge], group_.vertex_of_wedge[wedge]))
            {
                for (size_t set = 0; set < made_.joint_sets.size(); ++set)
                {
                    made_.joint_sets[set][vertex] = made_.joint_sets[set][other.vertex];
                    made_.weight_sets[set][vertex] = made_.weight_sets[set][other.vertex];
                }
                return;
            }
        others.push_back({wedge, vertex});
    }

private:
    struct NewVertex
    {
        uint32_t wedge;
        uint32_t vertex;
    };

    bool moveAlike(uint32_t a, uint32_t b) const
    {
        for (size_t set = 0; set < source_.joint_sets.size(); ++set)
            if (!std::ranges::equal(source_.joint_sets[set][a].joint, source_.joint_sets[set][b].joint) ||
                !(source_.weight_sets[set][a] == source_.weight_sets[set][b]))
                return false;
        return true;
    }

    const mesh::SourceMesh& source_;
    const GroupMesh& group_;
    mesh::SourceMesh& made_;
    std::vector<std::vector<NewVertex>> new_vertices_at_; ///< distinct ones, by position
};

/// Return the vertex of each remaining wedge; those of modified positions are new.
std::vector<uint32_t> makeVertices(const PreparedMesh& mesh, const GroupMesh& group,
                                   const SimplifiedGroup& simplified, GroupReduction& reduced)
{
    constexpr uint32_t kNoNumber = 0xFFFFFFFFu;
    const Placement& placement = simplified.placement;
    std::vector<uint32_t> vertices = group.vertex_of_wedge;
    std::vector<uint32_t> position_numbers(group.positions.size(), kNoNumber);
    std::vector<uint8_t> done(vertices.size());
    for (size_t wedge = 0; wedge < done.size(); ++wedge)
        done[wedge] = placement.modified[group.position_id_of_wedge[wedge]] == 0 ? 1 : 0;
    CoincidentInfluences influences(mesh, group, reduced.made);
    for (const uint32_t wedge : simplified.corners)
    {
        if (std::exchange(done[wedge], uint8_t{1}) != 0)
            continue;
        const uint32_t position = group.position_id_of_wedge[wedge];
        if (position_numbers[position] == kNoNumber)
            position_numbers[position] = reduced.new_position_count++;
        const auto made = static_cast<uint32_t>(reduced.made.vertexCount());
        appendVertex(reduced.made, mesh.vertices, group.vertex_of_wedge[wedge]);
        reduced.made.positions[made] = placement.object_positions[position];
        unpackAttributes(placement.attributes.data() + size_t{wedge} * group.attribute_rows, group.weights,
                         reduced.made, made);
        influences.share(wedge, made);
        reduced.new_position_ids.push_back(position_numbers[position]);
        vertices[wedge] = kFirstNewVertex + made;
    }
    return vertices;
}

/// Split the remaining triangles into clusters, material by material in ascending order.
ClusterStore splitSimplified(const GroupMesh& group, const SimplifiedGroup& simplified,
                             std::span<const uint32_t> vertex_of_wedge, std::span<const float> errors,
                             uint32_t vertex_limit)
{
    const size_t count = simplified.triangleCount();
    std::vector<uint32_t> vertices(count * 3);
    for (size_t i = 0; i < vertices.size(); ++i)
        vertices[i] = vertex_of_wedge[simplified.corners[i]];
    const auto place = [&](size_t corner)
    { return simplified.placement.positions[group.position_id_of_wedge[simplified.corners[corner]]]; };
    std::vector<Float3> centers(count);
    for (size_t t = 0; t < count; ++t)
        centers[t] = triangleCenter(place(t * 3), place(t * 3 + 1), place(t * 3 + 2));
    moveToIslandCenters(centers, simplified.corners, group.vertex_of_wedge.size());
    std::vector<SplitItem> items;
    items.reserve(count);
    for (uint32_t t = 0; t < count; ++t)
        items.push_back({centers[t], t});
    const auto& materials = simplified.materials;
    if (!std::is_sorted(materials.begin(), materials.end()))
        std::stable_sort(items.begin(), items.end(),
                         [&](const SplitItem& a, const SplitItem& b)
                         { return materials[a.triangle] < materials[b.triangle]; });
    ClusterStore out;
    for (size_t first = 0; first < count;)
    {
        const uint32_t material = materials[items[first].triangle];
        size_t last = first;
        while (last < count && materials[items[last].triangle] == material)
            ++last;
        splitIntoClusters(std::span(items).subspan(first, last - first),
                          {vertices, errors, material, vertex_limit}, out);
        first = last;
    }
    return out;
}

} // namespace

GroupReduction reduceGroup(const PreparedMesh& mesh, const ClusterStore& store,
                           std::span<const uint32_t> members, std::span<const uint8_t> locked,
                           const GroupGoal& goal, const Config& config)
{
    GroupReduction reduced;
    const GroupMesh group = gatherGroup(mesh, store, members, locked, config);
    // one cluster less than before
    const size_t max_triangles = goal.exact || members.size() == 1
                                     ? group.triangleCount()
                                     : (members.size() - 1) * formats::kMaxClusterTriangles;
    SimplifiedGroup simplified = simplifyGroup(group, goal.triangles, max_triangles, goal.stop);
    const auto stuck = [&]
    {
        return simplified.triangleCount() > max_triangles ||
               static_cast<float>(simplified.triangleCount()) >
                   goal.stuck_ratio * static_cast<float>(group.triangleCount());
    };
    if (stuck())
    {
        mergeByCells(group, goal.triangles, simplified);
        simplified.merged = true;
    }
    if (stuck())
        return reduced;
    reduced.permissive = simplified.permissive;
    reduced.pruned = simplified.pruned;
    reduced.merged = simplified.merged;
    Surface after(gatherPositionIds(group, simplified.corners), simplified.placement.positions);
    SurfacePoints points = findPoints(group, simplified, after);
    fitToGroup(group, simplified, after, points);
    const std::vector<uint32_t> vertices = makeVertices(mesh, group, simplified, reduced);
    Deviation deviation =
        mesh.deforms() ? boundDeformedDeviation(group, simplified, after,
                                                {mesh.vertices, reduced.made, vertices}, meshMotion(mesh))
                       : boundDeviation(group, simplified, after, points.of_position);
    reduced.loose_pieces = deviation.loose_pieces;
    for (float& error : deviation.errors)
    {
        error = roundUp(error * group.scale);
        reduced.distance = std::max(reduced.distance, error);
    }
    reduced.attributes =
        measureAttributes(group, {simplified, after, points.of_wedge, mesh.vertices, reduced.made, vertices});
    reduced.clusters =
        splitSimplified(group, simplified, vertices, deviation.errors, clusterVertexLimit(mesh));
    reduced.progressed = goal.exact || reduced.clusters.shapes.size() < members.size();
    return reduced;
}

} // namespace hearth::clusters
