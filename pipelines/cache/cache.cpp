// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cache/cache.h"

#include "cook/tools/sha256.h"
#include "pipelines/cache/entry_text.h"

#include <algorithm>
#include <unistd.h>

namespace hearth::cache
{

Cache::Cache(std::vector<std::unique_ptr<Level>> levels, std::function<void(const Error&)> warn)
    : warn_(std::move(warn))
{
    for (std::unique_ptr<Level>& level : levels)
        levels_.push_back({std::move(level), false});
}

bool Cache::isWritable() const
{
    return std::any_of(levels_.begin(), levels_.end(),
                       [](const Slot& slot) { return slot.level->isWritable() && !slot.is_left_alone; });
}

void Cache::leaveAlone(Slot& slot, const Error& error)
{
    slot.is_left_alone = true;
    warn_(error);
}

void Cache::damaged(Slot& slot, const std::string& what)
{
    ++damage_count_;
    warn_({Issue::cache_failed, slot.level->name(), "", what + " is damaged: it is made again"});
}

std::optional<Fields> Cache::entryOf(Slot& slot, const std::string& key)
{
    const auto text = slot.level->entry(key);
    if (!text.ok())
    {
        leaveAlone(slot, text.error());
        return std::nullopt;
    }
    if (!*text)
        return std::nullopt;
    std::optional<Fields> fields = entryFields(**text);
    if (!fields)
    {
        damaged(slot, "entry " + key);
        if (slot.level->isWritable())
            slot.level->removeEntry(key);
    }
    return fields;
}

std::optional<Fields> Cache::entry(const std::string& key)
{
    for (size_t i = 0; i < levels_.size(); ++i)
    {
        if (levels_[i].is_left_alone)
            continue;
        std::optional<Fields> fields = entryOf(levels_[i], key);
        if (!fields)
            continue;
        for (size_t near = 0; near < i; ++near)
            if (Slot& slot = levels_[near]; !slot.is_left_alone && slot.level->isWritable())
                if (const Status put = slot.level->putEntry(key, entryText(*fields)); !put.ok())
                    leaveAlone(slot, put.error());
        return fields;
    }
    return std::nullopt;
}

void Cache::putEntry(const std::string& key, const Fields& fields)
{
    for (Slot& slot : levels_)
        if (!slot.is_left_alone && slot.level->isWritable())
            if (const Status put = slot.level->putEntry(key, entryText(fields)); !put.ok())
                leaveAlone(slot, put.error());
}

bool Cache::fetchFrom(Slot& slot, const std::string& hash, const std::string& path, Use use)
{
    const Result<bool> fetched = slot.level->fetch(hash, path, use);
    if (!fetched.ok())
        leaveAlone(slot, fetched.error());
    if (!fetched.ok() || !*fetched)
        return false;
    if (tools::sha256OfFile(path) == hash)
        return true;
    ::unlink(path.c_str());
    damaged(slot, "content " + hash);
    if (slot.level->isWritable())
        slot.level->removeContent(hash);
    return false;
}

bool Cache::fetch(const std::string& hash, const std::string& path, Use use)
{
    for (size_t i = 0; i < levels_.size(); ++i)
    {
        if (levels_[i].is_left_alone || !fetchFrom(levels_[i], hash, path, use))
            continue;
        for (size_t near = 0; near < i; ++near)
            if (Slot& slot = levels_[near]; !slot.is_left_alone && slot.level->isWritable())
                if (const Status put = slot.level->put(hash, path, Use::given_away); !put.ok())
                    leaveAlone(slot, put.error());
        return true;
    }
    return false;
}

void Cache::put(const std::string& hash, const std::string& path, Use use)
{
    for (Slot& slot : levels_)
        if (!slot.is_left_alone && slot.level->isWritable())
            if (const Status put = slot.level->put(hash, path, use); !put.ok())
                leaveAlone(slot, put.error());
}

} // namespace hearth::cache
