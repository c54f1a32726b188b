// Adds authored levels of detail from files, as listed by hearth-import --lod.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/lod_files.h"
#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"

#include <span>
#include <string>

namespace hearth::import
{

/// Add each file's mesh, with its materials and images, as the next level of the one mesh that the part draws
/// so far. The files are read as sources, one after the other, through a temporary part in `folder`.
///
/// files    by level, finest first
/// errors   lod_file if the part or a file does not draw one mesh in one place, and those of readSource
Status addAuthoredLods(std::span<const tools::LodFile> files, const std::string& folder,
                       const ImportOptions& options, PartBuilder& part);

} // namespace hearth::import
