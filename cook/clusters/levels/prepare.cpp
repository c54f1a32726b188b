// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/core/cluster.h"
#include "cook/clusters/core/influence_displacement.h"
#include "cook/mesh/deformation.h"
#include "cook/mesh/free_memory.h"
#include "cook/mesh/triangles.h"
#include "cook/mesh/weld.h"
#include "formats/base/assert.h"
#include "formats/codecs/vertex_codec.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

namespace hearth::clusters
{

void ClusterStore::append(const ClusterStore& other)
{
    HEARTH_ASSERT(other.errors.size() * 3 == other.indices.size());
    const auto vertex_offset = static_cast<uint32_t>(vertices.size());
    const auto index_offset = static_cast<uint32_t>(indices.size());
    for (ClusterShape shape : other.shapes)
    {
        shape.first_vertex += vertex_offset;
        shape.first_index += index_offset;
        shapes.push_back(shape);
    }
    vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
    indices.insert(indices.end(), other.indices.begin(), other.indices.end());
    errors.insert(errors.end(), other.errors.begin(), other.errors.end());
}

void ClusterStore::appendCluster(const ClusterStore& other, const ClusterShape& shape)
{
    ClusterShape copy = shape;
    copy.first_vertex = static_cast<uint32_t>(vertices.size());
    copy.first_index = static_cast<uint32_t>(indices.size());
    shapes.push_back(copy);
    const auto shape_vertices = other.clusterVertices(shape);
    const auto shape_indices = other.clusterIndices(shape);
    const auto shape_errors = other.clusterErrors(shape);
    vertices.insert(vertices.end(), shape_vertices.begin(), shape_vertices.end());
    indices.insert(indices.end(), shape_indices.begin(), shape_indices.end());
    errors.insert(errors.end(), shape_errors.begin(), shape_errors.end());
}

namespace
{

std::vector<uint8_t> degenerateTriangles(const mesh::SourceMesh& source)
{
    std::vector<uint8_t> degenerate(source.triangleCount());
    const auto look = [&](const tbb::blocked_range<size_t>& triangles)
    {
        for (size_t t = triangles.begin(); t < triangles.end(); ++t)
            degenerate[t] = mesh::isDegenerate(source.positions[source.indices[t * 3]],
                                               source.positions[source.indices[t * 3 + 1]],
                                               source.positions[source.indices[t * 3 + 2]])
                                ? 1
                                : 0;
    };
    tbb::parallel_for(tbb::blocked_range<size_t>(0, degenerate.size(), 16384), look);
    return degenerate;
}

/// True if normals bend, but along three edges of four by less than six degrees: then an error of 0.7
/// degrees, as codes of 8 bits have, is visible. Creases do not hide it on the sheets between them.
bool isGentlyCurved(IdSpan<VertexId, const Float3> normals, CornerSpan<const VertexId> corners)
{
    constexpr float kFlat2 = 1e-6f;
    constexpr float kGentle2 = 1e-2f; // length of the difference of two normals, squared
    size_t bent = 0, gentle = 0;
    if (normals.empty())
        return false;
    for (const HalfEdgeId half_edge : corners.ids())
    {
        const Float3 change = normals[corners[nextHalfEdge(half_edge)]] - normals[corners[half_edge]];
        const float change2 = dot(change, change);
        bent += change2 > kFlat2 ? 1 : 0;
        gentle += change2 < kGentle2 ? 1 : 0;
    }
    return bent > 0 && gentle * 4 >= corners.size() * 3;
}

/// Call `visit` for each array of positions or attributes of both meshes.
template <typename Visit>
void forEachArray(mesh::SourceMesh& to, const mesh::SourceMesh& from, Visit visit)
{
    visit(to.positions, from.positions);
    visit(to.normals, from.normals);
    visit(to.tangents, from.tangents);
    for (size_t set = 0; set < mesh::kUvSetCount; ++set)
        visit(to.uvs[set], from.uvs[set]);
    visit(to.colors, from.colors);
    // a mesh without vertices has no sets yet
    to.joint_sets.resize(std::max(to.joint_sets.size(), from.joint_sets.size()));
    to.weight_sets.resize(to.joint_sets.size());
    for (size_t set = 0; set < from.joint_sets.size(); ++set)
    {
        visit(to.joint_sets[set], from.joint_sets[set]);
        visit(to.weight_sets[set], from.weight_sets[set]);
    }
    to.morph_targets.resize(std::max(to.morph_targets.size(), from.morph_targets.size()));
    for (size_t target = 0; target < from.morph_targets.size(); ++target)
    {
        visit(to.morph_targets[target].positions, from.morph_targets[target].positions);
        visit(to.morph_targets[target].normals, from.morph_targets[target].normals);
    }
}

} // namespace

void appendVertex(mesh::SourceMesh& to, const mesh::SourceMesh& from, uint32_t vertex)
{
    HEARTH_ASSERT(vertex < from.vertexCount());
    forEachArray(to, from,
                 [vertex](auto& target, const auto& source)
                 {
                     if (!source.empty())
                         target.push_back(source[vertex]);
                 });
}

void appendVertices(mesh::SourceMesh& to, const mesh::SourceMesh& from)
{
    // a mesh without vertices has no sets and targets
    if (from.positions.empty())
        return;
    forEachArray(to, from,
                 [](auto& target, const auto& source)
                 { target.insert(target.end(), source.begin(), source.end()); });
    HEARTH_ASSERT(to.normals.empty() || to.normals.size() == to.vertexCount());
}

uint32_t clusterVertexLimit(const PreparedMesh& mesh)
{
    using namespace formats;
    const size_t targets = mesh.vertices.morph_targets.size();
    if (targets == 0)
        return kMaxClusterVertices;
    const uint32_t layout = worstCaseLayout(mesh.attributes);
    const size_t fixed = clusterBytes(layout, 0, kMaxClusterTriangles) + 4 * morphSectionWords(targets, 0);
    const size_t of_vertex = 4 * vertexWords(layout) + 12 * targets;
    const size_t half_page = kMaxPageBytes / 2;
    const size_t limit = fixed < half_page ? (half_page - fixed) / of_vertex : 0;
    return static_cast<uint32_t>(std::clamp<size_t>(limit, 3, kMaxClusterVertices));
}

PreparedMesh prepareMesh(mesh::SourceMesh source, uint32_t influences, const MeshMotion* motion)
{
    HEARTH_ASSERT(source.indices.size() % 3 == 0 &&
                  source.triangle_materials.size() == source.triangleCount());
    HEARTH_RUNTIME_ASSERT(source.indices.empty() ||
                          *std::max_element(source.indices.begin(), source.indices.end()) <
                              source.vertexCount());
    HEARTH_ASSERT(influences == 4 || influences == 8);
    PreparedMesh prepared;
    prepared.motion = motion;
    mesh::SourceMesh all; // only joints and weights
    if (source.joint_sets.size() * 4 > influences)
    {
        all.joint_sets = source.joint_sets;
        all.weight_sets = source.weight_sets;
    }
    prepared.influence_loss = mesh::reduceInfluences(source, influences);
    prepared.morph_steps = mesh::snapMorphTargets(source);
    if (prepared.influence_loss.vertex_count == 0)
        prepared.influence_displacement = 0;
    else if (motion != nullptr && motion->skin != nullptr)
        prepared.influence_displacement = influenceDisplacement(all, source, *motion);
    all = {};
    prepared.attributes = mesh::attributeBits(source);
    const std::vector<uint8_t> degenerate = degenerateTriangles(source);
    prepared.grid = mesh::snapToGrid(source);
    mesh::Weld weld;
    std::vector<uint32_t> first_equal;
    tbb::parallel_invoke([&] { weld = mesh::weldPositions(source.positions); },
                         [&] { first_equal = mesh::firstEqualVertices(source); });
    prepared.corners.reserve(source.indices.size());
    // the array of the source is reused for the result
    std::vector<uint32_t>& materials = source.triangle_materials;
    size_t kept = 0;
    for (size_t t = 0; t < degenerate.size(); ++t)
    {
        const uint32_t a = first_equal[source.indices[t * 3]];
        const uint32_t b = first_equal[source.indices[t * 3 + 1]];
        const uint32_t c = first_equal[source.indices[t * 3 + 2]];
        // triangles that became flat on the grid stay: removing them would disconnect their neighbours
        if (degenerate[t] != 0 || source.positions[a] == source.positions[b] ||
            source.positions[b] == source.positions[c] || source.positions[c] == source.positions[a])
        {
            ++prepared.degenerate_count;
            continue;
        }
        for (const uint32_t vertex : {a, b, c})
        {
            prepared.corners.push_back(VertexId{vertex});
            prepared.box.add(source.positions[vertex]);
        }
        materials[kept++] = materials[t];
    }
    mesh::freeMemory(source.indices);
    materials.resize(kept);
    prepared.materials = IdVector<TriangleId, uint32_t>(std::move(materials));
    prepared.gently_curved = isGentlyCurved(IdSpan<VertexId, const Float3>(source.normals), prepared.corners);
    prepared.position_id_of_vertex =
        IdVector<VertexId, MeshPositionId>(convertIds<MeshPositionId>(weld.position_id_of_vertex));
    mesh::freeMemory(weld.position_id_of_vertex);
    prepared.position_count = weld.position_count;
    prepared.vertices = std::move(source);
    HEARTH_ASSERT(prepared.materials.size() == prepared.triangleCount());
    HEARTH_ASSERT(prepared.position_id_of_vertex.size() == prepared.vertices.vertexCount());
    return prepared;
}

} // namespace hearth::clusters
