// Shared helpers of tests of scan readers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/import/scans/scan_polygons.h"

#include <string>

namespace hearth::import::test
{

using ScanReader = Result<ScanPolygons> (*)(const ScanSource&);

inline Result<ScanPolygons> readText(ScanReader reader, std::string_view text,
                                     const ImportLimits& limits = {})
{
    const std::string path = "scan";
    return reader({std::as_bytes(std::span(text)), path, limits});
}

/// File that must be rejected, and the expected error.
struct RefusedFile
{
    const char* name;
    std::string text;
    Issue issue;
    const char* where;
};

/// "error 1200 at line 3", or "read".
inline std::string outcome(const Result<ScanPolygons>& result)
{
    if (result.ok())
        return "read";
    return "error " + std::to_string(static_cast<unsigned>(result.error().issue)) + " at " +
           result.error().where;
}

inline std::string outcome(const RefusedFile& file)
{
    return "error " + std::to_string(static_cast<unsigned>(file.issue)) + " at " + file.where;
}

inline bool hasNote(const ScanPolygons& file, Issue issue, std::string_view part)
{
    for (const ScanNote& note : file.notes)
        if (note.issue == issue && note.detail.find(part) != std::string::npos)
            return true;
    return false;
}

} // namespace hearth::import::test
