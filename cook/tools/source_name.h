// Reads the name of a source from its import part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <string>

namespace hearth::tools
{

/// Return the name of the source's file as the part's META has it, for messages; empty if it has none.
std::string readSourceName(const formats::PackView& import_part);

} // namespace hearth::tools
