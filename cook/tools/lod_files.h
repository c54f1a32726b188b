// Parses the names of authored LODs (X_LOD1) and the option --lod N=FILE.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::tools
{

struct LodName
{
    std::string stem; ///< lower case
    uint32_t level = 0;
};

/// Parse a name as "Rock_LOD2", which is level 2 of "rock"; nullopt for other names. The number has at most
/// three digits.
std::optional<LodName> parseLodName(std::string_view name);

/// Number and name that its author gave to a level.
struct LodLabel
{
    std::optional<uint32_t> number;
    std::string name; ///< file name without folders, or name of a node
};

struct LodFile
{
    uint32_t level = 1; ///< 1 is the first level after the source
    std::string path;
};

/// Parse options as "1=rock_low.glb", and sort them by level, ascending. Levels may have gaps, but no
/// duplicates.
/// errors: usage.
Result<std::vector<LodFile>> parseLodFiles(std::span<const std::string> options);

} // namespace hearth::tools
