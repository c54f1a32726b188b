// Reads proxies from files, as listed by hearth-import --proxy.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_proxies.h"

#include <span>
#include <string>
#include <vector>

namespace hearth::import
{

/// Read the files as sources, one after the other, through a temporary part in `temporary_folder`. All that a
/// file draws is the proxy, in the place where it draws it; nodes and meshes called UCX_X are convex parts.
/// Materials are kept by their names.
///
/// words   "MESH=FILE", or "FILE" for the only mesh; files are in the folder of `source`, by relative paths
/// source  exists
/// part    gets the sources and warnings of the files
/// errors  usage, those of AssetFolder::locate and of readSource
Result<std::vector<FileProxies>> readProxyFiles(std::span<const std::string> words, const std::string& source,
                                                const std::string& temporary_folder,
                                                const ImportOptions& options, PartBuilder& part);

} // namespace hearth::import
