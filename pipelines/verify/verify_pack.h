// Runs the pack checks of formats/, which start no threads, on all cores.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

namespace hearth::verify
{

/// Check a pack as formats::checkPack does, with the same result.
Status verifyPack(const formats::PackView& view);

} // namespace hearth::verify
