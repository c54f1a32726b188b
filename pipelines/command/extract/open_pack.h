// Opens a pack for the verbs that read one. Nothing in it is trusted before it is checked.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <string>

namespace hearth::command
{

/// Map the file and check all of it: the container, every hash, and for a pack the meaning of every
/// record. A part is opened as well: its tables are safe to read, but only the meaning of its bricks,
/// receivers and proxies is checked, which need no other tables.
/// errors: those of ContainerReader::open, PackView::read, checkPack, checkBricks, checkReceivers and
/// checkProxies.
Result<formats::PackView> openContainer(const std::string& path);

/// Same, for packs only. errors: container_kind if the file is a part.
Result<formats::PackView> openPack(const std::string& path);

/// Check that a mesh exists. errors: usage
Status checkMesh(const formats::PackView& pack, const std::string& path, uint32_t mesh);

} // namespace hearth::command
