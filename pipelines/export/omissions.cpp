// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/export/omissions.h"

#include <fmt/format.h>

#include <algorithm>

namespace hearth::gltf_export
{

using namespace formats;

std::vector<std::string> Omissions::lines() const
{
    std::vector<std::string> lines;
    for (const auto& [kind, count] : counts_)
        if (count > 0)
            lines.push_back(fmt::format("{}: {}", kind, count));
    return lines;
}

void addPackOmissions(const PackView& pack, bool has_lods, Omissions& omissions)
{
    for (const MeshRecord& mesh : pack.meshes())
    {
        omissions.add("meshes with baked visibility", (mesh.attributes & kVertexVisibility) != 0 ? 1 : 0);
        if (!has_lods)
            omissions.add("meshes with coarser levels (--lods writes them)", mesh.levels.count > 1 ? 1 : 0);
    }
    omissions.add("instances with surroundings", pack.surroundings().size());
    omissions.add("bricks", pack.bricks().size());
    omissions.add("light probes", pack.probes().size());
    omissions.add("atlases of receivers", pack.receiverAtlases().size() + pack.faceAtlases().size());
    omissions.add("tables of specular occlusion", pack.specularTables().size());
    const auto has_mips = [](const ImageRecord& image) { return image.mip_count > 1; };
    omissions.add("textures with mips (only the finest is written)",
                  static_cast<size_t>(std::count_if(pack.images().begin(), pack.images().end(), has_mips)));
}

} // namespace hearth::gltf_export
