// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/file_version.h"

#include <sys/stat.h>

namespace hearth::viewer
{

std::optional<FileVersion> readFileVersion(const std::string& path)
{
    struct stat status;
    if (::stat(path.c_str(), &status) != 0)
        return std::nullopt;
    return FileVersion{status.st_dev, status.st_ino, static_cast<uint64_t>(status.st_size),
                       status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

} // namespace hearth::viewer
