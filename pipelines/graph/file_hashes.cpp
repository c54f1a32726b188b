// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/file_hashes.h"

#include "cook/tools/sha256.h"
#include "formats/base/atomic_file.h"
#include "formats/base/regular_file.h"
#include "pipelines/cache/entry_text.h"

#include <ctime>
#include <fmt/format.h>
#include <sys/stat.h>

namespace hearth::graph
{

namespace
{

constexpr int64_t kMinAge_s = 2;

/// Return the file's identity and times as text; empty where there is no regular file.
std::string metadataText(const struct stat& info)
{
    if (!S_ISREG(info.st_mode))
        return "";
    return fmt::format("{} {} {} {}.{:09} {}.{:09}", info.st_dev, info.st_ino, info.st_size,
                       info.st_mtim.tv_sec, info.st_mtim.tv_nsec, info.st_ctim.tv_sec, info.st_ctim.tv_nsec);
}

} // namespace

void FileHashes::load(const std::string& path)
{
    const Result<std::string> text = readFile(path);
    const std::optional<cache::Fields> fields = text ? cache::parseEntry(*text) : std::nullopt;
    if (!fields)
        return;
    for (const auto& [file, value] : *fields)
        if (const size_t blank = value.find(' '); blank != std::string::npos)
            remembered_[file] = {value.substr(blank + 1), value.substr(0, blank)};
    loaded_text_ = *text;
}

void FileHashes::save(const std::string& path) const
{
    cache::Fields fields;
    for (const auto& [file, known] : current_)
        if (!known.metadata.empty())
            fields.emplace_back(file, known.hash + " " + known.metadata);
    // an error does no harm: a stale file is correct or is not used
    if (const std::string text = cache::formatEntry(fields); text != loaded_text_)
        static_cast<void>(writeText(path, text).ok());
}

std::optional<std::string> FileHashes::hashFile(const std::string& path)
{
    const std::string key = path.starts_with('/') ? path : folder_ + path;
    if (const auto asked = hash_of_path_.find(key); asked != hash_of_path_.end())
        return asked->second;
    std::optional<std::string>& hash = hash_of_path_[key];
    struct stat info = {};
    timespec now = {};
    // before stat(), so that later changes are younger
    ::clock_gettime(CLOCK_REALTIME, &now);
    if (::stat(key.c_str(), &info) != 0)
        return hash;
    std::string metadata = metadataText(info);
    if (metadata.empty())
        return hash;
    if (const auto known = remembered_.find(key);
        known != remembered_.end() && known->second.metadata == metadata)
    {
        current_[key] = known->second;
        return hash = known->second.hash;
    }
    hash = tools::computeFileSha256(key);
    ++files_read_;
    const int64_t youngest = std::max(info.st_mtim.tv_sec, info.st_ctim.tv_sec);
    if (hash && youngest + kMinAge_s < now.tv_sec)
        current_[key] = {std::move(metadata), *hash};
    return hash;
}

} // namespace hearth::graph
