// Reads regular files. Pipes, sockets, devices and folders are refused: no read waits for another process.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <sys/stat.h>
#include <sys/types.h>
#include <utility>

namespace hearth
{

/// Maximum size of a text that is read whole: settings, plans, reports and tables are smaller.
inline constexpr uint64_t kMaxTextBytes = uint64_t{1} << 30;

/// Regular file, open for reading and closed by the destructor.
class RegularFile
{
public:
    /// Open a regular file, or a link to one, without waiting. status() says whether it is open.
    explicit RegularFile(std::string path);
    RegularFile(RegularFile&& other) noexcept;
    RegularFile& operator=(RegularFile&&) = delete;
    ~RegularFile();

    bool isOpen() const { return descriptor_ >= 0; }
    /// Return the errno of opening: 0 if the file is open, ENOTSUP if it is not a regular file.
    int openError() const { return error_; }
    /// Return the result of opening. errors: input_missing, naming the path.
    Status status() const;

    // The members below need an open file.

    int descriptor() const { return descriptor_; }
    /// Give the descriptor to the caller, who closes it.
    int release() { return std::exchange(descriptor_, -1); }
    /// Return identity, size and times of the file when it was opened.
    const struct stat& metadata() const { return metadata_; }
    uint64_t size() const { return static_cast<uint64_t>(metadata_.st_size); }

    /// Read the next bytes. Return their number, which is less than that of `out` only at the end of the
    /// file; -1 on error, with errno set.
    ssize_t read(std::span<std::byte> out) const;

    /// Read the whole file as readFile() does; fails as status() does if the file is not open.
    Result<std::string> readText(uint64_t max_bytes = kMaxTextBytes) const;

private:
    std::string path_;
    int descriptor_ = -1;
    int error_ = 0;
    struct stat metadata_ = {};
};

/// Open a regular file. errors: input_missing, naming the path.
Result<RegularFile> openRegular(const std::string& path);

/// Read a whole regular file of at most `max_bytes`. A file that shrinks meanwhile is read as far as it goes.
/// errors: input_missing, input_too_large, read_failed, naming the path.
Result<std::string> readFile(const std::string& path, uint64_t max_bytes = kMaxTextBytes);

} // namespace hearth
