// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/file_output.h"

#include <cerrno>
#include <cstring>
#include <sys/stat.h>
#include <unistd.h>

namespace hearth::viewer
{

namespace
{

bool writeAll(int file, std::span<const std::byte> bytes)
{
    while (!bytes.empty())
    {
        const ssize_t written = ::write(file, bytes.data(), bytes.size());
        if (written < 0 && errno == EINTR)
            continue;
        if (written <= 0)
            return false;
        bytes = bytes.subspan(static_cast<size_t>(written));
    }
    return true;
}

} // namespace

Status writeFile(const std::string& path, std::span<const std::byte> bytes)
{
    std::string temporary = path + ".tmp-XXXXXX";
    const int file = ::mkstemp(temporary.data());
    if (file < 0)
        return Error{Issue::cannot_write, path, "", std::string("cannot create: ") + std::strerror(errno)};
    // mkstemp makes a private file; an output should have the permissions that the user's umask gives
    const mode_t mask = ::umask(0);
    ::umask(mask);
    const bool written = writeAll(file, bytes) && ::fchmod(file, 0666 & ~mask) == 0 && ::fsync(file) == 0;
    const int reason = errno;
    ::close(file);
    if (written && ::rename(temporary.c_str(), path.c_str()) == 0)
        return success();
    const std::string detail = std::string("cannot write: ") + std::strerror(written ? errno : reason);
    ::unlink(temporary.c_str());
    return Error{Issue::cannot_write, path, "", detail};
}

} // namespace hearth::viewer
