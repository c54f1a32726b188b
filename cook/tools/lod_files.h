// Levels of detail that somebody made by hand: their names, and the option --lod N=FILE.
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
    std::string stem; ///< in small letters
    uint32_t level = 0;
};

/// "Rock_LOD2" is level 2 of "rock"; nothing for other names. A number has three digits at most.
std::optional<LodName> parseLodName(std::string_view name);

/// The number and the name that an authored level got from whoever made it.
struct LodLabel
{
    std::optional<uint32_t> number;
    std::string name; ///< of a file without folders, or of a node
};

struct LodFile
{
    uint32_t level = 1; ///< 1 is the first after the source
    std::string path;
};

/// "1=rock_low.glb", ...: by level, ascending. Numbers may be left out, but not be there twice.
/// errors: usage.
Result<std::vector<LodFile>> parseLodFiles(std::span<const std::string> options);

} // namespace hearth::tools
