// Uses std::vector without its header, which headers_alone.sh must notice.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

using OtherNumbers = std::vector<long>;
