// hearth extract --receivers: writes the light of receivers as a picture.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <string>

namespace hearth::command
{

/// Write the atlas of a pack or a receivers part with all lamps on. The end of the output's name selects:
/// EXR has irradiance, PNG the same as people see it.
/// errors: those of openContainer; chunk_missing without receivers; usage for another name; cannot_write
Status extractReceivers(const std::string& path, const std::string& output);

} // namespace hearth::command
