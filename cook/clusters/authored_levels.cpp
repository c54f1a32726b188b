// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/clusters/authored_levels.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hearth::clusters
{

using namespace formats;

namespace
{

/// Any unit vector that stands upright on the normal.
Float4 anyTangent(Float3 normal)
{
    const Float3 axis = std::abs(normal.x) < 0.5f ? Float3{1, 0, 0} : Float3{0, 1, 0};
    const Float3 tangent = normalizeOr(axis - normal * dot(normal, axis), {1, 0, 0});
    return {tangent.x, tangent.y, tangent.z, 1};
}

/// The array with `count` values, or none where the source has none.
template <typename T>
void fit(std::vector<T>& values, bool wanted, size_t count, T otherwise)
{
    if (!wanted)
        values.clear();
    else if (values.empty())
        values.assign(count, otherwise);
}

/// Give the level the attributes that the source has.
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
}

/// The triangles of prepared.materials[first ..) whose material, which numbers them, is below `end`.
AuthoredLevel takeTriangles(const PreparedMesh& prepared, size_t& first, size_t end,
                            std::span<const uint32_t> materials)
{
    AuthoredLevel level;
    const size_t begin = first;
    while (first < prepared.materials.size() && prepared.materials[first] < end)
        level.materials.push_back(materials[prepared.materials[first++]]);
    level.corners.assign(prepared.corners.begin() + static_cast<std::ptrdiff_t>(begin * 3),
                         prepared.corners.begin() + static_cast<std::ptrdiff_t>(first * 3));
    return level;
}

} // namespace

JoinedMesh joinAuthored(mesh::SourceMesh source, std::span<const mesh::SourceMesh> authored)
{
    JoinedMesh joined;
    if (authored.empty())
    {
        joined.mesh = prepareMesh(std::move(source));
        return joined;
    }
    // triangles are numbered in place of their materials, so that it shows which of them are kept
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
    joined.mesh = prepareMesh(std::move(source));

    size_t first = 0;
    AuthoredLevel finest = takeTriangles(joined.mesh, first, ends[0], materials);
    size_t coarsest = finest.triangleCount();
    for (size_t i = 0; i < authored.size(); ++i)
    {
        AuthoredLevel level = takeTriangles(joined.mesh, first, ends[i + 1], materials);
        level.authored = i;
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

void linkPagesOfSets(Hierarchy& hierarchy)
{
    // the pages of each set, by the number of its first group
    std::vector<std::vector<uint32_t>> pages_of_set(hierarchy.groups.size());
    for (uint32_t g = 0; g < hierarchy.groups.size(); ++g)
    {
        std::vector<uint32_t>& pages = pages_of_set[g - hierarchy.groups[g].set_offset];
        if (pages.empty() || pages.back() != hierarchy.groups[g].page)
            pages.push_back(hierarchy.groups[g].page);
    }
    std::vector<std::vector<uint32_t>> parents(hierarchy.pages.size());
    for (const ClusterRecord& cluster : hierarchy.clusters)
    {
        if (cluster.refined_group == kNone)
            continue;
        // clusters stand in page order: each list comes out ascending
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
