// Shows all pictures and heat maps of the bench on one page.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "tests/picture/market_night.h"

namespace hearth::picture
{

/// Return an HTML document that needs no other file.
/// errors: cannot_write, input_missing: images become PNG through temporary files.
Result<std::string> makePage(const std::vector<SceneResult>& results,
                             const std::vector<NightComparison>& nights, const std::string& folder);

} // namespace hearth::picture
