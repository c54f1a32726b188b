// Cache in a directory: ac/xx/KEY and cas/xx/SHA256, safe for any number of processes and machines that share
// it.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/cache_level.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace hearth::cache
{

/// Cache in a directory. Every file is written under a unique name in tmp/ and renamed, so that readers see
/// all of it or nothing. Nothing is flushed to the disk: a power failure may leave torn files, which their
/// hashes reveal.
class DirectoryStore : public CacheLevel
{
public:
    DirectoryStore(std::string folder, bool writable) : folder_(std::move(folder)), writable_(writable) {}

    const std::string& name() const override { return folder_; }
    bool isWritable() const override { return writable_; }
    bool isRemote() const override { return false; }
    Status entries(std::span<EntryRequest> wanted) override;
    Status putEntry(const std::string& key, const std::string& text) override;
    Status fetch(std::span<ContentRequest> wanted) override;
    Status put(const std::string& hash, const std::string& path, FileAccess use) override;
    void removeEntry(const std::string& key) override;
    void removeContent(const std::string& hash) override;

    /// Number of bytes that this process has added.
    uint64_t bytesAdded() const { return bytes_added_; }

private:
    std::string entryPath(const std::string& key) const { return path("ac", key); }
    std::string contentPath(const std::string& hash) const { return path("cas", hash); }
    std::string path(const char* kind, const std::string& name) const;
    Result<std::optional<std::string>> entry(const std::string& key);
    Result<bool> fetchOne(const ContentRequest& wanted);
    std::string temporaryName();
    /// Create a file with `fill(temporary path)` and rename it to `path`.
    Status publish(const std::string& path, const std::function<bool(const std::string&)>& fill);

    std::string folder_;
    bool writable_;
    uint64_t bytes_added_ = 0;
    std::string unique_prefix_; ///< unique among the processes of all machines
    uint64_t temporary_count_ = 0;
};

/// Copy a file, as a copy-on-write copy (reflink) where the file system allows it. `to` does not exist.
/// returns  false on error, with errno set
bool copyFile(const std::string& from, const std::string& to);

} // namespace hearth::cache
