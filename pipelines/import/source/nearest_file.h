// Suggests an existing file for an asset that names a missing one.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hearth::import
{

/// Names of the files in a folder and its sub-folders at the time of listing. Links to folders are not
/// followed, and no file is opened.
class FileListing
{
public:
    /// folder  ends with '/'; of a very large folder only the first files are listed
    explicit FileListing(const std::string& folder);

    /// Find the file nearest to a path that does not exist: the same but for '\' or letter case, else the
    /// same name in another folder, else an image of the same name and another format, else a file in the
    /// same folder whose name differs by a typing error.
    /// path     relative to the folder
    /// returns  "textures/wood.png" in quotes and the difference, for a message; empty if no file is near, or
    ///          if the file exists: then something else is wrong with it
    std::string suggest(std::string_view path) const;

private:
    std::string suggestByTypo(const std::string& wanted) const;

    std::vector<std::string> paths_; ///< relative to the folder, sorted
};

} // namespace hearth::import
