// Opens the parts of sources whose static scene is read.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/bricks/voxels/static_scene.h"
#include "formats/base/result.h"

#include <string>

namespace hearth::bricks
{

/// Open parts.
/// paths  import, clusters and textures part of each source
/// errors: those of tools::openPart
Result<std::vector<SourceParts>> openSources(std::span<const std::string> paths);

} // namespace hearth::bricks
