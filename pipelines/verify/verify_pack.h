// Runs the pack checks of formats/, which start no threads, on all cores, and checks what only tools need.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

namespace hearth::verify
{

/// Check a pack as formats::checkPack does, with the same result, and then that its extras are JSON.
/// errors: those of checkPack; meaning_value and meaning_range at "extras 3".
Status verifyPack(const formats::PackView& view);

} // namespace hearth::verify
