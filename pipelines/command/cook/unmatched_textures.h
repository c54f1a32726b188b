// Finds rules of textures that match no texture of a cook.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/graph/cook_graph.h"

#include <optional>
#include <string>
#include <vector>

namespace hearth::command
{

/// Return a warning, texture_unmatched, for each rule of textures.image whose pattern matches the name of no
/// texture, and each of textures.role whose role none has, of the sources that it holds for. Sources
/// without statistics match whatever a rule says, since their textures are not known.
/// statistics  [sources] JSON of hearth-texels; nullopt: there is none
std::vector<Error> findUnmatchedTextures(const graph::CookSettings& settings,
                                         const std::vector<std::optional<std::string>>& statistics);

} // namespace hearth::command
