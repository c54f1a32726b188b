// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/bricks/voxels/source_parts.h"

#include "cook/tools/open_part.h"
#include "formats/pack/pack_check.h"

namespace hearth::bricks
{

Result<std::vector<SourceParts>> openSources(std::span<const std::string> paths,
                                             std::span<const tools::PartOfSource> proxies)
{
    std::vector<SourceParts> sources;
    for (size_t i = 0; i + 2 < paths.size(); i += 3)
    {
        HEARTH_ASSIGN_OR_RETURN(formats::PackView scene, tools::openPart(paths[i]));
        HEARTH_ASSIGN_OR_RETURN(formats::PackView clusters, tools::openPart(paths[i + 1]));
        HEARTH_ASSIGN_OR_RETURN(formats::PackView textures, tools::openPart(paths[i + 2]));
        sources.push_back({std::move(scene), std::move(clusters), std::move(textures)});
    }
    for (const tools::PartOfSource& proxy : proxies)
    {
        HEARTH_ASSIGN_OR_RETURN(formats::PackView part, tools::openPart(proxy.path));
        HEARTH_TRY(formats::checkProxies(part));
        sources[proxy.source].proxies = std::move(part);
    }
    return sources;
}

} // namespace hearth::bricks
