// Multi-level cache: reads through and writes through its levels and verifies each hash.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/cache_level.h"
#include "pipelines/cache/fields.h"

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace hearth::cache
{

/// Merges two entries of one key; fields of `first` precede fields of `second`.
using MergeFields = std::function<Fields(const Fields& first, const Fields& second)>;

/// Multi-level content-addressed cache. No call fails: a failed read is a cache miss, and a failed write
/// stores nothing. A level that reports an error is warned about once and not used again. Damaged data is
/// warned about once, and removed where the level allows it. A remote level that delivers kMaxDamage damaged
/// entries or contents is not read any more.
class Cache
{
public:
    /// levels  nearest first
    /// warn    receives each problem (cache_failed)
    Cache(std::vector<std::unique_ptr<CacheLevel>> levels, std::function<void(const Error&)> warn);

    bool isEmpty() const { return levels_.empty(); }
    bool isWritable() const;

    /// Return the fields stored under the key. A hit in a remote level is copied to the nearer levels.
    std::optional<Fields> entry(const std::string& key);
    void putEntry(const std::string& key, const Fields& fields);

    /// Return an entry that several cooks add to: the first, level by level, for which `serves` is true.
    /// Nearer levels get their own fields merged with it.
    std::optional<Fields> entry(const std::string& key, const std::function<bool(const Fields&)>& serves,
                                const MergeFields& merge);
    /// Store the fields, merged with the fields of each level.
    void putEntry(const std::string& key, const Fields& fields, const MergeFields& merge);

    /// Request from the remote levels, all at once, the entries that no nearer level has. Their answers are
    /// used until the key is written.
    void prefetch(std::span<const std::string> keys);
    /// Set a function that is called once, before the first entry is requested from a remote level. It can
    /// prefetch the other entries that will be needed; where near levels have everything, that list is never
    /// computed.
    void beforeRemoteLookup(std::function<void()> ask) { before_remote_lookup_ = std::move(ask); }

    /// Put the contents at their paths; the paths differ, and no file is there yet. `is_found` tells which
    /// contents were found.
    void fetch(std::span<ContentRequest> wanted);
    bool fetch(const std::string& hash, const std::string& path, FileAccess use);
    void put(const std::string& hash, const std::string& path, FileAccess use);

    /// True if the entry under the key was found damaged in any level.
    bool wasDamaged(const std::string& key) const { return damaged_.contains(key); }

private:
    struct Slot
    {
        std::unique_ptr<CacheLevel> level;
        bool is_disabled = false;
        bool is_read = true;
        size_t damage_count = 0;
        /// texts of entries by key; nullopt: the level has none
        std::map<std::string, std::optional<std::string>> prefetched;
    };
    void disable(Slot& slot, const Error& error);
    void handlePutError(Slot& slot, const Error& error);
    void damaged(Slot& slot, const char* kind, const std::string& name);
    void putEntryAt(Slot& slot, const std::string& key, const Fields& fields);
    std::optional<Fields> readEntry(Slot& slot, const std::string& key);
    std::vector<const ContentRequest*> fetchAt(Slot& slot, std::span<ContentRequest> wanted);
    void putInto(Slot& slot, const std::string& hash, const std::string& path, FileAccess use);

    std::vector<Slot> levels_;
    std::function<void(const Error&)> warn_;
    std::function<void()> before_remote_lookup_;
    std::set<std::string> damaged_; ///< keys and hashes
};

} // namespace hearth::cache
