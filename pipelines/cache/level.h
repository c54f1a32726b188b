// One level of a cache: a store of small entries by key and of contents by their SHA-256.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/result.h"

#include <optional>
#include <string>

namespace hearth::cache
{

/// What becomes of a file that a level hands out.
enum class Use
{
    read_only, ///< it is read and deleted: it may be the level's own file under another name
    given_away ///< others may write into it: it shares nothing with the level but unchanged blocks
};

/// Keys and hashes are 64 lower-case hexadecimal digits. A level need not check what it hands out: Cache does.
/// Whatever goes wrong is an Error (cache_failed), and nobody's loss but time.
class Level
{
public:
    virtual ~Level() = default;

    /// As messages name it.
    virtual const std::string& name() const = 0;
    virtual bool isWritable() const = 0;

    /// nullopt: not there
    virtual Result<std::optional<std::string>> entry(const std::string& key) = 0;
    virtual Status putEntry(const std::string& key, const std::string& text) = 0;

    /// Put the content at `path`, where nothing is. false: not there
    virtual Result<bool> fetch(const std::string& hash, const std::string& path, Use use) = 0;
    /// Keep the content of the file at `path`, which nobody writes to any more.
    /// use   what becomes of that file after
    virtual Status put(const std::string& hash, const std::string& path, Use use) = 0;

    /// What was handed out was damaged: better gone.
    virtual void removeEntry(const std::string& key) = 0;
    virtual void removeContent(const std::string& hash) = 0;
};

} // namespace hearth::cache
