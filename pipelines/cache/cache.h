// The levels of a cache as one: read through, written through, and never believed without a hash.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/fields.h"
#include "pipelines/cache/level.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace hearth::cache
{

/// No call fails: what cannot be had is not there, and what cannot be kept is not kept. A level with which something goes
/// wrong is told of once and left alone from then on; what is damaged in it is told of once, and removed if it may be.
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

    /// Make the content appear at `path`, where nothing is; false where no level has it whole.
    bool fetch(const std::string& hash, const std::string& path, Use use);
    void put(const std::string& hash, const std::string& path, Use use);

    /// How often entry() or fetch() have met something damaged.
    size_t damageCount() const { return damage_count_; }

private:
    struct Slot
    {
        std::unique_ptr<Level> level;
        bool is_left_alone = false;
    };
    void leaveAlone(Slot& slot, const Error& error);
    void damaged(Slot& slot, const std::string& what);
    std::optional<Fields> entryOf(Slot& slot, const std::string& key);
    bool fetchFrom(Slot& slot, const std::string& hash, const std::string& path, Use use);

    std::vector<Slot> levels_;
    std::function<void(const Error&)> warn_;
    size_t damage_count_ = 0;
};

} // namespace hearth::cache
