// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/open_sources.h"

#include "cook/tools/open_part.h"

namespace hearth::bricks
{

Result<std::vector<SourceParts>> openSources(std::span<const std::string> paths)
{
    std::vector<SourceParts> sources;
    for (size_t i = 0; i + 2 < paths.size(); i += 3)
    {
        HEARTH_ASSIGN_OR_RETURN(formats::PackView scene, tools::openPart(paths[i]));
        HEARTH_ASSIGN_OR_RETURN(formats::PackView clusters, tools::openPart(paths[i + 1]));
        HEARTH_ASSIGN_OR_RETURN(formats::PackView textures, tools::openPart(paths[i + 2]));
        sources.push_back({std::move(scene), std::move(clusters), std::move(textures)});
    }
    return sources;
}

} // namespace hearth::bricks
