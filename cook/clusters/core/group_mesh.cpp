// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/group_mesh.h"

#include "cook/clusters/core/bounds.h"
#include "cook/clusters/core/deformation_weights.h"
#include "cook/clusters/core/set_hash.h"
#include "formats/base/assert.h"
#include "formats/base/index.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace hearth::clusters
{

namespace
{

// Flatter groups count as if their normals changed by this much over a unit of length.
constexpr float kMinNormalChange = 1.5f;

/// Numbers keys 0, 1, ... in order of first use.
template <IndexType Id>
class KeyNumbering
{
public:
    explicit KeyNumbering(size_t most) : slots_(std::bit_ceil(most * 2 + 1)), mask_(slots_.size() - 1) {}

    /// Return the key's number; equal to `next` if the key is new.
    Id findOrAssign(uint64_t key, Id next)
    {
        size_t slot = ((key * 0x9E3779B97F4A7C15u) >> 32) & mask_;
        while (slots_[slot].number_plus_one != 0)
        {
            if (slots_[slot].key == key)
                return Id{slots_[slot].number_plus_one - 1};
            slot = (slot + 1) & mask_;
        }
        slots_[slot] = {key, toIndex(next) + 1};
        return next;
    }

private:
    struct Slot
    {
        uint64_t key = 0;
        uint32_t number_plus_one = 0;
    };
    std::vector<Slot> slots_;
    size_t mask_;
};

/// Prefetch the data that setLocalPositions and gatherAttributes read: on large meshes it is not in the
/// cache.
void prefetchVertex(const mesh::SourceMesh& vertices, VertexId id)
{
    const uint32_t vertex = toIndex(id);
    __builtin_prefetch(&vertices.positions[vertex]);
    if (!vertices.normals.empty())
        __builtin_prefetch(&vertices.normals[vertex]);
    if (!vertices.uvs[0].empty())
        __builtin_prefetch(&vertices.uvs[0][vertex]);
}

/// Gather the triangles of the members. Returns the material of each wedge.
IdVector<WedgeId, uint32_t> gatherTriangles(GroupMesh& group, const PreparedMesh& mesh,
                                            const ClusterStore& store, std::span<const ClusterId> members,
                                            IdSpan<MeshPositionId, const uint8_t> locked)
{
    size_t vertex_count = 0;
    size_t triangle_count = 0;
    for (const ClusterId member : members)
    {
        vertex_count += store.shapes[member].vertex_count;
        triangle_count += store.shapes[member].triangle_count;
    }
    group.corners.reserve(triangle_count * 3);
    group.materials.reserve(triangle_count);
    KeyNumbering<WedgeId> wedges(vertex_count);
    KeyNumbering<PositionId> positions(vertex_count);
    std::vector<WedgeId> wedge_of_local;
    IdVector<WedgeId, uint32_t> material_of_wedge;
    for (const ClusterId member : members)
    {
        const ClusterShape& shape = store.shapes[member];
        wedge_of_local.clear();
        for (const VertexId vertex : store.clusterVertices(shape))
        {
            const WedgeId next_wedge = group.vertex_of_wedge.nextId();
            const WedgeId wedge =
                wedges.findOrAssign(uint64_t{shape.material} << 32 | toIndex(vertex), next_wedge);
            wedge_of_local.push_back(wedge);
            if (wedge != next_wedge)
                continue;
            prefetchVertex(mesh.vertices, vertex);
            const MeshPositionId mesh_position = mesh.position_id_of_vertex[vertex];
            const PositionId next_position = group.locked.nextId();
            const PositionId position = positions.findOrAssign(toIndex(mesh_position), next_position);
            group.vertex_of_wedge.push_back(vertex);
            group.position_id_of_wedge.push_back(position);
            material_of_wedge.push_back(shape.material);
            if (position == next_position)
                group.locked.push_back(locked[mesh_position]);
        }
        for (const uint8_t index : store.clusterIndices(shape))
            group.corners.push_back(wedge_of_local[index]);
        group.materials.insert(group.materials.end(), shape.triangle_count, shape.material);
        const auto errors = store.clusterErrors(shape);
        group.errors.insert(group.errors.end(), errors.begin(), errors.end());
    }
    return material_of_wedge;
}

void setLocalPositions(GroupMesh& group, IdSpan<VertexId, const Float3> source_positions)
{
    Box3 box;
    for (const VertexId vertex : group.vertex_of_wedge)
        box.add(source_positions[vertex]);
    group.scale = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
        group.center[axis] = (double{box.min[axis]} + box.max[axis]) * 0.5;
        group.scale = std::max(group.scale, (double{box.max[axis]} - box.min[axis]) * 0.5);
    }
    group.positions.resize(group.locked.size());
    for (const WedgeId wedge : group.vertex_of_wedge.ids())
    {
        const Float3 p = source_positions[group.vertex_of_wedge[wedge]];
        Float3& local = group.positions[group.position_id_of_wedge[wedge]];
        for (int axis = 0; axis < 3; ++axis)
            local[axis] = static_cast<float>((p[axis] - group.center[axis]) / group.scale);
    }
}

/// Compute the local length of one unit of UV: square root of the ratio of the areas on the surface and in
/// the texture.
float uvScale(const GroupMesh& group, IdSpan<VertexId, const Float2> uvs)
{
    double surface = 0;
    double texture = 0;
    for (const TriangleId triangle : group.corners.triangles())
    {
        const auto [a, b, c] = group.trianglePositions(triangle);
        surface += length(cross(b - a, c - a));
        const auto [wedge_a, wedge_b, wedge_c] = group.corners.triangle(triangle);
        const Float2 ua = uvs[group.vertex_of_wedge[wedge_a]];
        const Float2 ub = uvs[group.vertex_of_wedge[wedge_b]];
        const Float2 uc = uvs[group.vertex_of_wedge[wedge_c]];
        texture += std::abs((double{ub.x} - ua.x) * (double{uc.y} - ua.y) -
                            (double{ub.y} - ua.y) * (double{uc.x} - ua.x));
    }
    const double scale = texture > 0 ? std::sqrt(surface / texture) : 0.0;
    // UVs with extreme scales have no useful differences and do not steer the simplification
    return std::isfinite(scale) && scale < 1e6 && scale > 1e-6 ? static_cast<float>(scale) : 0.0f;
}

/// True if two vertices have the same attributes except normal and tangent. A hard edge may lie between them,
/// but no texture seam, and they deform alike.
bool sameChart(const mesh::SourceMesh& source, VertexId vertex_a, VertexId vertex_b)
{
    const uint32_t a = toIndex(vertex_a), b = toIndex(vertex_b);
    for (const auto& uvs : source.uvs)
        if (!uvs.empty() && !(uvs[a] == uvs[b]))
            return false;
    for (size_t set = 0; set < source.joint_sets.size(); ++set)
        if (!std::ranges::equal(source.joint_sets[set][a].joint, source.joint_sets[set][b].joint) ||
            !(source.weight_sets[set][a] == source.weight_sets[set][b]))
            return false;
    for (const mesh::MorphTarget& target : source.morph_targets)
        if (!(target.positions[a] == target.positions[b]))
            return false;
    return source.colors.empty() || source.colors[a] == source.colors[b];
}

/// Identify each chart at a position by its first wedge.
void assignCharts(GroupMesh& group, const mesh::SourceMesh& source,
                  IdSpan<WedgeId, const uint32_t> material_of_wedge)
{
    IdVector<PositionId, WedgeId> latest(group.locked.size(), kInvalid);
    IdVector<WedgeId, WedgeId> before(group.vertex_of_wedge.size());
    group.chart_of_wedge.resize(group.vertex_of_wedge.size());
    for (const WedgeId wedge : before.ids())
    {
        before[wedge] = std::exchange(latest[group.position_id_of_wedge[wedge]], wedge);
        group.chart_of_wedge[wedge] = wedge;
        for (WedgeId other = before[wedge]; other != kInvalid; other = before[other])
            if (material_of_wedge[wedge] == material_of_wedge[other] &&
                sameChart(source, group.vertex_of_wedge[wedge], group.vertex_of_wedge[other]))
                group.chart_of_wedge[wedge] = group.chart_of_wedge[other];
    }
}

/// Compute the mean change of normals over the surface, about in radians for each local unit of length. A
/// mean, not a mean square: a few sharp places must not make the normals of all others cheap.
float normalChange(const GroupMesh& group, IdSpan<VertexId, const Float3> normals)
{
    double changes = 0;
    double lengths = 0;
    for (const TriangleId triangle : group.corners.triangles())
    {
        float change2 = 0;
        float length2 = 0;
        for (const CornerId a : makeCorners(triangle))
        {
            const CornerId b = nextHalfEdge(a);
            const Float3 along =
                group.positions[group.positionIdAt(b)] - group.positions[group.positionIdAt(a)];
            const Float3 change = normals[group.vertex_of_wedge[group.corners[b]]] -
                                  normals[group.vertex_of_wedge[group.corners[a]]];
            change2 += dot(change, change);
            length2 += dot(along, along);
        }
        changes += std::sqrt(change2);
        lengths += std::sqrt(length2);
    }
    return lengths > 0 ? static_cast<float>(changes / lengths) : 0.0f;
}

void gatherAttributes(GroupMesh& group, const PreparedMesh& mesh, const Config& config)
{
    const mesh::SourceMesh& vertices = mesh.vertices;
    if (!vertices.normals.empty() && config.normal_weight > 0)
        group.weights.normal =
            config.normal_weight /
            std::max(normalChange(group, IdSpan<VertexId, const Float3>(vertices.normals)), kMinNormalChange);
    if (!vertices.uvs[0].empty())
        group.uv_length = uvScale(group, IdSpan<VertexId, const Float2>(vertices.uvs[0]));
    group.weights.uv = config.uv_weight * group.uv_length;
    if (!vertices.colors.empty())
        group.weights.color = config.color_weight;
    if (mesh.deforms())
        chooseDeformationWeights(mesh, group);
    group.attribute_count = group.weights.count();
    group.attribute_rows = group.weights.rows();
    group.attributes.assign(group.attribute_rows * group.vertex_of_wedge.size(), Lanes{});
    for (const WedgeId wedge : group.vertex_of_wedge.ids())
        packAttributes(vertices, toIndex(group.vertex_of_wedge[wedge]), group.weights,
                       group.attributes.data() + group.firstRow(wedge));
}

} // namespace

GroupMesh gatherGroup(const PreparedMesh& mesh, const ClusterStore& store, std::span<const ClusterId> members,
                      IdSpan<MeshPositionId, const uint8_t> locked, const Config& config)
{
    HEARTH_ASSERT(!members.empty() && allBelow(members, store.shapes.size()));
    HEARTH_ASSERT(locked.size() == mesh.position_count);
    GroupMesh group;
    const auto material_of_wedge = gatherTriangles(group, mesh, store, members, locked);
    group.grid_step = mesh.grid.step;
    group.mesh_box = mesh.box;
    assignCharts(group, mesh.vertices, material_of_wedge);
    setLocalPositions(group, mesh.positions());
    gatherAttributes(group, mesh, config);
    group.positions_fixed = !mesh.vertices.morph_targets.empty();
    for (float& error : group.errors)
        error = roundUp(error / group.scale);
    HEARTH_ASSERT(group.scale > 0);
    HEARTH_RUNTIME_ASSERT(allBelow(group.corners, group.vertex_of_wedge.size()));
    HEARTH_ASSERT(allBelow(group.position_id_of_wedge, group.positions.size()));
    HEARTH_ASSERT(group.materials.size() == group.triangleCount() &&
                  group.errors.size() == group.triangleCount());
    return group;
}

CornerVector<PositionId> gatherPositionIds(const GroupMesh& group, CornerSpan<const WedgeId> wedges)
{
    HEARTH_RUNTIME_ASSERT(allBelow(wedges, group.position_id_of_wedge.size()));
    CornerVector<PositionId> positions;
    positions.reserve(wedges.size());
    for (const WedgeId wedge : wedges)
        positions.push_back(group.position_id_of_wedge[wedge]);
    return positions;
}

IdVector<PositionId, uint8_t> markOpenPositions(const GroupMesh& group)
{
    const auto hashAt = [&](CornerId corner) { return hashNumber(toIndex(group.positionIdAt(corner))); };
    IdVector<PositionId, uint64_t> difference(group.positions.size(), 0);
    for (const TriangleId triangle : group.corners.triangles())
        for (const CornerId corner : makeCorners(triangle))
            difference[group.positionIdAt(corner)] +=
                hashAt(nextHalfEdge(corner)) - hashAt(previousHalfEdge(corner));
    IdVector<PositionId, uint8_t> open(difference.size());
    for (const PositionId position : open.ids())
        open[position] = difference[position] != 0 ? 1 : 0;
    return open;
}

} // namespace hearth::clusters
