// A folder of this process alone, gone when it goes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <string>

namespace hearth
{

class TempDirectory
{
public:
    /// A new folder in `parent`, which must exist. Those in it that killed processes of this user have left are removed:
    /// each holds a lock as long as its process lives.
    /// errors: cannot_write, naming `for_output`.
    static Result<TempDirectory> create(const std::string& parent, const std::string& for_output);

    TempDirectory(TempDirectory&& other) noexcept : path_(std::move(other.path_)), lock_(other.lock_)
    {
        other.path_.clear();
        other.lock_ = -1;
    }
    TempDirectory& operator=(TempDirectory&&) = delete;
    /// Removes the folder with all that is in it.
    ~TempDirectory();

    const std::string& path() const { return path_; }

private:
    TempDirectory(std::string path, int lock) : path_(std::move(path)), lock_(lock) {}
    std::string path_;
    int lock_ = -1; ///< of a file in it
};

/// The folder that a file lies in: "." for a bare name.
std::string parentFolder(const std::string& path);

/// Where the user keeps temporary files: TMPDIR, or `otherwise` where that is not set.
std::string temporaryOr(const std::string& otherwise);

} // namespace hearth
