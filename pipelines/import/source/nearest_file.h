// Suggests the file that an asset means where the one that it names is not there.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hearth::import
{

/// The names of the files in a folder and below it, as they were when it was listed. Links to folders are not
/// followed, and no file is opened.
class FileNames
{
public:
    /// folder  ends with '/'. Of one with very many files only the first are known.
    explicit FileNames(const std::string& folder);

    /// The file that is nearest to a path that leads nowhere: the same but for '\' or the case of letters,
    /// else of the same name in another folder, else an image of the same name and another format, else one
    /// in the same folder whose name is a slip away.
    /// path     relative to the folder
    /// returns  "textures/wood.png" in quotes and how it differs, for a message; empty where none is near,
    ///          and where the file is there: something else is wrong with it
    std::string suggest(std::string_view path) const;

private:
    std::string suggestBySlip(const std::string& wanted) const;

    std::vector<std::string> paths_; ///< relative to the folder, sorted
};

} // namespace hearth::import
