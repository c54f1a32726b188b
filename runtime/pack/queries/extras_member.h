// Finds a member in the extras of an object without parsing the rest.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string_view>

namespace hearth::pack
{

/// Return the text of the value of an object's member; empty if the text is no object, has no such member, or
/// is broken before its end. Bears any bytes. Time: linear; no recursion, no allocation.
/// json  text of the object; white space between tokens is allowed
/// name  compared with the text between the quotes, whose escapes stay as they are
std::string_view findMember(std::string_view json, std::string_view name);

} // namespace hearth::pack
