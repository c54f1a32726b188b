// Suggests the path that a pattern was meant to match where it matches none.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <optional>
#include <span>
#include <string>

namespace hearth::profiles
{

struct NearestPath
{
    std::string path;
    std::string pattern; ///< like the given one, and matches the path; empty: none is alike
};

/// The path that a pattern misses by least, of those that it does not match. A pattern is alike that starts
/// in another folder ("assets/props/**" for "props/**"), has slashes for backslashes, or the path's ending:
/// ".gl*" where glTF is meant.
/// returns  nothing where there are no paths. Of very many only the first are looked at.
std::optional<NearestPath> nearestPath(const std::string& pattern, std::span<const std::string> paths);

} // namespace hearth::profiles
