// Formats a list of names for a line of text: the first few, and how many more there are.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <vector>

namespace hearth::command
{

/// Return "a.glb", "a.glb, b.glb", or "a.glb, b.glb, c.glb and 9 more"; empty if there are no names.
std::string namesText(const std::vector<std::string>& names);

} // namespace hearth::command
