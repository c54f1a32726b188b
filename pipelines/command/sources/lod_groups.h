// Groups files into sources and their LODs, by their names or by rules of hearth.toml.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/profiles/configuration.h"

#include <string>
#include <vector>

namespace hearth::command
{

/// Sources of a cook with their LODs.
struct LodGroups
{
    std::vector<std::string> sources; ///< files that are no levels of others, in their order
    std::vector<std::vector<std::string>> lods_of_source; ///< [sources.size()]: levels as "N=FILE"
    std::vector<Error> warnings;                          ///< lod_repeated
};

/// Find the LODs among the files of a cook.
/// - If import.lods is set for a file, the files it lists, relative to the file's folder, are its levels 1,
///   2, ...; an empty list: it has no levels.
/// - Models of one folder called X_LOD0, X_LOD1, ..., with any extensions and in any case, are one source and
///   its levels. Without a level 0, each is a source of its own. If two have the same level, the first is
///   used, and a warning names both.
/// files   as people typed them, or as folders and patterns gave them
/// errors: profile_value if import.lods makes a file a level of itself, or of another level
Result<LodGroups> groupLods(const std::vector<std::string>& files,
                            const profiles::Configuration& configuration);

} // namespace hearth::command
