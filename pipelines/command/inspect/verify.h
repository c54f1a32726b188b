// hearth verify: checks that a file is a complete and valid container.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <string>

namespace hearth::command
{

/// Check a file, and return a line on its contents. errors: those of openContainer.
Result<std::string> verifyFile(const std::string& path);

/// Return the result as JSON, schema "hearth.verify/1", for valid and invalid files.
std::string verifyJson(const std::string& path, const Result<std::string>& result);

} // namespace hearth::command
