// The levels of a cache as one: read through, written through, and never believed without a hash.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/fields.h"
#include "pipelines/cache/level.h"

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace hearth::cache
{

/// Two entries of one key as one, what the first says coming first.
using Merge = std::function<Fields(const Fields& first, const Fields& second)>;

/// No call fails: what cannot be had is not there, and what cannot be kept is not kept. A level with which something goes
/// wrong is told of once and left alone from then on; what is damaged in it is told of once, and removed if it may be. From
/// a far level that hands out one damaged thing after the other no more is taken.
class Cache
{
public:
    /// levels  nearest first
    /// warn    is told what went wrong (cache_failed)
    Cache(std::vector<std::unique_ptr<Level>> levels, std::function<void(const Error&)> warn);

    bool isEmpty() const { return levels_.empty(); }
    bool isWritable() const;

    /// The fields that were put under the key; found in a far level, they are put into the nearer ones.
    std::optional<Fields> entry(const std::string& key);
    void putEntry(const std::string& key, const Fields& fields);

    /// An entry to which different cooks add: level by level, until one `serves`. The nearer ones get theirs merged with it.
    std::optional<Fields> entry(const std::string& key, const std::function<bool(const Fields&)>& serves,
                                const Merge& merge);
    /// Put fields merged with what the level has, level by level.
    void putEntry(const std::string& key, const Fields& fields, const Merge& merge);

    /// Ask the far levels at once for those entries that no nearer one has. Their answers hold until the key is put.
    void askAhead(std::span<const std::string> keys);
    /// `ask` is called before a far level is asked for an entry, once: whoever knows what else will be asked for can ask
    /// ahead. Where near levels have everything, nobody works out what that is.
    void beforeFarIsAsked(std::function<void()> ask) { before_far_is_asked_ = std::move(ask); }

    /// Make the contents appear at their paths, each different, where nothing is; `is_there` says which of them are.
    void fetch(std::span<WantedContent> wanted);
    bool fetch(const std::string& hash, const std::string& path, Use use);
    void put(const std::string& hash, const std::string& path, Use use);

    /// Whether the entry under the key was met damaged, in any level.
    bool wasDamaged(const std::string& key) const { return damaged_.contains(key); }

private:
    struct Slot
    {
        std::unique_ptr<Level> level;
        bool is_left_alone = false;
        bool is_read = true;
        size_t damage_count = 0;
        std::map<std::string, std::optional<std::string>> told_ahead; ///< texts of entries, by key
    };
    void leaveAlone(Slot& slot, const Error& error);
    void putFailed(Slot& slot, const Error& error);
    void damaged(Slot& slot, const char* kind, const std::string& name);
    void putEntryInto(Slot& slot, const std::string& key, const Fields& fields);
    std::optional<Fields> entryOf(Slot& slot, const std::string& key);
    std::vector<const WantedContent*> fetchFrom(Slot& slot, std::span<WantedContent> wanted);
    void putInto(Slot& slot, const std::string& hash, const std::string& path, Use use);

    std::vector<Slot> levels_;
    std::function<void(const Error&)> warn_;
    std::function<void()> before_far_is_asked_;
    std::set<std::string> damaged_; ///< keys and hashes
};

} // namespace hearth::cache
