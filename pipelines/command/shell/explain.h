// hearth explain: describes an issue by its number.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <string>
#include <string_view>

namespace hearth::command
{

/// Return the description of an issue. `code` is written as in messages ("E1203", "W1400"), or the bare
/// number; empty: list all.
/// errors: usage if there is no such issue.
Result<std::string> explain(std::string_view code);

/// Return the exit codes of all programs, as a table for the help.
std::string exitCodeTable();

} // namespace hearth::command
