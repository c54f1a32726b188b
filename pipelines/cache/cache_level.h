// One level of a cache: a store of small entries by key and of contents by their SHA-256.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace hearth::cache
{

/// Access to a file that a level provides or takes.
enum class FileAccess
{
    read_only, ///< read, then deleted: may be a hard link to the level's own file
    read_write ///< may be written: shares only unchanged blocks with the level (copy or reflink)
};

struct EntryRequest
{
    std::string key;
    std::optional<std::string> text; ///< result; nullopt: not in the cache
};

struct ContentRequest
{
    std::string hash;
    std::string path; ///< destination, where no file is yet
    FileAccess use = FileAccess::read_only;
    uint64_t bytes = UINT64_MAX; ///< size, or an upper bound where the size is not known
    bool is_found = false;       ///< result: the content is at `path`
};

/// Interface of a cache level. Keys and hashes are 64 lower-case hexadecimal digits. A level need not verify
/// its data: Cache does. Every problem is an Error (cache_failed) that costs time only.
class CacheLevel
{
public:
    virtual ~CacheLevel() = default;

    /// Return the name for messages.
    virtual const std::string& name() const = 0;
    /// True if the level accepts writes. After a failed put it may be false while reads still work.
    virtual bool isWritable() const = 0;
    /// True if the level is remote: many concurrent requests cost little more than one.
    virtual bool isRemote() const = 0;

    /// Look up the entries that have no text yet; after an error, some of them may have one.
    virtual Status entries(std::span<EntryRequest> wanted) = 0;
    virtual Status putEntry(const std::string& key, const std::string& text) = 0;

    /// Put contents at their paths; after an error, some of them may be there.
    virtual Status fetch(std::span<ContentRequest> wanted) = 0;
    /// Store the content of the file at `path`, which is no longer written to.
    /// use   access to that file afterwards
    virtual Status put(const std::string& hash, const std::string& path, FileAccess use) = 0;

    /// Remove an entry or a content that was found damaged.
    virtual void removeEntry(const std::string& key) = 0;
    virtual void removeContent(const std::string& hash) = 0;
};

} // namespace hearth::cache
