// What hearth-clusters reads: an import part, or a source that hearth-import reads first.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/container/container_reader.h"

#include <optional>
#include <span>
#include <string>

namespace hearth::clusters
{

struct SourcePart
{
    std::optional<formats::ContainerReader> part; ///< nothing on failure
    int exit_code = 0;                            ///< of the process, on failure
};

/// What hearth-import is told, where it runs; an import part has been told before.
struct ImportArguments
{
    std::span<const std::string> lods;     ///< "N=FILE"
    std::string profile;                   ///< empty: none
    std::span<const std::string> settings; ///< of --set, where there is no profile
};

/// Open an import part; a file that is no container goes through the program hearth-import beside this one, into a
/// folder that is gone when this returns: what is open stays readable. Problems are told on stderr.
///
/// output  names the folder for temporary files where TMPDIR does not
SourcePart openSourcePart(const std::string& path, const ImportArguments& arguments,
                          const std::string& output);

} // namespace hearth::clusters
