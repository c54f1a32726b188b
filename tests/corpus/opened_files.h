// What the programs under test opened, as the preloaded library wrote it down, held against what they may open.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <set>
#include <string>
#include <vector>

namespace hearth::corpus
{

struct OpenedFile
{
    char kind = 0; ///< see tests/corpus/open_log.h
    std::string path;
};

/// The records of the log at `path`; none where there is no log. "/proc/<number>/" reads as "/proc/self/".
std::vector<OpenedFile> readOpenLog(const std::string& path);

/// Folders that the programs may use, and the files elsewhere that they open whatever the asset says.
struct AllowedFiles
{
    std::string programs;         ///< folder, to read
    std::set<std::string> system; ///< files, to read
};

/// The opened files that are none of the programs' business: one sentence each. Allowed are the asset's folder (to
/// read), the folder `box` (to read and write), and `allowed`.
std::vector<std::string> trespasses(const std::vector<OpenedFile>& opened, const std::string& asset_folder,
                                    const std::string& box, const AllowedFiles& allowed);

/// The files of `opened` that lie in none of the three folders.
std::set<std::string> filesElsewhere(const std::vector<OpenedFile>& opened, const std::string& asset_folder,
                                     const std::string& box, const std::string& programs);

} // namespace hearth::corpus
