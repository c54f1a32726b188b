// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/pack/instance_meshes.h"

#include <numeric>

namespace hearth::formats
{

Result<std::vector<uint32_t>> readInstanceMeshes(const PackView& scene, const PackView& clusters_part)
{
    HEARTH_ASSIGN_OR_RETURN(const Records<uint32_t> listed,
                            clusters_part.container().records<uint32_t>(kChunkInstanceMeshes));
    const size_t count = scene.instances().size();
    if (listed.size() != 0 && listed.size() != count)
        return Error{Issue::meaning_reference, clusters_part.name(), chunkName(kChunkInstanceMeshes, 0),
                     "has meshes of " + std::to_string(listed.size()) + " instances, the scene has " +
                         std::to_string(count)};
    std::vector<uint32_t> meshes;
    for (uint32_t i = 0; i < count; ++i)
    {
        meshes.push_back(listed.size() == 0 ? scene.instances()[i].mesh : listed[i]);
        if (meshes[i] >= clusters_part.meshes().size())
            return Error{Issue::meaning_reference, listed.size() == 0 ? scene.name() : clusters_part.name(),
                         "instance " + std::to_string(i), "mesh " + std::to_string(meshes[i])};
    }
    return meshes;
}

std::vector<uint32_t> findOriginalMeshes(const PackView& scene, std::span<const uint32_t> instance_meshes,
                                         size_t mesh_count)
{
    std::vector<uint32_t> originals(mesh_count);
    std::iota(originals.begin(), originals.end(), 0U);
    for (uint32_t i = 0; i < instance_meshes.size(); ++i)
        originals[instance_meshes[i]] = scene.instances()[i].mesh;
    return originals;
}

} // namespace hearth::formats
