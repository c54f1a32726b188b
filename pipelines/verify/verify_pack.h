// Checks packs on all cores: what formats/ checks, which starts no threads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"

namespace hearth::verify
{

/// formats::checkPack, with the same answer.
Status verifyPack(const formats::PackView& view);

} // namespace hearth::verify
