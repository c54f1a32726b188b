// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/levels/authored_lods.h"

#include "cook/clusters/core/bounds.h"
#include "cook/clusters/core/triangle_block.h"
#include "cook/clusters/surface/surface_tree.h"
#include "formats/base/assert.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hearth::clusters
{

using namespace formats;

namespace
{

/// Return any unit vector orthogonal to the normal.
Float4 anyTangent(Float3 normal)
{
    const Float3 axis = std::abs(normal.x) < 0.5f ? Float3{1, 0, 0} : Float3{0, 1, 0};
    const Float3 tangent = normalizeOr(axis - normal * dot(normal, axis), {1, 0, 0});
    return {tangent.x, tangent.y, tangent.z, 1};
}

/// Make the array hold `count` values, or none if the source has none.
template <typename T>
void fit(std::vector<T>& values, bool wanted, size_t count, T otherwise)
{
    if (!wanted)
        values.clear();
    else if (values.empty())
        values.assign(count, otherwise);
}

/// Give the authored LOD the attributes that the source has.
void fitAttributes(const mesh::SourceMesh& source, mesh::SourceMesh& level)
{
    const size_t count = level.vertexCount();
    fit(level.normals, !source.normals.empty(), count, Float3{0, 1, 0});
    if (!source.tangents.empty() && level.tangents.empty())
        for (const Float3 normal : level.normals)
            level.tangents.push_back(anyTangent(normal));
    fit(level.tangents, !source.tangents.empty(), count, Float4{1, 0, 0, 1});
    for (size_t set = 0; set < mesh::kUvSetCount; ++set)
        fit(level.uvs[set], !source.uvs[set].empty(), count, Float2{0, 0});
    fit(level.colors, !source.colors.empty(), count, Float4{1, 1, 1, 1});
    level.joint_sets.resize(source.joint_sets.size());
    level.weight_sets.resize(source.joint_sets.size());
    for (size_t set = 0; set < source.joint_sets.size(); ++set)
    {
        fit(level.joint_sets[set], true, count, mesh::Joints4{});
        fit(level.weight_sets[set], true, count, set == 0 ? Float4{1, 0, 0, 0} : Float4{});
    }
    level.morph_targets.resize(source.morph_targets.size());
    for (size_t target = 0; target < source.morph_targets.size(); ++target)
    {
        fit(level.morph_targets[target].positions, !source.morph_targets[target].positions.empty(), count,
            Float3{});
        fit(level.morph_targets[target].normals, !source.morph_targets[target].normals.empty(), count,
            Float3{});
    }
}

/// Take the triangles of prepared.materials[first ..) whose material, which is their number, is below `end`.
AuthoredLod takeTriangles(const PreparedMesh& prepared, size_t& first, size_t end,
                          std::span<const uint32_t> materials)
{
    AuthoredLod level;
    for (; first < prepared.materials.size(); ++first)
    {
        const auto triangle = toId<TriangleId>(first);
        const uint32_t number = prepared.materials[triangle];
        if (number >= end)
            break;
        level.materials.push_back(materials[number]);
        for (const VertexId vertex : prepared.corners.triangle(triangle))
            level.corners.push_back(vertex);
    }
    return level;
}

} // namespace

JoinedMesh joinAuthored(mesh::SourceMesh source, std::span<const mesh::SourceMesh> authored,
                        uint32_t influences, const MeshMotion* motion)
{
    JoinedMesh joined;
    if (authored.empty())
    {
        joined.mesh = prepareMesh(std::move(source), influences, motion);
        return joined;
    }
    HEARTH_ASSERT(source.triangle_materials.size() == source.triangleCount());
    // materials are replaced by triangle numbers, to see which triangles remain
    std::vector<uint32_t> materials = std::move(source.triangle_materials);
    std::vector<size_t> ends{source.triangleCount()};
    for (mesh::SourceMesh level : authored)
    {
        fitAttributes(source, level);
        const auto first_vertex = static_cast<uint32_t>(source.vertexCount());
        appendVertices(source, level);
        for (const uint32_t index : level.indices)
            source.indices.push_back(first_vertex + index);
        materials.insert(materials.end(), level.triangle_materials.begin(), level.triangle_materials.end());
        ends.push_back(source.triangleCount());
    }
    source.triangle_materials.resize(materials.size());
    std::iota(source.triangle_materials.begin(), source.triangle_materials.end(), 0u);
    joined.mesh = prepareMesh(std::move(source), influences, motion);

    size_t first = 0;
    AuthoredLod finest = takeTriangles(joined.mesh, first, ends[0], materials);
    size_t coarsest = finest.triangleCount();
    for (size_t i = 0; i < authored.size(); ++i)
    {
        AuthoredLod level = takeTriangles(joined.mesh, first, ends[i + 1], materials);
        level.authored = i;
        HEARTH_ASSERT(level.corners.triangleCount() == level.triangleCount());
        if (level.triangleCount() == 0 || level.triangleCount() >= coarsest)
            continue;
        coarsest = level.triangleCount();
        joined.levels.push_back(std::move(level));
    }
    joined.mesh.degenerate_count = static_cast<uint32_t>(ends[0] - finest.triangleCount());
    joined.mesh.corners = std::move(finest.corners);
    joined.mesh.materials = std::move(finest.materials);
    return joined;
}

namespace
{

// This many centers give a root mean square to a per cent; each costs some microseconds.
constexpr size_t kMinMiddles = 65536;

using CornerWeights = std::array<float, 3>;

using TriangleVertices = std::array<VertexId, 3>;

/// Return the values of a triangle's vertices.
template <typename Value>
std::array<Value, 3> triangleValues(const std::vector<Value>& values, const TriangleVertices& vertices)
{
    return {values[toIndex(vertices[0])], values[toIndex(vertices[1])], values[toIndex(vertices[2])]};
}

template <typename Value>
Value valueAt(const std::vector<Value>& values, const TriangleVertices& vertices,
              const CornerWeights& weights)
{
    const auto [a, b, c] = triangleValues(values, vertices);
    return a * weights[0] + b * weights[1] + c * weights[2];
}

/// Return the point of a triangle that is nearest to a position.
CornerWeights nearestPoint(const std::vector<Float3>& positions, const TriangleVertices& vertices,
                           Float3 place)
{
    const auto [a, b, c] = triangleValues(positions, vertices);
    const DistanceTriangle triangle = makeDistanceTriangle(a - place, b - place, c - place);
    const TriangleBlock::Nearest nearest =
        makeTriangleBlock({&triangle, &triangle, &triangle, &triangle}).nearest({});
    return {1 - nearest.v[0] - nearest.w[0], nearest.v[0], nearest.w[0]};
}

double triangleArea(const std::vector<Float3>& positions, const TriangleVertices& vertices)
{
    const auto [a, b, c] = triangleValues(positions, vertices);
    return double{length(cross(b - a, c - a))};
}

double triangleArea(const std::vector<Float2>& uvs, const TriangleVertices& vertices)
{
    const auto [a, b, c] = triangleValues(uvs, vertices);
    const Float2 ab = b - a, ac = c - a;
    return std::abs(double{ab.x} * double{ac.y} - double{ab.y} * double{ac.x});
}

float edgeLength(IdSpan<VertexId, const Float3> positions, CornerSpan<const VertexId> corners)
{
    double sum = 0;
    for (const HalfEdgeId half_edge : corners.ids())
    {
        const Float3 edge = positions[corners[nextHalfEdge(half_edge)]] - positions[corners[half_edge]];
        sum += double{dot(edge, edge)};
    }
    return roundUp(std::sqrt(sum / static_cast<double>(corners.size())));
}

} // namespace

AttributeStep measureAttributes(const PreparedMesh& mesh, CornerSpan<const VertexId> source_corners,
                                const AuthoredLod& level)
{
    HEARTH_ASSERT(!source_corners.empty() && !level.corners.empty());
    constexpr CornerWeights kCentroid{1.0f / 3, 1.0f / 3, 1.0f / 3};
    const mesh::SourceMesh& vertices = mesh.vertices;
    const bool has_normals = !vertices.normals.empty(), has_uvs = !vertices.uvs[0].empty();
    const size_t stride = std::max<size_t>(1, source_corners.triangleCount() / kMinMiddles);
    const SurfaceTree tree({mesh.positions(), level.corners});
    double surface = 0, texture = 0, normal2 = 0, uv2 = 0;
    TriangleId hint{};
    for (size_t t = 0; t < source_corners.triangleCount(); t += stride)
    {
        const TriangleVertices from = source_corners.triangle(toId<TriangleId>(t));
        const Float3 middle = valueAt(vertices.positions, from, kCentroid);
        hint = tree.nearest(widen(middle), 0, hint).triangle;
        const TriangleVertices to = level.corners.triangle(hint);
        const CornerWeights weights = nearestPoint(vertices.positions, to, middle);
        const double area = triangleArea(vertices.positions, from);
        surface += area;
        if (has_normals)
        {
            const Float3 away = normalizeOr(valueAt(vertices.normals, from, kCentroid), {}) -
                                normalizeOr(valueAt(vertices.normals, to, weights), {});
            normal2 += area * double{dot(away, away)};
        }
        if (has_uvs)
        {
            const Float2 away =
                valueAt(vertices.uvs[0], from, kCentroid) - valueAt(vertices.uvs[0], to, weights);
            texture += triangleArea(vertices.uvs[0], from);
            uv2 += area * (double{away.x} * double{away.x} + double{away.y} * double{away.y});
        }
    }
    AttributeStep step;
    if (surface > 0)
        step.error.normal = static_cast<float>(angleFromChord(std::sqrt(normal2 / surface)));
    // the mean square is uv2 / surface; the square of a UV unit's length is surface / texture
    if (texture > 0 && !std::isnan(uv2))
        step.error.uv = roundUp(std::sqrt(uv2 / texture));
    step.edge_length = edgeLength(mesh.positions(), level.corners);
    return step;
}

void linkPagesOfSets(Hierarchy& hierarchy)
{
    // pages of each set, by the number of its first group
    std::vector<std::vector<uint32_t>> pages_of_set(hierarchy.groups.size());
    for (uint32_t g = 0; g < hierarchy.groups.size(); ++g)
    {
        HEARTH_ASSERT(hierarchy.groups[g].set_offset <= g);
        std::vector<uint32_t>& pages = pages_of_set[g - hierarchy.groups[g].set_offset];
        if (pages.empty() || pages.back() != hierarchy.groups[g].page)
            pages.push_back(hierarchy.groups[g].page);
    }
    std::vector<std::vector<uint32_t>> parents(hierarchy.pages.size());
    for (const ClusterRecord& cluster : hierarchy.clusters)
    {
        if (cluster.refined_group == kInvalidIndex)
            continue;
        // clusters are in page order: each list comes out ascending
        for (const uint32_t finer : pages_of_set[cluster.refined_group])
            if (finer != cluster.page && (parents[finer].empty() || parents[finer].back() != cluster.page))
                parents[finer].push_back(cluster.page);
    }
    hierarchy.page_parents.clear();
    for (size_t p = 0; p < parents.size(); ++p)
    {
        hierarchy.pages[p].parents = {static_cast<uint32_t>(hierarchy.page_parents.size()),
                                      static_cast<uint32_t>(parents[p].size())};
        hierarchy.page_parents.insert(hierarchy.page_parents.end(), parents[p].begin(), parents[p].end());
    }
}

} // namespace hearth::clusters
