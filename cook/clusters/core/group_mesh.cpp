// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/group_mesh.h"

#include "cook/clusters/core/bounds.h"
#include "cook/clusters/core/deformation_weights.h"
#include "cook/clusters/core/set_hash.h"
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
class KeyNumbering
{
public:
    explicit KeyNumbering(size_t most) : slots_(std::bit_ceil(most * 2 + 1)), mask_(slots_.size() - 1) {}

    /// Return the key's number; equal to `next` if the key is new.
    uint32_t findOrAssign(uint64_t key, uint32_t next)
    {
        size_t slot = ((key * 0x9E3779B97F4A7C15u) >> 32) & mask_;
        while (slots_[slot].number_plus_one != 0)
        {
            if (slots_[slot].key == key)
                return slots_[slot].number_plus_one - 1;
            slot = (slot + 1) & mask_;
        }
        slots_[slot] = {key, next + 1};
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
void prefetchVertex(const mesh::SourceMesh& vertices, uint32_t vertex)
{
    __builtin_prefetch(&vertices.positions[vertex]);
    if (!vertices.normals.empty())
        __builtin_prefetch(&vertices.normals[vertex]);
    if (!vertices.uvs[0].empty())
        __builtin_prefetch(&vertices.uvs[0][vertex]);
}

/// Gather the triangles of the members. Returns the material of each wedge.
std::vector<uint32_t> gatherTriangles(GroupMesh& group, const PreparedMesh& mesh, const ClusterStore& store,
                                      std::span<const uint32_t> members, std::span<const uint8_t> locked)
{
    size_t vertex_count = 0;
    size_t triangle_count = 0;
    for (const uint32_t member : members)
    {
        vertex_count += store.shapes[member].vertex_count;
        triangle_count += store.shapes[member].triangle_count;
    }
    group.corners.reserve(triangle_count * 3);
    group.materials.reserve(triangle_count);
    KeyNumbering wedges(vertex_count);
    KeyNumbering positions(vertex_count);
    std::vector<uint32_t> wedge_of_local;
    std::vector<uint32_t> material_of_wedge;
    for (const uint32_t member : members)
    {
        const ClusterShape& shape = store.shapes[member];
        wedge_of_local.clear();
        for (const uint32_t vertex : store.clusterVertices(shape))
        {
            const auto next_wedge = static_cast<uint32_t>(group.vertex_of_wedge.size());
            const uint32_t wedge = wedges.findOrAssign(uint64_t{shape.material} << 32 | vertex, next_wedge);
            wedge_of_local.push_back(wedge);
            if (wedge != next_wedge)
                continue;
            prefetchVertex(mesh.vertices, vertex);
            const uint32_t global = mesh.position_id_of_vertex[vertex];
            const auto next_position = static_cast<uint32_t>(group.global_position_id.size());
            const uint32_t position = positions.findOrAssign(global, next_position);
            group.vertex_of_wedge.push_back(vertex);
            group.position_id_of_wedge.push_back(position);
            material_of_wedge.push_back(shape.material);
            if (position != next_position)
                continue;
            group.global_position_id.push_back(global);
            group.locked.push_back(locked[global]);
        }
        for (const uint8_t index : store.clusterIndices(shape))
            group.corners.push_back(wedge_of_local[index]);
        group.materials.insert(group.materials.end(), shape.triangle_count, shape.material);
        const auto errors = store.clusterErrors(shape);
        group.errors.insert(group.errors.end(), errors.begin(), errors.end());
    }
    return material_of_wedge;
}

void setLocalPositions(GroupMesh& group, std::span<const Float3> source_positions)
{
    Box3 box;
    for (const uint32_t vertex : group.vertex_of_wedge)
        box.add(source_positions[vertex]);
    group.scale = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
        group.center[axis] = (double{box.min[axis]} + box.max[axis]) * 0.5;
        group.scale = std::max(group.scale, (double{box.max[axis]} - box.min[axis]) * 0.5);
    }
    group.positions.resize(group.global_position_id.size());
    for (size_t w = 0; w < group.vertex_of_wedge.size(); ++w)
    {
        const Float3 p = source_positions[group.vertex_of_wedge[w]];
        Float3& local = group.positions[group.position_id_of_wedge[w]];
        for (int axis = 0; axis < 3; ++axis)
            local[axis] = static_cast<float>((p[axis] - group.center[axis]) / group.scale);
    }
}

/// Compute the local length of one unit of UV: square root of the ratio of the areas on the surface and in
/// the texture.
float uvScale(const GroupMesh& group, std::span<const Float2> uvs)
{
    double surface = 0;
    double texture = 0;
    for (size_t t = 0; t < group.corners.size(); t += 3)
    {
        const Float3 a = group.positions[group.positionIdAt(t)];
        const Float3 b = group.positions[group.positionIdAt(t + 1)];
        const Float3 c = group.positions[group.positionIdAt(t + 2)];
        surface += length(cross(b - a, c - a));
        const Float2 ua = uvs[group.vertex_of_wedge[group.corners[t]]];
        const Float2 ub = uvs[group.vertex_of_wedge[group.corners[t + 1]]];
        const Float2 uc = uvs[group.vertex_of_wedge[group.corners[t + 2]]];
        texture += std::abs((double{ub.x} - ua.x) * (double{uc.y} - ua.y) -
                            (double{ub.y} - ua.y) * (double{uc.x} - ua.x));
    }
    const double scale = texture > 0 ? std::sqrt(surface / texture) : 0.0;
    // UVs with extreme scales have no useful differences and do not steer the simplification
    return std::isfinite(scale) && scale < 1e6 && scale > 1e-6 ? static_cast<float>(scale) : 0.0f;
}

/// True if two vertices have the same attributes except normal and tangent. A hard edge may lie between them,
/// but no texture seam, and they deform alike.
bool sameChart(const mesh::SourceMesh& source, uint32_t a, uint32_t b)
{
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
                  std::span<const uint32_t> material_of_wedge)
{
    std::vector<uint32_t> latest(group.global_position_id.size(), kInvalidIndex);
    std::vector<uint32_t> before(group.vertex_of_wedge.size());
    group.chart_of_wedge.resize(group.vertex_of_wedge.size());
    for (uint32_t w = 0; w < group.vertex_of_wedge.size(); ++w)
    {
        before[w] = std::exchange(latest[group.position_id_of_wedge[w]], w);
        group.chart_of_wedge[w] = w;
        for (uint32_t other = before[w]; other != kInvalidIndex; other = before[other])
            if (material_of_wedge[w] == material_of_wedge[other] &&
                sameChart(source, group.vertex_of_wedge[w], group.vertex_of_wedge[other]))
                group.chart_of_wedge[w] = group.chart_of_wedge[other];
    }
}

/// Compute the mean change of normals over the surface, about in radians for each local unit of length. A
/// mean, not a mean square: a few sharp places must not make the normals of all others cheap.
float normalChange(const GroupMesh& group, std::span<const Float3> normals)
{
    double changes = 0;
    double lengths = 0;
    for (size_t t = 0; t < group.corners.size(); t += 3)
    {
        float change2 = 0;
        float length2 = 0;
        for (size_t k = 0; k < 3; ++k)
        {
            const size_t a = t + k, b = t + (k + 1) % 3;
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
            config.normal_weight / std::max(normalChange(group, vertices.normals), kMinNormalChange);
    if (!vertices.uvs[0].empty())
        group.uv_length = uvScale(group, vertices.uvs[0]);
    group.weights.uv = config.uv_weight * group.uv_length;
    if (!vertices.colors.empty())
        group.weights.color = config.color_weight;
    if (mesh.deforms())
        chooseDeformationWeights(mesh, group);
    group.attribute_count = group.weights.count();
    group.attribute_rows = group.weights.rows();
    group.attributes.assign(group.attribute_rows * group.vertex_of_wedge.size(), Lanes{});
    for (size_t wedge = 0; wedge < group.vertex_of_wedge.size(); ++wedge)
        packAttributes(vertices, group.vertex_of_wedge[wedge], group.weights,
                       group.attributes.data() + wedge * group.attribute_rows);
}

} // namespace

GroupMesh gatherGroup(const PreparedMesh& mesh, const ClusterStore& store, std::span<const uint32_t> members,
                      std::span<const uint8_t> locked, const Config& config)
{
    GroupMesh group;
    const std::vector<uint32_t> material_of_wedge = gatherTriangles(group, mesh, store, members, locked);
    group.grid_step = mesh.grid.step;
    assignCharts(group, mesh.vertices, material_of_wedge);
    setLocalPositions(group, mesh.vertices.positions);
    gatherAttributes(group, mesh, config);
    group.positions_fixed = !mesh.vertices.morph_targets.empty();
    for (float& error : group.errors)
        error = roundUp(error / group.scale);
    return group;
}

std::vector<uint32_t> gatherPositionIds(const GroupMesh& group, std::span<const uint32_t> wedges)
{
    std::vector<uint32_t> positions;
    positions.reserve(wedges.size());
    for (const uint32_t wedge : wedges)
        positions.push_back(group.position_id_of_wedge[wedge]);
    return positions;
}

std::vector<uint8_t> markOpenPositions(const GroupMesh& group)
{
    std::vector<uint64_t> difference(group.positions.size(), 0);
    for (size_t t = 0; t < group.corners.size(); t += 3)
        for (size_t k = 0; k < 3; ++k)
            difference[group.positionIdAt(t + k)] += hashNumber(group.positionIdAt(t + (k + 1) % 3)) -
                                                     hashNumber(group.positionIdAt(t + (k + 2) % 3));
    std::vector<uint8_t> open(difference.size());
    for (size_t p = 0; p < open.size(); ++p)
        open[p] = difference[p] != 0 ? 1 : 0;
    return open;
}

} // namespace hearth::clusters
