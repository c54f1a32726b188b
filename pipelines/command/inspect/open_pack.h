// Opens a pack for the commands that read one: nothing in it is trusted before it is checked.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <string>

namespace hearth::command
{

/// Map the file and check all of it: the container, every hash, and for a pack the meaning of every record.
/// A part is opened as well: its tables are safe to read, but of what they mean only bricks are checked, which stand alone.
/// errors: those of ContainerReader::open, PackView::read, checkPack and checkBricks.
Result<formats::PackView> openContainer(const std::string& path);

/// The same for packs alone. errors: container_kind where it is a part.
Result<formats::PackView> openPack(const std::string& path);

} // namespace hearth::command
