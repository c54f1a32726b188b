// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/asset_folder.h"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>

namespace hearth::import
{

namespace
{

struct FileDescriptor
{
    int number;
    explicit FileDescriptor(int opened) : number(opened) {}
    FileDescriptor(const FileDescriptor&) = delete;
    FileDescriptor& operator=(const FileDescriptor&) = delete;
    ~FileDescriptor()
    {
        if (number >= 0)
            ::close(number);
    }
};

std::optional<std::string> resolved(const std::string& path)
{
    const std::unique_ptr<char, decltype(&std::free)> real(::realpath(path.c_str(), nullptr), &std::free);
    return real ? std::optional<std::string>(real.get()) : std::nullopt;
}

/// "C:..." and "scheme:...": a colon before the first slash.
bool startsWithScheme(std::string_view path)
{
    return path.substr(0, path.find_first_of("/\\")).find(':') != std::string_view::npos;
}

bool climbs(std::string_view path)
{
    // a backslash separates folders on other systems, where the same asset must mean the same
    while (!path.empty())
    {
        const size_t end = std::min(path.find_first_of("/\\"), path.size());
        if (path.substr(0, end) == "..")
            return true;
        path.remove_prefix(std::min(end + 1, path.size()));
    }
    return false;
}

} // namespace

Result<std::vector<std::byte>> readFile(const std::string& path, uint64_t max_bytes)
{
    const auto failure = [&](Issue issue, std::string detail) {
        return Error{issue, path, "", std::move(detail)};
    };
    // without O_NONBLOCK the open of a pipe waits for a writer
    const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    if (file.number < 0)
        return failure(Issue::input_missing, std::strerror(errno));
    struct stat info = {};
    if (::fstat(file.number, &info) != 0)
        return failure(Issue::read_failed, std::strerror(errno));
    if (!S_ISREG(info.st_mode))
        return failure(Issue::input_missing, "not a regular file");
    if (static_cast<uint64_t>(info.st_size) > max_bytes)
        return failure(Issue::input_too_large, std::to_string(info.st_size) + " bytes");

    std::vector<std::byte> bytes(static_cast<size_t>(info.st_size));
    size_t filled = 0;
    while (filled < bytes.size())
    {
        const ssize_t count = ::read(file.number, bytes.data() + filled, bytes.size() - filled);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0)
            return failure(Issue::read_failed, std::strerror(errno));
        if (count == 0)
            return failure(Issue::read_failed, "the file shrank while it was read");
        filled += static_cast<size_t>(count);
    }
    return bytes;
}

AssetFolder::AssetFolder(const std::string& asset_path, tools::ReadList* reads) : reads_(reads)
{
    const std::string file = resolved(asset_path).value_or(asset_path);
    const size_t slash = file.rfind('/');
    folder_ = slash == std::string::npos ? "./" : file.substr(0, slash + 1);
}

Result<std::string> AssetFolder::locate(std::string_view relative_path) const
{
    const std::string name(relative_path);
    const auto failure = [&](Issue issue, std::string detail) {
        return Error{issue, name, "", std::move(detail)};
    };
    if (relative_path.empty())
        return failure(Issue::uri_malformed, "the path is empty");
    if (std::any_of(name.begin(), name.end(),
                    [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }))
        return failure(Issue::uri_malformed, "the path has control characters");
    if (name.front() == '/' || name.front() == '\\' || startsWithScheme(relative_path) ||
        climbs(relative_path))
        return failure(Issue::uri_outside, "the path is not below the folder of the asset");
    if (name.size() >= PATH_MAX)
        return failure(Issue::uri_malformed, "the path is too long");

    const std::optional<std::string> real = resolved(folder_ + name);
    if (!real)
        return failure(Issue::input_missing, std::strerror(errno));
    const std::optional<std::string> root = resolved(folder_);
    if (!root || !(*real + "/").starts_with(*root == "/" ? *root : *root + "/"))
        return failure(Issue::uri_outside, "a symbolic link leads out of the folder of the asset");
    struct stat info = {};
    if (::stat(real->c_str(), &info) != 0 || !S_ISREG(info.st_mode))
        return failure(Issue::input_missing, "not a regular file");
    return *real;
}

Result<std::vector<std::byte>> AssetFolder::read(std::string_view relative_path, uint64_t max_bytes) const
{
    const auto readThere = [&]() -> Result<std::vector<std::byte>>
    {
        HEARTH_ASSIGN_OR_RETURN(const std::string path, locate(relative_path));
        return readFile(path, max_bytes);
    };
    Result<std::vector<std::byte>> bytes = readThere();
    if (reads_ != nullptr && bytes.ok())
        reads_->add(folder_ + std::string(relative_path), *bytes);
    else if (reads_ != nullptr)
        reads_->addAbsent(folder_ + std::string(relative_path));
    return bytes;
}

} // namespace hearth::import
