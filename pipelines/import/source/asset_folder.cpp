// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/source/asset_folder.h"

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>

namespace hearth::import
{

namespace
{

std::optional<std::string> resolvePath(const std::string& path)
{
    const std::unique_ptr<char, decltype(&std::free)> real(::realpath(path.c_str(), nullptr), &std::free);
    return real ? std::optional<std::string>(real.get()) : std::nullopt;
}

/// True for "C:..." and "scheme:...": a colon before the first slash.
bool startsWithScheme(std::string_view path)
{
    return path.substr(0, path.find_first_of("/\\")).find(':') != std::string_view::npos;
}

bool hasParentStep(std::string_view path)
{
    // a backslash separates folders on other systems, and the same asset must be refused there and here
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

void recordRead(tools::DependencyList& reads, const std::string& path, const FileBytes& file)
{
    // a mapping is read again, a piece at a time; checkUnchanged() detects a change
    if (file.isMapped())
        reads.addFile(path);
    else
        reads.add(path, file.bytes());
}

AssetFolder::AssetFolder(const std::string& asset_path, tools::DependencyList* reads)
    : asset_name_(asset_path.substr(asset_path.rfind('/') + 1)), // npos + 1 is 0
      reads_(reads)
{
    const std::string file = resolvePath(asset_path).value_or(asset_path);
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
        hasParentStep(relative_path))
        return failure(Issue::uri_outside, "the path is not below the folder of the asset");
    if (name.size() >= PATH_MAX)
        return failure(Issue::uri_malformed, "the path is too long");

    const std::optional<std::string> real = resolvePath(folder_ + name);
    if (!real)
        return failure(Issue::input_missing, std::strerror(errno));
    const std::optional<std::string> root = resolvePath(folder_);
    if (!root || !(*real + "/").starts_with(*root == "/" ? *root : *root + "/"))
        return failure(Issue::uri_outside, "a symbolic link leads out of the folder of the asset");
    struct stat info = {};
    if (::stat(real->c_str(), &info) != 0 || !S_ISREG(info.st_mode))
        return failure(Issue::input_missing, "not a regular file");
    return *real;
}

Result<FileBytes> AssetFolder::read(std::string_view relative_path, uint64_t max_bytes) const
{
    const auto locateAndRead = [&]() -> Result<FileBytes>
    {
        HEARTH_ASSIGN_OR_RETURN(const std::string path, locate(relative_path));
        return FileBytes::read(path, max_bytes);
    };
    Result<FileBytes> file = locateAndRead();
    if (reads_ != nullptr && file.ok())
        recordRead(*reads_, folder_ + std::string(relative_path), *file);
    else if (reads_ != nullptr)
        reads_->addAbsent(folder_ + std::string(relative_path));
    return file;
}

std::string AssetFolder::suggestNearest(std::string_view relative_path, Issue issue) const
{
    if (issue != Issue::input_missing && issue != Issue::uri_outside)
        return "";
    if (!names_)
        names_.emplace(folder_);
    const std::string suggestion = names_->suggest(relative_path);
    return suggestion.empty() ? "" : "; nearest: " + suggestion;
}

} // namespace hearth::import
