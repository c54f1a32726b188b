// Opens a part that an earlier cooker has written.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <string>

namespace hearth::tools
{

/// Open and read a part.
/// errors: container_kind for a pack; those of ContainerReader::open and PackView::read
Result<formats::PackView> openPart(const std::string& path);

} // namespace hearth::tools
