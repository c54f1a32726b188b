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
#include "formats/base/assert.h"

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
    void share(WedgeId wedge, uint32_t vertex)
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
        WedgeId wedge;
        uint32_t vertex; ///< of the made ones
    };

    bool moveAlike(VertexId vertex_a, VertexId vertex_b) const
    {
        const uint32_t a = toIndex(vertex_a), b = toIndex(vertex_b);
        for (size_t set = 0; set < source_.joint_sets.size(); ++set)
            if (!std::ranges::equal(source_.joint_sets[set][a].joint, source_.joint_sets[set][b].joint) ||
                !(source_.weight_sets[set][a] == source_.weight_sets[set][b]))
                return false;
        return true;
    }

    const mesh::SourceMesh& source_;
    const GroupMesh& group_;
    mesh::SourceMesh& made_;
    IdVector<PositionId, std::vector<NewVertex>> new_vertices_at_; ///< distinct ones
};

/// Return the vertex of each remaining wedge; those of modified positions are new.
IdVector<WedgeId, VertexId> makeVertices(const PreparedMesh& mesh, const GroupMesh& group,
                                         const SimplifiedGroup& simplified, GroupReduction& reduced)
{
    constexpr uint32_t kNoNumber = 0xFFFFFFFFu;
    const Placement& placement = simplified.placement;
    IdVector<WedgeId, VertexId> vertices = group.vertex_of_wedge;
    IdVector<PositionId, uint32_t> position_numbers(group.positions.size(), kNoNumber);
    IdVector<WedgeId, uint8_t> done(vertices.size());
    for (const WedgeId wedge : done.ids())
        done[wedge] = placement.modified[group.position_id_of_wedge[wedge]] == 0 ? 1 : 0;
    CoincidentInfluences influences(mesh, group, reduced.made);
    for (const WedgeId wedge : simplified.corners)
    {
        if (std::exchange(done[wedge], uint8_t{1}) != 0)
            continue;
        const PositionId position = group.position_id_of_wedge[wedge];
        if (position_numbers[position] == kNoNumber)
            position_numbers[position] = reduced.new_position_count++;
        const auto made = static_cast<uint32_t>(reduced.made.vertexCount());
        appendVertex(reduced.made, mesh.vertices, toIndex(group.vertex_of_wedge[wedge]));
        reduced.made.positions[made] = placement.object_positions[position];
        unpackAttributes(placement.attributes.data() + group.firstRow(wedge), group.weights, reduced.made,
                         made);
        influences.share(wedge, made);
        reduced.new_position_ids.push_back(position_numbers[position]);
        vertices[wedge] = makeNewVertex(made);
    }
    return vertices;
}

/// Split the remaining triangles into clusters, material by material in ascending order.
ClusterStore splitSimplified(const GroupMesh& group, const SimplifiedGroup& simplified,
                             IdSpan<WedgeId, const VertexId> vertex_of_wedge,
                             IdSpan<TriangleId, const float> errors, uint32_t vertex_limit)
{
    const size_t count = simplified.triangleCount();
    CornerVector<VertexId> vertices(simplified.corners.size());
    for (const CornerId corner : vertices.ids())
        vertices[corner] = vertex_of_wedge[simplified.corners[corner]];
    const auto place = [&](WedgeId wedge)
    { return simplified.placement.positions[group.position_id_of_wedge[wedge]]; };
    IdVector<TriangleId, Float3> centers(count);
    for (const TriangleId triangle : centers.ids())
    {
        const auto [a, b, c] = simplified.corners.triangle(triangle);
        centers[triangle] = triangleCenter(place(a), place(b), place(c));
    }
    moveToIslandCenters<WedgeId>(centers, simplified.corners, group.vertex_of_wedge.size());
    std::vector<SplitItem> items;
    items.reserve(count);
    for (const TriangleId triangle : centers.ids())
        items.push_back({centers[triangle], triangle});
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
                           std::span<const ClusterId> members, IdSpan<MeshPositionId, const uint8_t> locked,
                           const GroupGoal& goal, const Config& config)
{
    HEARTH_ASSERT(goal.triangles > 0);
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
    const IdVector<WedgeId, VertexId> vertices = makeVertices(mesh, group, simplified, reduced);
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
    HEARTH_ASSERT(reduced.new_position_ids.size() == reduced.made.vertexCount());
    HEARTH_ASSERT(reduced.clusters.errors.size() == simplified.triangleCount());
    reduced.progressed = goal.exact || reduced.clusters.shapes.size() < members.size();
    return reduced;
}

} // namespace hearth::clusters
