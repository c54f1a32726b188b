// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/mesh_pieces.h"

#include <algorithm>
#include <cmath>

namespace hearth::import
{

namespace
{

/// Call visit(array) for each array that has one element per vertex.
template <typename Mesh, typename Visit>
void forEachVertexArray(Mesh& mesh, Visit visit)
{
    visit(mesh.positions);
    visit(mesh.normals);
    visit(mesh.tangents);
    for (auto& uvs : mesh.uvs)
        visit(uvs);
    visit(mesh.colors);
    for (auto& joints : mesh.joint_sets)
        visit(joints);
    for (auto& weights : mesh.weight_sets)
        visit(weights);
    for (auto& target : mesh.morph_targets)
    {
        visit(target.positions);
        visit(target.normals);
        visit(target.tangents);
    }
}

/// Append `from` to `to` and fill absent elements with `missing`; both arrays stay empty if both are. `to`
/// has `before` elements or is empty, `from` has `added` elements or is empty.
template <typename T>
void append(std::vector<T>& to, const std::vector<T>& from, size_t before, size_t added, const T& missing)
{
    if (to.empty() && from.empty())
        return;
    to.resize(before, missing);
    to.insert(to.end(), from.begin(), from.end());
    to.resize(before + added, missing);
}

template <typename T>
void growSets(std::vector<T>& sets, size_t count)
{
    sets.resize(std::max(sets.size(), count));
}

void appendPiece(mesh::SourceMesh& to, mesh::SourceMesh&& from)
{
    const size_t before = to.vertexCount();
    const size_t added = from.vertexCount();
    growSets(to.joint_sets, from.joint_sets.size());
    growSets(from.joint_sets, to.joint_sets.size());
    growSets(to.weight_sets, to.joint_sets.size());
    growSets(from.weight_sets, to.joint_sets.size());
    growSets(to.morph_targets, from.morph_targets.size());
    growSets(from.morph_targets, to.morph_targets.size());

    append(to.positions, from.positions, before, added, {});
    append(to.normals, from.normals, before, added, {0, 0, 1});
    append(to.tangents, from.tangents, before, added, {});
    for (size_t set = 0; set < mesh::kUvSetCount; ++set)
        append(to.uvs[set], from.uvs[set], before, added, {});
    append(to.colors, from.colors, before, added, {1, 1, 1, 1});
    for (size_t set = 0; set < to.joint_sets.size(); ++set)
    {
        append(to.joint_sets[set], from.joint_sets[set], before, added, {});
        append(to.weight_sets[set], from.weight_sets[set], before, added, {set == 0 ? 1.0f : 0.0f, 0, 0, 0});
    }
    for (size_t target = 0; target < to.morph_targets.size(); ++target)
    {
        append(to.morph_targets[target].positions, from.morph_targets[target].positions, before, added, {});
        append(to.morph_targets[target].normals, from.morph_targets[target].normals, before, added, {});
        append(to.morph_targets[target].tangents, from.morph_targets[target].tangents, before, added, {});
    }
    for (const uint32_t index : from.indices)
        to.indices.push_back(static_cast<uint32_t>(before) + index);
    to.triangle_materials.insert(to.triangle_materials.end(), from.triangle_materials.begin(),
                                 from.triangle_materials.end());
}

void fillZeroTangents(mesh::SourceMesh& mesh)
{
    for (size_t i = 0; i < mesh.tangents.size(); ++i)
        if (mesh.tangents[i] == Float4{})
        {
            const Float3 tangent = anyTangent(mesh.normals[i]);
            mesh.tangents[i] = {tangent.x, tangent.y, tangent.z, 1};
        }
}

} // namespace

Float3 anyTangent(Float3 normal)
{
    const Float3 axis = std::abs(normal.x) < 0.5f ? Float3{1, 0, 0} : Float3{0, 1, 0};
    return normalizeOr(axis - normal * dot(axis, normal), {0, 0, 1});
}

void gatherVertices(mesh::SourceMesh& mesh, std::span<const uint32_t> old_from_new)
{
    forEachVertexArray(mesh,
                       [&](auto& array)
                       {
                           if (array.empty())
                               return;
                           std::remove_reference_t<decltype(array)> gathered;
                           gathered.reserve(old_from_new.size());
                           for (const uint32_t old : old_from_new)
                               gathered.push_back(array[old]);
                           array = std::move(gathered);
                       });
}

mesh::SourceMesh mergePieces(std::vector<mesh::SourceMesh> pieces)
{
    if (pieces.empty())
        return {};
    mesh::SourceMesh merged = std::move(pieces.front());
    for (size_t i = 1; i < pieces.size(); ++i)
    {
        appendPiece(merged, std::move(pieces[i]));
        pieces[i] = {};
    }
    fillZeroTangents(merged);
    return merged;
}

void fillZeroNormals(mesh::SourceMesh& mesh)
{
    if (std::none_of(mesh.normals.begin(), mesh.normals.end(), [](Float3 n) { return n == Float3{}; }))
        return;
    std::vector<Float3> sums(mesh.vertexCount());
    for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
    {
        const uint32_t* corner = mesh.indices.data() + i;
        const Float3 a = mesh.positions[corner[0]];
        const Float3 twice_area = cross(mesh.positions[corner[1]] - a, mesh.positions[corner[2]] - a);
        for (size_t k = 0; k < 3; ++k)
            sums[corner[k]] += twice_area;
    }
    for (size_t i = 0; i < mesh.normals.size(); ++i)
        if (mesh.normals[i] == Float3{})
            mesh.normals[i] = normalizeOr(sums[i], {0, 0, 1});
}

} // namespace hearth::import
