// Imports scanned meshes: OBJ, PLY, STL, OFF and Draco.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"

#include <cstddef>
#include <span>
#include <string>

namespace hearth::import
{

/// Import OBJ (+ MTL), PLY, STL, OFF, or bare Draco (.drc): one mesh, one node, one instance.
Status importScan(const std::string& path, std::span<const std::byte> bytes, const ImportOptions& options,
                  PartBuilder& part);

} // namespace hearth::import
