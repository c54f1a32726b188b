// Temporary directory of this process, removed when it exits.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <string>

namespace hearth
{

class TempDirectory
{
public:
    /// Create a folder in `parent`, which must exist. Folders in `parent` left by killed processes of this
    /// user are removed: each folder holds a lock as long as its process lives.
    /// errors: cannot_write, naming `for_output`.
    static Result<TempDirectory> create(const std::string& parent, const std::string& for_output);

    TempDirectory(TempDirectory&& other) noexcept : path_(std::move(other.path_)), lock_(other.lock_)
    {
        other.path_.clear();
        other.lock_ = -1;
    }
    TempDirectory& operator=(TempDirectory&&) = delete;
    /// Remove the folder and its contents.
    ~TempDirectory();

    const std::string& path() const { return path_; }

private:
    TempDirectory(std::string path, int lock) : path_(std::move(path)), lock_(lock) {}
    std::string path_;
    int lock_ = -1; ///< lock of a file in the folder
};

/// Return the folder of a file: "." for a bare name.
std::string parentFolder(const std::string& path);

/// Return the user's folder for temporary files: TMPDIR, or `otherwise` if that is not set.
std::string temporaryFolderOr(const std::string& otherwise);

} // namespace hearth
