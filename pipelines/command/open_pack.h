// Opens a pack for the commands that read one: nothing in it is trusted before it is checked.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack_view.h"

#include <string>

namespace hearth::command
{

/// Map the file and check all of it: container, hashes, and for packs the meaning of every record.
/// errors: those of ContainerReader::open, PackView::read and checkPack.
Result<formats::PackView> openPack(const std::string& path);

} // namespace hearth::command
