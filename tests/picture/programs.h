// Runs the programs of this bench, and reads what they leave.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <string>
#include <vector>

namespace hearth::picture
{

/// Return the content of a file; nothing if there is none.
std::string readBytes(const std::string& path);

/// Run a program, without a shell, and wait for it. errors: child_failed, with its messages.
Status runProgram(const std::vector<std::string>& command);

} // namespace hearth::picture
