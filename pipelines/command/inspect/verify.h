// hearth verify: whether a file is a whole and meaningful container.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <string>

namespace hearth::command
{

/// One line that says what was found to be right. errors: those of openContainer.
Result<std::string> verifyFile(const std::string& path);

/// Schema "hearth.verify/1", for a file that is right and for one that is not.
std::string verifyJson(const std::string& path, const Result<std::string>& result);

} // namespace hearth::command
