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

Cache::Cache(std::vector<std::unique_ptr<Level>> levels, std::function<void(const Error&)> warn)
    : warn_(std::move(warn))
{
    for (std::unique_ptr<Level>& level : levels)
    {
        levels_.emplace_back();
        levels_.back().level = std::move(level);
    }
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

void Cache::putFailed(Slot& slot, const Error& error)
{
    slot.is_left_alone = slot.level->isWritable();
    warn_(error);
}

void Cache::damaged(Slot& slot, const char* kind, const std::string& name)
{
    damaged_.insert(name);
    slot.is_read = !slot.level->isFar() || ++slot.damage_count < kMaxDamage;
    warn_({Issue::cache_failed, slot.level->name(), "",
           fmt::format("{} {} is damaged{}", kind, name,
                       slot.is_read ? ": it is made again"
                                    : ", as others before it: no more is taken from there")});
}

std::optional<Fields> Cache::entryOf(Slot& slot, const std::string& key)
{
    if (slot.level->isFar() && before_far_is_asked_)
        std::exchange(before_far_is_asked_, nullptr)();
    // prefetching may have disabled the level
    if (slot.is_left_alone || !slot.is_read)
        return std::nullopt;
    WantedEntry wanted{key, std::nullopt};
    if (const auto told = slot.told_ahead.find(key); told != slot.told_ahead.end())
        wanted.text = told->second;
    else if (const Status asked = slot.level->entries({&wanted, 1}); !asked.ok())
        leaveAlone(slot, asked.error());
    if (!wanted.text)
        return std::nullopt;
    std::optional<Fields> fields = entryFields(*wanted.text);
    if (!fields)
    {
        slot.told_ahead[key] = std::nullopt;
        damaged(slot, "entry", key);
        if (slot.level->isWritable())
            slot.level->removeEntry(key);
    }
    return fields;
}

void Cache::putEntryInto(Slot& slot, const std::string& key, const Fields& fields)
{
    slot.told_ahead.erase(key);
    if (slot.is_left_alone || !slot.level->isWritable())
        return;
    if (const Status put = slot.level->putEntry(key, entryText(fields)); !put.ok())
        putFailed(slot, put.error());
}

std::optional<Fields> Cache::entry(const std::string& key)
{
    return entry(
        key, [](const Fields&) { return true; }, [](const Fields& first, const Fields&) { return first; });
}

std::optional<Fields> Cache::entry(const std::string& key, const std::function<bool(const Fields&)>& serves,
                                   const Merge& merge)
{
    std::vector<Fields> near;
    for (Slot& slot : levels_)
    {
        std::optional<Fields> fields = slot.is_left_alone ? std::nullopt : entryOf(slot, key);
        if (!fields || !serves(*fields))
        {
            near.push_back(std::move(fields).value_or(Fields()));
            continue;
        }
        for (size_t i = 0; i < near.size(); ++i)
            putEntryInto(levels_[i], key, merge(*fields, near[i]));
        return fields;
    }
    return std::nullopt;
}

void Cache::putEntry(const std::string& key, const Fields& fields)
{
    for (Slot& slot : levels_)
        putEntryInto(slot, key, fields);
}

void Cache::putEntry(const std::string& key, const Fields& fields, const Merge& merge)
{
    for (Slot& slot : levels_)
    {
        if (slot.is_left_alone || !slot.level->isWritable())
            continue;
        // another cook may have put one since
        slot.told_ahead.erase(key);
        putEntryInto(slot, key, merge(fields, entryOf(slot, key).value_or(Fields())));
    }
}

void Cache::askAhead(std::span<const std::string> keys)
{
    std::vector<WantedEntry> wanted;
    for (const std::string& key : keys)
        wanted.push_back({key, std::nullopt});
    for (Slot& slot : levels_)
    {
        std::erase_if(wanted, [&](const WantedEntry& entry)
                      { return entry.text.has_value() || slot.told_ahead.contains(entry.key); });
        if (slot.is_left_alone || !slot.is_read || wanted.empty())
            continue;
        if (const Status asked = slot.level->entries(wanted); !asked.ok())
            leaveAlone(slot, asked.error());
        else if (slot.level->isFar())
            for (const WantedEntry& entry : wanted)
                slot.told_ahead.emplace(entry.key, entry.text);
    }
}

/// Fetch the missing contents from one level and check their hashes. Return the contents that arrived intact.
std::vector<const WantedContent*> Cache::fetchFrom(Slot& slot, std::span<WantedContent> wanted)
{
    std::vector<WantedContent*> missing;
    for (WantedContent& content : wanted)
        if (!content.is_there)
            missing.push_back(&content);
    if (const Status fetched = slot.level->fetch(wanted); !fetched.ok())
        leaveAlone(slot, fetched.error());
    std::vector<const WantedContent*> whole;
    for (WantedContent* content : missing)
    {
        if (!content->is_there)
            continue;
        if (tools::sha256OfFile(content->path) == content->hash)
        {
            whole.push_back(content);
            continue;
        }
        content->is_there = false;
        ::unlink(content->path.c_str());
        if (slot.is_left_alone)
            continue;
        damaged(slot, "content", content->hash);
        if (slot.level->isWritable())
            slot.level->removeContent(content->hash);
    }
    return whole;
}

void Cache::fetch(std::span<WantedContent> wanted)
{
    const auto isThere = [](const WantedContent& content) { return content.is_there; };
    for (size_t i = 0; i < levels_.size(); ++i)
    {
        if (levels_[i].is_left_alone || !levels_[i].is_read ||
            std::all_of(wanted.begin(), wanted.end(), isThere))
            continue;
        for (const WantedContent* content : fetchFrom(levels_[i], wanted))
            for (size_t near = 0; near < i; ++near)
                putInto(levels_[near], content->hash, content->path, Use::given_away);
    }
}

bool Cache::fetch(const std::string& hash, const std::string& path, Use use)
{
    WantedContent wanted{hash, path, use};
    fetch({&wanted, 1});
    return wanted.is_there;
}

void Cache::putInto(Slot& slot, const std::string& hash, const std::string& path, Use use)
{
    if (slot.is_left_alone || !slot.level->isWritable())
        return;
    if (const Status put = slot.level->put(hash, path, use); !put.ok())
        putFailed(slot, put.error());
}

void Cache::put(const std::string& hash, const std::string& path, Use use)
{
    for (Slot& slot : levels_)
        putInto(slot, hash, path, use);
}

} // namespace hearth::cache
