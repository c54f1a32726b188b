// Checks the counts that Draco data claim.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace hearth::import
{

/// Hold the numbers of points and faces that Draco data claim against the size of the data: the library
/// allocates memory for them before it decodes. Return a description of a claim that cannot be true, or
/// nullopt. Data without readable counts are left to the library.
std::optional<std::string> findImpossibleDracoCount(std::span<const std::byte> bytes);

} // namespace hearth::import
