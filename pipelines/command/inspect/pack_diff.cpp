// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/inspect/pack_diff.h"

#include <algorithm>
#include <map>

namespace hearth::command
{

using namespace formats;

namespace
{

std::vector<PropertyChange> diffProperties(std::span<const Property> a, std::span<const Property> b)
{
    std::map<std::string, std::string> values_of_b;
    for (const Property& property : b)
        values_of_b.emplace(property.name, property.value);
    std::vector<PropertyChange> changes;
    for (const Property& property : a)
    {
        const auto other = values_of_b.extract(property.name);
        const std::string value = other.empty() ? "" : other.mapped();
        if (other.empty() || value != property.value)
            changes.push_back({property.name, property.value, value, property.is_hash});
    }
    for (const Property& property : b)
        if (values_of_b.contains(property.name))
            changes.push_back({property.name, "", property.value, property.is_hash});
    return changes;
}

/// All entries of the same kind and name, in both packs.
struct SameNameEntries
{
    std::vector<const PackEntry*> a;
    std::vector<const PackEntry*> b;
};

std::string allProperties(const PackEntry& entry)
{
    std::string text;
    for (const Property& property : entry.properties)
        text += property.name + '\t' + property.value + '\n';
    return text;
}

/// Remove pairs of equal entries.
void removeEqual(SameNameEntries& entries)
{
    std::map<std::string, size_t> count_of_properties;
    for (const PackEntry* entry : entries.b)
        ++count_of_properties[allProperties(*entry)];
    std::map<std::string, size_t> paired;
    const auto takeOne = [](std::map<std::string, size_t>& left, const PackEntry* entry)
    {
        const auto found = left.find(allProperties(*entry));
        if (found == left.end() || found->second == 0)
            return false;
        --found->second;
        return true;
    };
    std::erase_if(entries.a,
                  [&](const PackEntry* entry)
                  {
                      const bool is_paired = takeOne(count_of_properties, entry);
                      paired[allProperties(*entry)] += is_paired ? 1 : 0;
                      return is_paired;
                  });
    std::erase_if(entries.b, [&](const PackEntry* entry) { return takeOne(paired, entry); });
}

/// Move pairs with the same note to the front of both sides, each in its order.
void pairByNote(SameNameEntries& entries)
{
    const auto moveTo = [](std::vector<const PackEntry*>& side, size_t place, size_t from)
    {
        const auto begin = side.begin();
        std::rotate(begin + static_cast<std::ptrdiff_t>(place), begin + static_cast<std::ptrdiff_t>(from),
                    begin + static_cast<std::ptrdiff_t>(from) + 1);
    };
    size_t aligned = 0;
    for (size_t i = 0; i < entries.a.size(); ++i)
        for (size_t k = aligned; k < entries.b.size(); ++k)
            if (entries.a[i]->note == entries.b[k]->note)
            {
                moveTo(entries.b, aligned, k);
                moveTo(entries.a, aligned++, i);
                break;
            }
}

std::vector<ChunkBytes> diffChunks(const PackView& a, const PackView& b)
{
    std::vector<ChunkBytes> kinds;
    std::map<std::string, std::string> contents_a;
    std::map<std::string, std::string> contents_b;
    const auto take =
        [&](const PackView& pack, std::map<std::string, std::string>& contents, uint64_t ChunkBytes::*bytes)
    {
        for (const ChunkEntry& entry : pack.container().chunks())
        {
            // "chunk PAGE 0"
            const std::string kind = chunkName(entry.type, entry.index).substr(6, 4);
            auto found = std::find_if(kinds.begin(), kinds.end(),
                                      [&](const ChunkBytes& known) { return known.kind == kind; });
            if (found == kinds.end())
                found = kinds.insert(kinds.end(), {kind, 0, 0, false});
            (*found).*bytes += entry.stored_size;
            contents[kind] += std::to_string(entry.index) + " " + std::to_string(entry.hash) + "\n";
        }
    };
    take(a, contents_a, &ChunkBytes::a);
    take(b, contents_b, &ChunkBytes::b);
    for (ChunkBytes& kind : kinds)
        kind.is_same = contents_a[kind.kind] == contents_b[kind.kind];
    return kinds;
}

} // namespace

bool PackDiff::isSame() const
{
    return isSameByMeaning() &&
           std::all_of(chunks.begin(), chunks.end(), [](const ChunkBytes& kind) { return kind.is_same; });
}

std::vector<EntryChange> diffEntries(std::span<const PackEntry> a, std::span<const PackEntry> b)
{
    // in the order of A, then of B
    using Key = std::pair<std::string, std::string>;
    std::map<Key, SameNameEntries> same_name_entries;
    std::vector<Key> order;
    const auto take =
        [&](std::span<const PackEntry> entries, std::vector<const PackEntry*> SameNameEntries::*side)
    {
        for (const PackEntry& entry : entries)
        {
            const auto [found, is_new] = same_name_entries.try_emplace({entry.kind, entry.name});
            if (is_new)
                order.push_back(found->first);
            (found->second.*side).push_back(&entry);
        }
    };
    take(a, &SameNameEntries::a);
    take(b, &SameNameEntries::b);

    std::vector<EntryChange> changes;
    for (const Key& key : order)
    {
        SameNameEntries& entries = same_name_entries[key];
        removeEqual(entries);
        pairByNote(entries);
        for (size_t i = 0; i < std::max(entries.a.size(), entries.b.size()); ++i)
        {
            EntryChange change{key.first, key.second};
            change.note = (i < entries.b.size() ? entries.b : entries.a)[i]->note;
            if (i >= entries.b.size())
                change.type = EntryChange::ChangeType::removed;
            else if (i >= entries.a.size())
                change.type = EntryChange::ChangeType::added;
            else
                change.properties = diffProperties(entries.a[i]->properties, entries.b[i]->properties);
            changes.push_back(std::move(change));
        }
    }
    return changes;
}

Result<PackDiff> diffPacks(const PackView& a, const PackView& b)
{
    PackDiff diff;
    diff.chunks = diffChunks(a, b);
    diff.settings = diffProperties(readMetaSettings(a), readMetaSettings(b));
    const auto sameBytes = [](const ChunkBytes& kind) { return kind.is_same; };
    if (std::all_of(diff.chunks.begin(), diff.chunks.end(), sameBytes))
        return diff;
    HEARTH_ASSIGN_OR_RETURN(const std::vector<PackEntry> entries_a, listEntries(a));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<PackEntry> entries_b, listEntries(b));
    diff.entries = diffEntries(entries_a, entries_b);
    return diff;
}

} // namespace hearth::command
