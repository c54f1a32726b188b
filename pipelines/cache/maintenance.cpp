// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cache/maintenance.h"

#include "cook/tools/sha256.h"
#include "formats/base/atomic_file.h"
#include "formats/base/regular_file.h"
#include "pipelines/cache/entry_text.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <map>

namespace hearth::cache
{

namespace fs = std::filesystem;

namespace
{

constexpr auto kMaxWriteTime = std::chrono::hours(1);

struct StoredFile
{
    std::string path;
    std::string name; ///< key or hash
    uint64_t bytes = 0;
    fs::file_time_type used;
};

/// List the files of ac/ or cas/, sorted by name.
std::vector<StoredFile> listStoredFiles(const std::string& folder)
{
    std::vector<StoredFile> files;
    std::error_code error;
    for (auto at = fs::recursive_directory_iterator(folder, error); !error && at != fs::end(at);
         at.increment(error))
    {
        std::error_code gone;
        StoredFile file{at->path().string(), at->path().filename().string(), 0, at->last_write_time(gone)};
        if (gone || !at->is_regular_file(gone) || !tools::isSha256(file.name))
            continue;
        file.bytes = at->file_size(gone);
        if (!gone)
            files.push_back(std::move(file));
    }
    std::sort(files.begin(), files.end(),
              [](const StoredFile& a, const StoredFile& b) { return a.name < b.name; });
    return files;
}

void remove(const std::string& path)
{
    std::error_code ignored;
    fs::remove(path, ignored);
}

/// Return the hashes of the contents that an entry refers to.
std::vector<std::string> contentHashes(const Fields& fields)
{
    std::vector<std::string> hashes;
    for (const auto& [name, value] : fields)
        if (name == kContentField)
            hashes.push_back(value);
    return hashes;
}

std::vector<std::string> readContentHashes(const std::string& path)
{
    const Result<std::string> text = readFile(path);
    const std::optional<Fields> fields = text ? parseEntry(*text) : std::nullopt;
    return fields ? contentHashes(*fields) : std::vector<std::string>();
}

bool isYoung(const fs::file_time_type& time)
{
    return time + kMaxWriteTime > fs::file_time_type::clock::now();
}

} // namespace

Occupancy measureOccupancy(const std::string& folder)
{
    Occupancy occupancy;
    for (const StoredFile& file : listStoredFiles(folder + "/ac"))
    {
        ++occupancy.entries;
        occupancy.bytes += file.bytes;
    }
    for (const StoredFile& file : listStoredFiles(folder + "/cas"))
    {
        ++occupancy.contents;
        occupancy.bytes += file.bytes;
    }
    return occupancy;
}

Occupancy collectGarbage(const std::string& folder, uint64_t limit_bytes)
{
    std::vector<StoredFile> entries = listStoredFiles(folder + "/ac");
    const std::vector<StoredFile> contents = listStoredFiles(folder + "/cas");
    std::map<std::string, const StoredFile*> unreferenced;
    for (const StoredFile& content : contents)
        unreferenced.emplace(content.name, &content);

    // an entry keeps its contents alive: from the most recently used on, entries stay while there is room for
    // their contents
    std::stable_sort(entries.begin(), entries.end(),
                     [](const StoredFile& a, const StoredFile& b) { return a.used > b.used; });
    Occupancy remaining;
    for (const StoredFile& entry : entries)
    {
        const std::vector<std::string> entry_contents = readContentHashes(entry.path);
        uint64_t bytes = entry.bytes;
        for (const std::string& hash : entry_contents)
            if (const auto content = unreferenced.find(hash); content != unreferenced.end())
                bytes += content->second->bytes;
        if (bytes > limit_bytes - remaining.bytes)
        {
            remove(entry.path);
            continue;
        }
        ++remaining.entries;
        remaining.bytes += bytes;
        for (const std::string& hash : entry_contents)
            remaining.contents += unreferenced.erase(hash);
    }
    for (const auto& [name, content] : unreferenced)
        if (isYoung(content->used) && content->bytes <= limit_bytes - remaining.bytes)
        {
            ++remaining.contents;
            remaining.bytes += content->bytes;
        }
        else
            remove(content->path);
    std::error_code error;
    for (auto at = fs::directory_iterator(folder + "/tmp", error); !error && at != fs::directory_iterator();
         at.increment(error))
        if (std::error_code gone; !isYoung(at->last_write_time(gone)))
            remove(at->path().string());
    return remaining;
}

std::vector<std::string> verifyFolder(const std::string& folder)
{
    std::vector<std::string> damaged;
    std::map<std::string, bool> is_there;
    for (const StoredFile& content : listStoredFiles(folder + "/cas"))
    {
        is_there[content.name] = tools::computeFileSha256(content.path) == content.name;
        if (is_there[content.name])
            continue;
        damaged.push_back("content " + content.name);
        remove(content.path);
    }
    for (const StoredFile& entry : listStoredFiles(folder + "/ac"))
    {
        const Result<std::string> text = readFile(entry.path);
        const std::optional<Fields> fields = text ? parseEntry(*text) : std::nullopt;
        bool whole = fields.has_value();
        for (const std::string& hash : fields ? contentHashes(*fields) : std::vector<std::string>())
            whole = whole && is_there[hash];
        if (whole)
            continue;
        damaged.push_back("entry " + entry.name);
        remove(entry.path);
    }
    return damaged;
}

void recordGrowth(const std::string& folder, uint64_t bytes, uint64_t limit_bytes)
{
    if (bytes == 0)
        return;
    // only a hint: two cooks that write it at once lose some bytes until garbage is collected
    const std::string path = folder + "/size";
    const Result<std::string> text = readFile(path);
    uint64_t size = 0;
    if (!text || std::from_chars(text->data(), text->data() + text->size(), size).ec != std::errc())
        size = measureOccupancy(folder).bytes;
    else
        size += bytes;
    if (size > limit_bytes)
        size = collectGarbage(folder, limit_bytes / 10 * 9).bytes;
    // if this fails, the next cook counts all files
    static_cast<void>(writeText(path, std::to_string(size) + "\n").ok());
}

} // namespace hearth::cache
