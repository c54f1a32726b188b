// Chooses the reader of a source by its content and name.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/part/import_options.h"
#include "pipelines/import/part/part_builder.h"

#include <string>

namespace hearth::import
{

/// Read a source of any kind into the part. errors: input_missing, and those of the readers.
Status readSource(const std::string& path, const ImportOptions& options, PartBuilder& part);

} // namespace hearth::import
