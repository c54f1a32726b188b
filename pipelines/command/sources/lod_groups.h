// Groups sources: which files are levels of detail of others, by their names or by rules of hearth.toml.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "pipelines/profiles/configuration.h"

#include <string>
#include <vector>

namespace hearth::command
{

struct LodGroups
{
    std::vector<std::string> sources; ///< the files that are no levels of others, in their order
    std::vector<std::vector<std::string>> lods_of_source; ///< [sources.size()]: levels as "N=FILE"
    std::vector<Error> warnings;                          ///< lod_repeated
};

/// Find the levels of detail among the files of a cook.
/// - Where import.lods is set for a file, these files, from its folder, are its levels 1, 2, ...; none: it stands alone.
/// - Models of one folder called X_LOD0, X_LOD1, ..., whatever their extensions and the case of their letters, are one source
///   and its levels. Without a level 0 they are sources, each of its own. Of two that are the same level the first is used;
///   a warning names both.
/// files   as people typed them, or as folders and patterns gave them
/// errors  profile_value where import.lods makes a file a level of itself, or of another level
Result<LodGroups> groupLods(const std::vector<std::string>& files,
                            const profiles::Configuration& configuration);

} // namespace hearth::command
