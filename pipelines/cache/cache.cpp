// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cache/cache.h"

#include "cook/tools/sha256.h"
#include "pipelines/cache/entry_text.h"

#include <algorithm>
#include <fmt/format.h>
#include <unistd.h>

namespace hearth::cache
{

namespace
{

// A failing disk damages one entry or two. A server that answers with garbage each time is useless as a
// cache.
constexpr size_t kMaxDamage = 8;

} // namespace

Cache::Cache(std::vector<std::unique_ptr<CacheLevel>> levels, std::function<void(const Error&)> warn)
    : warn_(std::move(warn))
{
    for (std::unique_ptr<CacheLevel>& level : levels)
    {
        levels_.emplace_back();
        levels_.back().level = std::move(level);
    }
}

bool Cache::isWritable() const
{
    return std::any_of(levels_.begin(), levels_.end(),
                       [](const Slot& slot) { return slot.level->isWritable() && !slot.is_disabled; });
}

void Cache::disable(Slot& slot, const Error& error)
{
    slot.is_disabled = true;
    warn_(error);
}

void Cache::handlePutError(Slot& slot, const Error& error)
{
    slot.is_disabled = slot.level->isWritable();
    warn_(error);
}

void Cache::damaged(Slot& slot, const char* kind, const std::string& name)
{
    damaged_.insert(name);
    slot.is_read = !slot.level->isRemote() || ++slot.damage_count < kMaxDamage;
    warn_({Issue::cache_failed, slot.level->name(), "",
           fmt::format("{} {} is damaged{}", kind, name,
                       slot.is_read ? ": it is made again"
                                    : ", as others before it: no more is taken from there")});
}

std::optional<Fields> Cache::readEntry(Slot& slot, const std::string& key)
{
    if (slot.level->isRemote() && before_remote_lookup_)
        std::exchange(before_remote_lookup_, nullptr)();
    // prefetching may have disabled the level
    if (slot.is_disabled || !slot.is_read)
        return std::nullopt;
    EntryRequest wanted{key, std::nullopt};
    if (const auto found = slot.prefetched.find(key); found != slot.prefetched.end())
        wanted.text = found->second;
    else if (const Status lookup = slot.level->entries({&wanted, 1}); !lookup.ok())
        disable(slot, lookup.error());
    if (!wanted.text)
        return std::nullopt;
    std::optional<Fields> fields = parseEntry(*wanted.text);
    if (!fields)
    {
        slot.prefetched[key] = std::nullopt;
        damaged(slot, "entry", key);
        if (slot.level->isWritable())
            slot.level->removeEntry(key);
    }
    return fields;
}

void Cache::putEntryAt(Slot& slot, const std::string& key, const Fields& fields)
{
    slot.prefetched.erase(key);
    if (slot.is_disabled || !slot.level->isWritable())
        return;
    if (const Status put = slot.level->putEntry(key, formatEntry(fields)); !put.ok())
        handlePutError(slot, put.error());
}

std::optional<Fields> Cache::entry(const std::string& key)
{
    return entry(
        key, [](const Fields&) { return true; }, [](const Fields& first, const Fields&) { return first; });
}

std::optional<Fields> Cache::entry(const std::string& key, const std::function<bool(const Fields&)>& serves,
                                   const MergeFields& merge)
{
    std::vector<Fields> near;
    for (Slot& slot : levels_)
    {
        std::optional<Fields> fields = slot.is_disabled ? std::nullopt : readEntry(slot, key);
        if (!fields || !serves(*fields))
        {
            near.push_back(std::move(fields).value_or(Fields()));
            continue;
        }
        for (size_t i = 0; i < near.size(); ++i)
            putEntryAt(levels_[i], key, merge(*fields, near[i]));
        return fields;
    }
    return std::nullopt;
}

void Cache::putEntry(const std::string& key, const Fields& fields)
{
    for (Slot& slot : levels_)
        putEntryAt(slot, key, fields);
}

void Cache::putEntry(const std::string& key, const Fields& fields, const MergeFields& merge)
{
    for (Slot& slot : levels_)
    {
        if (slot.is_disabled || !slot.level->isWritable())
            continue;
        // another cook may have put one since
        slot.prefetched.erase(key);
        putEntryAt(slot, key, merge(fields, readEntry(slot, key).value_or(Fields())));
    }
}

void Cache::prefetch(std::span<const std::string> keys)
{
    std::vector<EntryRequest> wanted;
    for (const std::string& key : keys)
        wanted.push_back({key, std::nullopt});
    for (Slot& slot : levels_)
    {
        std::erase_if(wanted, [&](const EntryRequest& entry)
                      { return entry.text.has_value() || slot.prefetched.contains(entry.key); });
        if (slot.is_disabled || !slot.is_read || wanted.empty())
            continue;
        if (const Status lookup = slot.level->entries(wanted); !lookup.ok())
            disable(slot, lookup.error());
        else if (slot.level->isRemote())
            for (const EntryRequest& entry : wanted)
                slot.prefetched.emplace(entry.key, entry.text);
    }
}

/// Fetch the missing contents from one level and check their hashes. Return the contents that arrived intact.
std::vector<const ContentRequest*> Cache::fetchAt(Slot& slot, std::span<ContentRequest> wanted)
{
    std::vector<ContentRequest*> missing;
    for (ContentRequest& content : wanted)
        if (!content.is_found)
            missing.push_back(&content);
    if (const Status fetched = slot.level->fetch(wanted); !fetched.ok())
        disable(slot, fetched.error());
    std::vector<const ContentRequest*> whole;
    for (ContentRequest* content : missing)
    {
        if (!content->is_found)
            continue;
        if (tools::computeFileSha256(content->path) == content->hash)
        {
            whole.push_back(content);
            continue;
        }
        content->is_found = false;
        ::unlink(content->path.c_str());
        if (slot.is_disabled)
            continue;
        damaged(slot, "content", content->hash);
        if (slot.level->isWritable())
            slot.level->removeContent(content->hash);
    }
    return whole;
}

void Cache::fetch(std::span<ContentRequest> wanted)
{
    const auto isFound = [](const ContentRequest& content) { return content.is_found; };
    for (size_t i = 0; i < levels_.size(); ++i)
    {
        if (levels_[i].is_disabled || !levels_[i].is_read ||
            std::all_of(wanted.begin(), wanted.end(), isFound))
            continue;
        for (const ContentRequest* content : fetchAt(levels_[i], wanted))
            for (size_t near = 0; near < i; ++near)
                putInto(levels_[near], content->hash, content->path, FileAccess::read_write);
    }
}

bool Cache::fetch(const std::string& hash, const std::string& path, FileAccess use)
{
    ContentRequest wanted{hash, path, use};
    fetch({&wanted, 1});
    return wanted.is_found;
}

void Cache::putInto(Slot& slot, const std::string& hash, const std::string& path, FileAccess use)
{
    if (slot.is_disabled || !slot.level->isWritable())
        return;
    if (const Status put = slot.level->put(hash, path, use); !put.ok())
        handlePutError(slot, put.error());
}

void Cache::put(const std::string& hash, const std::string& path, FileAccess use)
{
    for (Slot& slot : levels_)
        putInto(slot, hash, path, use);
}

} // namespace hearth::cache
