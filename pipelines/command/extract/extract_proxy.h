// hearth extract --proxy: writes the proxy of a mesh as plain triangles.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstdint>
#include <string>

namespace hearth::command
{

/// Write proxy `proxy` of a pack or a proxy part, in the object space of its mesh. The end of the
/// output's name selects: PLY is binary; OBJ has a group for each section, with the name of its material.
/// errors: those of openContainer; usage for another name, or if there is no such proxy; chunk_missing
/// without proxies; cannot_write
Status extractProxy(const std::string& path, uint32_t proxy, const std::string& output);

} // namespace hearth::command
