// Finds the sky that the sources of a pack bring along: the image-based light of a scene.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

#include <span>

namespace hearth::tools
{

/// Return the import part whose probe is the sky of the pack; null if none has one. Sources that bring
/// the same sky agree.
/// errors: profile_value if two of them differ
Result<const formats::PackView*> findSourceSky(std::span<const formats::PackView* const> import_parts);

} // namespace hearth::tools
