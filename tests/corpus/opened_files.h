// Compares the files that the programs under test opened, as logged by the preloaded library, with those that
// they may open.
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

/// Read the records of the log at `path`; none if it cannot be read. "/proc/<number>/" becomes "/proc/self/".
std::vector<OpenedFile> readOpenLog(const std::string& path);

/// Folders that the programs may use, and files elsewhere that they open for any asset.
struct AllowedFiles
{
    std::string programs;         ///< folder, readable
    std::set<std::string> system; ///< files, readable
};

/// Return a sentence for each opened file that is not allowed. Allowed are the asset's folder (to read), the
/// folder `box` (to read and write), and `allowed`.
std::vector<std::string> trespasses(const std::vector<OpenedFile>& opened, const std::string& asset_folder,
                                    const std::string& box, const AllowedFiles& allowed);

/// Return the files of `opened` that lie in none of the three folders.
std::set<std::string> filesElsewhere(const std::vector<OpenedFile>& opened, const std::string& asset_folder,
                                     const std::string& box, const std::string& programs);

} // namespace hearth::corpus
