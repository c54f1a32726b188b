// From an import part to a clusters part: the hierarchy of every mesh, one mesh in memory at a time.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/clusters/hierarchy.h"
#include "formats/result.h"

#include <string>

namespace hearth::clusters
{

/// Build the hierarchies of all meshes of the part at `import_path` and write them to `output_path`.
/// Adds up what happened in `counts`.
/// errors: those of ContainerReader, readSourceMesh and ContainerWriter; input_too_large where an index would not fit.
Status writeClustersPart(const std::string& import_path, const std::string& output_path, const Config& config,
                         BuildCounts& counts);

} // namespace hearth::clusters
