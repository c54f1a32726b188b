// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/source/file_bytes.h"

#include "formats/base/hash_stream.h"
#include "formats/base/regular_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <sys/mman.h>
#include <utility>

namespace hearth::import
{

namespace
{

// Smaller files are copied: nobody can change or truncate a copy, and it costs no more than the mapping.
constexpr size_t kMinMappedBytes = size_t{64} << 20;
constexpr size_t kPieceBytes = size_t{16} << 20;

bool isSame(const struct stat& a, const struct stat& b)
{
    return a.st_ino == b.st_ino && a.st_size == b.st_size && a.st_mtim.tv_sec == b.st_mtim.tv_sec &&
           a.st_mtim.tv_nsec == b.st_mtim.tv_nsec;
}

Error failure(Issue issue, const std::string& path, std::string detail)
{
    return {issue, path, "", std::move(detail)};
}

Result<std::vector<std::byte>> readCopy(const RegularFile& file, const std::string& path)
{
    std::vector<std::byte> bytes(static_cast<size_t>(file.size()));
    const ssize_t filled = file.read(bytes);
    if (filled < 0)
        return failure(Issue::read_failed, path, std::strerror(errno));
    if (static_cast<size_t>(filled) < bytes.size())
        return failure(Issue::read_failed, path, "the file shrank while it was read");
    return bytes;
}

} // namespace

Result<FileBytes> FileBytes::read(const std::string& path, uint64_t max_bytes)
{
    HEARTH_ASSIGN_OR_RETURN(const RegularFile file, openRegular(path));
    if (file.size() > max_bytes)
        return failure(Issue::input_too_large, path,
                       std::to_string(file.size()) + " bytes, at most " + std::to_string(max_bytes) +
                           " are read");

    const auto size = static_cast<size_t>(file.size());
    if (size >= kMinMappedBytes)
        if (void* at = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.descriptor(), 0); at != MAP_FAILED)
        {
            FileBytes mapping{std::vector<std::byte>()};
            mapping.mapped_ = {static_cast<const std::byte*>(at), size};
            mapping.path_ = path;
            mapping.stat_at_open_ = file.metadata();
            return mapping;
        }
    HEARTH_ASSIGN_OR_RETURN(std::vector<std::byte> bytes, readCopy(file, path));
    return FileBytes(std::move(bytes));
}

FileBytes::FileBytes(FileBytes&& other) noexcept
    : owned_(std::move(other.owned_)),
      mapped_(std::exchange(other.mapped_, {})),
      path_(std::move(other.path_)),
      stat_at_open_(other.stat_at_open_)
{
}

FileBytes::~FileBytes()
{
    if (!mapped_.empty())
        ::munmap(const_cast<std::byte*>(mapped_.data()), mapped_.size());
}

uint64_t FileBytes::hash() const
{
    std::span<const std::byte> rest = bytes();
    return hashStream(
        [&]
        {
            releasePages();
            const std::span<const std::byte> piece = rest.first(std::min(rest.size(), kPieceBytes));
            rest = rest.subspan(piece.size());
            return piece;
        });
}

void FileBytes::releasePages() const
{
    if (!mapped_.empty())
        ::madvise(const_cast<std::byte*>(mapped_.data()), mapped_.size(), MADV_DONTNEED);
}

Status FileBytes::checkUnchanged() const
{
    struct stat now = {};
    if (mapped_.empty() || (::stat(path_.c_str(), &now) == 0 && isSame(now, stat_at_open_)))
        return success();
    return failure(Issue::read_failed, path_, "the file changed while it was read");
}

} // namespace hearth::import
