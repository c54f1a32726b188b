// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/levels.h"

#include "pipelines/export/cut.h"
#include "pipelines/export/meshes.h"

#include <fmt/format.h>

#include <map>

namespace hearth::gltf_export
{

using namespace formats;

namespace
{

/// Add the coarser levels of a mesh, each once: errors that give the same cut as the one before are
/// left out.
Result<std::vector<uint32_t>> addMeshLevels(GltfDocument& document, const PackView& pack, uint32_t mesh,
                                            float error)
{
    const MeshRecord& record = pack.meshes()[mesh];
    std::vector<uint32_t> levels;
    std::vector<uint32_t> finer = findCutClusters(pack, record, error);
    for (const LevelRecord& level : recordsInRange(pack.levels(), record.levels))
    {
        if (level.max_error <= error)
            continue;
        std::vector<uint32_t> cut = findCutClusters(pack, record, level.max_error);
        if (cut == finer)
            continue;
        finer = std::move(cut);
        HEARTH_ASSIGN_OR_RETURN(const uint32_t added, addMesh(document, pack, mesh, level.max_error));
        levels.push_back(added);
        document.meshes[added].name += fmt::format(" level {}", levels.size());
    }
    return levels;
}

} // namespace

Status addLevels(GltfDocument& document, const PackView& pack, std::span<const uint32_t> meshes, float error)
{
    std::map<uint32_t, std::vector<uint32_t>> levels; // of each mesh of the document
    for (uint32_t mesh = 0; mesh < meshes.size(); ++mesh)
        if (meshes[mesh] != kInvalidIndex)
        {
            HEARTH_ASSIGN_OR_RETURN(levels[meshes[mesh]], addMeshLevels(document, pack, mesh, error));
        }
    const size_t count = document.nodes.size();
    for (size_t i = 0; i < count; ++i)
    {
        const auto found = levels.find(document.nodes[i].mesh);
        if (found == levels.end())
            continue;
        for (size_t level = 0; level < found->second.size(); ++level)
        {
            Node node = document.nodes[i];
            node.name += fmt::format(" level {}", level + 1);
            node.mesh = found->second[level];
            node.children.clear();
            node.lods.clear();
            document.nodes[i].lods.push_back(static_cast<uint32_t>(document.nodes.size()));
            document.nodes.push_back(std::move(node));
        }
    }
    return success();
}

} // namespace hearth::gltf_export
