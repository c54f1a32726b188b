// Imports glTF 2.0 and GLB.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"
#include "pipelines/import/source/file_bytes.h"

#include <string>

namespace hearth::import
{

/// Import glTF 2.0 or GLB, with the files that it refers to in the same folder or below.
Status importGltf(const std::string& path, const FileBytes& file, const ImportOptions& options,
                  PartBuilder& part);

} // namespace hearth::import
