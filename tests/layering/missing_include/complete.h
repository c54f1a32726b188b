// Includes all that it uses. headers_alone.sh checks it before the other header of this folder.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <vector>

using Numbers = std::vector<int>;
