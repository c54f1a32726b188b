// hearth explain: what an issue's number means.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <string>
#include <string_view>

namespace hearth::command
{

/// `code` as messages write it ("E1203", "W1400") or the bare number; empty: the list of all.
/// errors: usage where there is no such issue.
Result<std::string> explain(std::string_view code);

/// The exit codes of all programs, as a table for the help.
std::string exitCodeTable();

} // namespace hearth::command
