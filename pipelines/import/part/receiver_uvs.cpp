// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/part/receiver_uvs.h"

#include "cook/receivers/bake/uv_use.h"
#include "cook/receivers/unwrap/unwrap.h"
#include "pipelines/import/part/mesh_pieces.h"

#include <algorithm>

namespace hearth::import
{

namespace
{

bool hasUsableUvs(const mesh::SourceMesh& mesh)
{
    std::vector<receivers::Triangle> triangles(mesh.triangleCount());
    for (const std::vector<Float2>& uvs : mesh.uvs)
    {
        if (uvs.empty())
            continue;
        for (size_t i = 0; i < mesh.indices.size(); ++i)
        {
            receivers::Triangle& triangle = triangles[i / 3];
            triangle.corners[i % 3] = mesh.positions[mesh.indices[i]];
            triangle.uvs[i % 3] = uvs[mesh.indices[i]];
        }
        if (receivers::checkUvsAndOverlap(triangles).use == receivers::UvUse::usable)
            return true;
    }
    return false;
}

} // namespace

void addReceiverUvs(mesh::SourceMesh& mesh, double texel_size)
{
    const auto free_set = std::ranges::find_if(mesh.uvs, [](const auto& uvs) { return uvs.empty(); });
    if (mesh.triangleCount() == 0 || !mesh.joint_sets.empty() || !mesh.morph_targets.empty() ||
        free_set == mesh.uvs.end() || hasUsableUvs(mesh))
        return;
    std::optional<receivers::Unwrapped> unwrapped =
        receivers::unwrap(mesh.positions, mesh.indices, texel_size);
    if (!unwrapped)
        return;
    gatherVertices(mesh, unwrapped->old_from_new);
    mesh.indices = std::move(unwrapped->indices);
    *free_set = std::move(unwrapped->uvs);
}

} // namespace hearth::import
