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

/// What becomes of a file that a level hands out.
enum class Use
{
    read_only, ///< it is read and deleted: it may be the level's own file under another name
    given_away ///< others may write into it: it shares nothing with the level but unchanged blocks
};

struct WantedEntry
{
    std::string key;
    std::optional<std::string> text; ///< the answer; nullopt: not there
};

struct WantedContent
{
    std::string hash;
    std::string path; ///< where it shall appear; nothing is there
    Use use = Use::read_only;
    uint64_t bytes = UINT64_MAX; ///< that it has; at most, where that is not known
    bool is_there = false;       ///< the answer: it lies at `path`
};

/// Keys and hashes are 64 lower-case hexadecimal digits. A level need not check what it hands out: Cache does.
/// Whatever goes wrong is an Error (cache_failed), and nobody's loss but time.
class Level
{
public:
    virtual ~Level() = default;

    /// As messages name it.
    virtual const std::string& name() const = 0;
    /// A level that is not so any more after a failed put may still be read.
    virtual bool isWritable() const = 0;
    /// Whether many questions at once cost little more than one.
    virtual bool isFar() const = 0;

    /// Answer the questions that have no answer yet; after an error, some of them may have one.
    virtual Status entries(std::span<WantedEntry> wanted) = 0;
    virtual Status putEntry(const std::string& key, const std::string& text) = 0;

    /// Put contents at their paths; after an error, some of them may be there.
    virtual Status fetch(std::span<WantedContent> wanted) = 0;
    /// Keep the content of the file at `path`, which nobody writes to any more.
    /// use   what becomes of that file after
    virtual Status put(const std::string& hash, const std::string& path, Use use) = 0;

    /// What was handed out was damaged: better gone.
    virtual void removeEntry(const std::string& key) = 0;
    virtual void removeContent(const std::string& hash) = 0;
};

} // namespace hearth::cache
