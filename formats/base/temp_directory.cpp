// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/temp_directory.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hearth
{

namespace
{

constexpr std::string_view kFolderPrefix = ".hearth-";
constexpr const char* kLockFileName = "/lock";

/// Create a locked file in the new folder. It gets its final name only after it is locked. -1 if the file
/// system has no locks.
int lockFolder(const std::string& folder)
{
    const std::string unlocked = folder + kLockFileName + ".new";
    const int file = ::open(unlocked.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file < 0)
        return -1;
    if (::flock(file, LOCK_EX | LOCK_NB) == 0)
        ::rename(unlocked.c_str(), (folder + kLockFileName).c_str());
    return file;
}

bool isAbandoned(const std::string& folder)
{
    struct stat info = {};
    if (::lstat(folder.c_str(), &info) != 0 || !S_ISDIR(info.st_mode) || info.st_uid != ::geteuid())
        return false;
    const int file = ::open((folder + kLockFileName).c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW);
    const bool abandoned = file >= 0 && ::flock(file, LOCK_EX | LOCK_NB) == 0;
    if (file >= 0)
        ::close(file);
    return abandoned;
}

/// Remove a folder, its lock last. If the removal itself is killed, or an orphaned cooker still writes into
/// the folder, the next process still recognises the folder.
void removeFolder(const std::string& folder)
{
    // nothing more can be done about a folder that cannot be removed, and the work itself is done
    std::error_code error;
    std::error_code ignored;
    for (auto at = std::filesystem::directory_iterator(folder, error);
         !error && at != std::filesystem::directory_iterator(); at.increment(error))
        if (at->path().filename() != kLockFileName + 1)
            std::filesystem::remove_all(at->path(), ignored);
    ::unlink((folder + kLockFileName).c_str());
    if (::rmdir(folder.c_str()) != 0)
        if (const int lock = ::open((folder + kLockFileName).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
            lock >= 0)
            ::close(lock);
}

void removeAbandoned(const std::string& parent)
{
    std::error_code error;
    for (auto at = std::filesystem::directory_iterator(parent, error);
         !error && at != std::filesystem::directory_iterator(); at.increment(error))
        if (at->path().filename().string().starts_with(kFolderPrefix) && isAbandoned(at->path().string()))
            removeFolder(at->path().string());
}

} // namespace

Result<TempDirectory> TempDirectory::create(const std::string& parent, const std::string& for_output)
{
    removeAbandoned(parent);
    std::string path = parent + "/" + std::string(kFolderPrefix) + "XXXXXX";
    if (::mkdtemp(path.data()) == nullptr)
        return Error{Issue::cannot_write, for_output, "",
                     "cannot make a temporary folder in " + parent + ": " + std::strerror(errno)};
    const int lock = lockFolder(path);
    return TempDirectory(std::move(path), lock);
}

TempDirectory::~TempDirectory()
{
    if (!path_.empty())
        removeFolder(path_);
    if (lock_ >= 0)
        ::close(lock_);
}

std::string parentFolder(const std::string& path)
{
    const std::string folder = std::filesystem::path(path).parent_path().string();
    return folder.empty() ? "." : folder;
}

std::string temporaryFolderOr(const std::string& otherwise)
{
    const char* temporary = std::getenv("TMPDIR");
    return temporary != nullptr && *temporary != '\0' ? temporary : otherwise;
}

} // namespace hearth
