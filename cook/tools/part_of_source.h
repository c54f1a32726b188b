// Parses options that give a part to one of several sources, as --proxies 0=rock.proxy.part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <string>

namespace hearth::tools
{

struct PartOfSource
{
    size_t source; ///< index of the source
    std::string path;
};

/// Parse "N=PART", with the number of a source, counted from 0.
/// program, option  named by errors
/// errors: usage where the text has no number, one that is no source's, or no path
Result<PartOfSource> parsePartOfSource(const std::string& text, size_t source_count,
                                       const std::string& program, const std::string& option);

} // namespace hearth::tools
