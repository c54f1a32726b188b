// Opens the parts of sources that cookers of the whole scene read.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/part_of_source.h"
#include "formats/pack/pack_view.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace hearth::bricks
{

/// Parts of one source.
struct SourceParts
{
    formats::PackView scene; ///< import part: nodes, instances, materials, cameras
    formats::PackView clusters;
    formats::PackView textures;
    std::optional<formats::PackView> proxies{}; ///< nothing: the source has none
};

/// Open the import, clusters and textures part of each source.
/// paths    three for each source, in this order
/// proxies  proxy parts of some of them
/// errors: those of tools::openPart and checkProxies
Result<std::vector<SourceParts>> openSources(std::span<const std::string> paths,
                                             std::span<const tools::PartOfSource> proxies = {});

} // namespace hearth::bricks
