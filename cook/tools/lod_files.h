// The option --lod N=FILE: a file that is a level of detail of a source.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/result.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace hearth::tools
{

struct LodFile
{
    uint32_t level = 1; ///< 1 is the first after the source
    std::string path;
};

/// "1=rock_low.glb", ...: by level, ascending. Numbers may be left out, but not be there twice.
/// errors: usage.
Result<std::vector<LodFile>> parseLodFiles(std::span<const std::string> options);

} // namespace hearth::tools
