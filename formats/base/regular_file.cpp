// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/regular_file.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

namespace hearth
{

RegularFile::RegularFile(std::string path) : path_(std::move(path))
{
    // Without O_NONBLOCK opening a pipe waits for a writer.
    // Without O_NOCTTY a terminal may become that of the process.
    const int opened = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    const bool is_described = opened >= 0 && ::fstat(opened, &metadata_) == 0;
    if (is_described && S_ISREG(metadata_.st_mode))
    {
        descriptor_ = opened;
        return;
    }
    // ENXIO: a socket, or a device without a driver
    error_ = is_described || errno == ENXIO ? ENOTSUP : errno;
    if (opened >= 0)
        ::close(opened);
}

RegularFile::RegularFile(RegularFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      error_(other.error_),
      metadata_(other.metadata_)
{
}

RegularFile::~RegularFile()
{
    const int error = errno;
    if (descriptor_ >= 0)
        ::close(descriptor_);
    errno = error;
}

Status RegularFile::status() const
{
    if (isOpen())
        return success();
    if (error_ == ENOTSUP)
        return Error{Issue::input_missing, path_, "", "is not a regular file"};
    return Error{Issue::input_missing, path_, "", std::string("cannot open: ") + std::strerror(error_)};
}

ssize_t RegularFile::read(std::span<std::byte> out) const
{
    size_t filled = 0;
    while (filled < out.size())
    {
        const ssize_t count = ::read(descriptor_, out.data() + filled, out.size() - filled);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return -1;
        if (count == 0)
            break;
        filled += static_cast<size_t>(count);
    }
    return static_cast<ssize_t>(filled);
}

Result<std::string> RegularFile::readText(uint64_t max_bytes) const
{
    HEARTH_TRY(status());
    if (size() > max_bytes)
        return Error{Issue::input_too_large, path_, "",
                     std::to_string(size()) + " bytes; at most " + std::to_string(max_bytes) + " are read"};
    std::string text(static_cast<size_t>(size()), '\0');
    const ssize_t filled = read(std::as_writable_bytes(std::span(text)));
    if (filled < 0)
        return Error{Issue::read_failed, path_, "", std::string("cannot read: ") + std::strerror(errno)};
    text.resize(static_cast<size_t>(filled));
    return text;
}

Result<RegularFile> openRegular(const std::string& path)
{
    RegularFile file(path);
    HEARTH_TRY(file.status());
    return file;
}

Result<std::string> readFile(const std::string& path, uint64_t max_bytes)
{
    return RegularFile(path).readText(max_bytes);
}

} // namespace hearth
