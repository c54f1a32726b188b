// Opens the input of hearth-clusters: an import part, or a source that hearth-import reads first.
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
    int exit_code = 0;                            ///< exit code of the process, on failure
};

/// Arguments for hearth-import, if it runs; an import part has had its own.
struct ImportArguments
{
    std::span<const std::string> lods;     ///< "N=FILE"
    std::string profile;                   ///< empty: none
    std::span<const std::string> settings; ///< of --set, if there is no profile
};

/// Open an import part. Any other file goes through the program hearth-import beside this one, into a
/// temporary directory that is removed when this returns; the opened part stays readable. Reports errors on
/// stderr.
///
/// output  its folder is used for temporary files if TMPDIR is not set
SourcePart openSourcePart(const std::string& path, const ImportArguments& arguments,
                          const std::string& output);

} // namespace hearth::clusters
