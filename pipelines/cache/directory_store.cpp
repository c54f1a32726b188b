// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cache/directory_store.h"

#include "formats/base/regular_file.h"

#include <cerrno>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <linux/fs.h>
#include <random>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace hearth::cache
{

namespace
{

// The file's modification time records its last use, at most once a day: data used daily is never the oldest,
// and most cooks write nothing.
constexpr time_t kNoteUseEvery_s = 24 * 60 * 60;

class File
{
public:
    explicit File(int number) : number_(number) {}
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    ~File()
    {
        const int error = errno;
        if (number_ >= 0)
            ::close(number_);
        errno = error;
    }
    int number() const { return number_; }
    bool isOpen() const { return number_ >= 0; }

private:
    int number_;
};

bool writeAll(int file, const char* bytes, size_t size)
{
    while (size > 0)
    {
        const ssize_t written = ::write(file, bytes, size);
        if (written < 0 && errno == EINTR)
            continue;
        if (written < 0)
            return false;
        bytes += written;
        size -= static_cast<size_t>(written);
    }
    return true;
}

bool copyBytes(const RegularFile& from, int to)
{
    // copy-on-write copy (reflink) on btrfs and xfs; has no effect elsewhere
    if (::ioctl(to, FICLONE, from.descriptor()) == 0)
        return true;
    std::string piece(size_t{1} << 20, '\0');
    for (;;)
    {
        const ssize_t size = from.read(std::as_writable_bytes(std::span(piece)));
        if (size <= 0)
            return size == 0;
        if (!writeAll(to, piece.data(), static_cast<size_t>(size)))
            return false;
    }
}

bool createFolder(const std::string& path)
{
    std::error_code error;
    std::filesystem::create_directories(path, error);
    errno = error.value();
    return !error;
}

Error failed(const std::string& level, const std::string& path, const char* what)
{
    return {Issue::cache_failed, level, "", std::string(what) + " " + path + ": " + std::strerror(errno)};
}

/// Describe why an entry cannot be read, as an error of its level.
Error asCacheError(const std::string& level, const Error& error)
{
    return {Issue::cache_failed, level, "", "cannot read " + error.file + ": " + error.detail};
}

} // namespace

bool copyFile(const std::string& from, const std::string& to)
{
    const RegularFile source(from);
    if (!source.isOpen())
    {
        errno = source.openError();
        return false;
    }
    const File target(::open(to.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (!target.isOpen())
        return false;
    if (copyBytes(source, target.number()))
        return true;
    const int error = errno;
    ::unlink(to.c_str());
    errno = error;
    return false;
}

std::string DirectoryStore::path(const char* kind, const std::string& name) const
{
    return folder_ + "/" + kind + "/" + name.substr(0, 2) + "/" + name;
}

Result<std::optional<std::string>> DirectoryStore::entry(const std::string& key)
{
    const std::string path = entryPath(key);
    const RegularFile file(path);
    if (file.openError() == ENOENT || file.openError() == ENOTDIR)
        return std::optional<std::string>();
    Result<std::string> text = file.readText();
    if (!text)
        return asCacheError(folder_, text.error());
    struct stat info = {};
    if (writable_ && ::stat(path.c_str(), &info) == 0 && info.st_mtime + kNoteUseEvery_s < std::time(nullptr))
        ::utimensat(AT_FDCWD, path.c_str(), nullptr, 0);
    return std::optional<std::string>(std::move(text).value());
}

Status DirectoryStore::entries(std::span<EntryRequest> wanted)
{
    for (EntryRequest& one : wanted)
        if (!one.text)
        {
            HEARTH_ASSIGN_OR_RETURN(one.text, entry(one.key));
        }
    return success();
}

/// Return a file name that is unique on all machines. No file reserves it: ext4 skips inodes freed in the
/// last minutes, and its search among thousands of them took half of the time of a cook of small sources.
std::string DirectoryStore::temporaryName()
{
    if (unique_prefix_.empty())
    {
        std::random_device random;
        unique_prefix_ = fmt::format("{:08x}{:08x}", random(), random());
    }
    return fmt::format("{}-{}-{}", unique_prefix_, ::getpid(), temporary_count_++);
}

Status DirectoryStore::publish(const std::string& path, const std::function<bool(const std::string&)>& fill)
{
    const std::string temporary_folder = folder_ + "/tmp";
    const std::string temporary_path = temporary_folder + "/" + temporaryName();
    if (!createFolder(temporary_folder) || !createFolder(path.substr(0, path.rfind('/'))))
        return failed(folder_, path, "cannot write");
    const bool is_published = fill(temporary_path) && ::rename(temporary_path.c_str(), path.c_str()) == 0;
    const int error = errno;
    // also after success: rename() between two hard links of one file does nothing
    ::unlink(temporary_path.c_str());
    errno = error;
    return is_published ? success() : failed(folder_, path, "cannot write");
}

Status DirectoryStore::putEntry(const std::string& key, const std::string& text)
{
    return publish(entryPath(key),
                   [&](const std::string& temporary_path)
                   {
                       const File file(
                           ::open(temporary_path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
                       bytes_added_ += text.size();
                       return file.isOpen() && writeAll(file.number(), text.data(), text.size());
                   });
}

Result<bool> DirectoryStore::fetchOne(const ContentRequest& wanted)
{
    const std::string content = contentPath(wanted.hash);
    if (wanted.use == FileAccess::read_only && ::link(content.c_str(), wanted.path.c_str()) == 0)
        return true;
    // fallback: another file system, no support for hard links, or too many links
    if (copyFile(content, wanted.path))
        return true;
    if (errno == ENOENT || errno == ENOTDIR)
        return false;
    return failed(folder_, content, "cannot read");
}

Status DirectoryStore::fetch(std::span<ContentRequest> wanted)
{
    for (ContentRequest& one : wanted)
        if (!one.is_found)
        {
            HEARTH_ASSIGN_OR_RETURN(one.is_found, fetchOne(one));
        }
    return success();
}

Status DirectoryStore::put(const std::string& hash, const std::string& path, FileAccess use)
{
    struct stat there = {};
    struct stat file = {};
    if (::stat(path.c_str(), &file) != 0)
        return failed(folder_, path, "cannot read");
    const std::string content = contentPath(hash);
    // a file of another size is a torn write: replace it
    if (::stat(content.c_str(), &there) == 0 && there.st_size == file.st_size)
        return success();
    HEARTH_TRY(publish(content,
                       [&](const std::string& temporary_path)
                       {
                           const bool is_created = (use == FileAccess::read_only &&
                                                    ::link(path.c_str(), temporary_path.c_str()) == 0) ||
                                                   copyFile(path, temporary_path);
                           return is_created && ::chmod(temporary_path.c_str(), 0444) == 0;
                       }));
    bytes_added_ += static_cast<uint64_t>(file.st_size);
    return success();
}

void DirectoryStore::removeEntry(const std::string& key)
{
    ::unlink(entryPath(key).c_str());
}

void DirectoryStore::removeContent(const std::string& hash)
{
    ::unlink(contentPath(hash).c_str());
}

} // namespace hearth::cache
