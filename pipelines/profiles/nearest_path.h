// Suggests the path that a pattern was meant to match, for patterns that match none.
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
    std::string pattern; ///< corrected pattern, which matches the path; empty: no similar pattern does
};

/// Find the path that a pattern misses by least. Similar patterns start in another folder ("assets/props/**"
/// for "props/**"), have slashes for backslashes, or the path's extension (".gl*" where glTF is meant).
/// paths    that the pattern does not match; only the first 2000 are tried
/// returns  nullopt where there are no paths
std::optional<NearestPath> nearestPath(const std::string& pattern, std::span<const std::string> paths);

} // namespace hearth::profiles
