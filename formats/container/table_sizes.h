// Limits how many bytes the tables of a container decode to. Readers and writers share the check, so that
// everything that is written can be read, and a small file cannot claim the memory of the machine.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"
#include "formats/records/container.h"

#include <span>
#include <string>

namespace hearth::formats
{

/// Check the sizes of all tables of a file: chunks of known types, except those with one for each mesh or
/// image and chunk PAGE, which are decoded one by one. Looks at the chunk table only, so it costs nothing to
/// refuse a file. See FORMAT.md, "Sizes of tables".
/// errors: `issue`, naming `file` and the largest table.
Status checkTableSizes(std::span<const ChunkEntry> chunks, Issue issue, const std::string& file);

} // namespace hearth::formats
