// Opens the parts of sources that cookers of the whole scene read.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

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
};

/// Open the import, clusters and textures part of each source.
/// paths  three for each source, in this order
/// errors: those of tools::openPart
Result<std::vector<SourceParts>> openSources(std::span<const std::string> paths);

} // namespace hearth::bricks
