// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/inspect/pack_diff.h"

#include <algorithm>
#include <map>

namespace hearth::command
{

using namespace formats;

namespace
{

std::vector<FactChange> diffFacts(std::span<const Fact> a, std::span<const Fact> b)
{
    std::map<std::string, std::string> values_of_b;
    for (const Fact& fact : b)
        values_of_b.emplace(fact.what, fact.value);
    std::vector<FactChange> changes;
    for (const Fact& fact : a)
    {
        const auto other = values_of_b.extract(fact.what);
        const std::string value = other.empty() ? "" : other.mapped();
        if (other.empty() || value != fact.value)
            changes.push_back({fact.what, fact.value, value, fact.is_hash});
    }
    for (const Fact& fact : b)
        if (values_of_b.contains(fact.what))
            changes.push_back({fact.what, "", fact.value, fact.is_hash});
    return changes;
}

/// All entries of the same kind and name, in both packs.
struct Namesakes
{
    std::vector<const Thing*> a;
    std::vector<const Thing*> b;
};

std::string allFacts(const Thing& thing)
{
    std::string text;
    for (const Fact& fact : thing.facts)
        text += fact.what + '\t' + fact.value + '\n';
    return text;
}

/// Remove pairs of equal entries.
void leaveOutEqual(Namesakes& things)
{
    std::map<std::string, size_t> count_of_facts;
    for (const Thing* thing : things.b)
        ++count_of_facts[allFacts(*thing)];
    std::map<std::string, size_t> paired;
    const auto leaves = [](std::map<std::string, size_t>& left, const Thing* thing)
    {
        const auto found = left.find(allFacts(*thing));
        if (found == left.end() || found->second == 0)
            return false;
        --found->second;
        return true;
    };
    std::erase_if(things.a,
                  [&](const Thing* thing)
                  {
                      const bool is_paired = leaves(count_of_facts, thing);
                      paired[allFacts(*thing)] += is_paired ? 1 : 0;
                      return is_paired;
                  });
    std::erase_if(things.b, [&](const Thing* thing) { return leaves(paired, thing); });
}

/// Move pairs with the same note to the front of both sides, each in its order.
void alignNotes(Namesakes& things)
{
    const auto moveTo = [](std::vector<const Thing*>& side, size_t place, size_t from)
    {
        const auto begin = side.begin();
        std::rotate(begin + static_cast<std::ptrdiff_t>(place), begin + static_cast<std::ptrdiff_t>(from),
                    begin + static_cast<std::ptrdiff_t>(from) + 1);
    };
    size_t aligned = 0;
    for (size_t i = 0; i < things.a.size(); ++i)
        for (size_t k = aligned; k < things.b.size(); ++k)
            if (things.a[i]->note == things.b[k]->note)
            {
                moveTo(things.b, aligned, k);
                moveTo(things.a, aligned++, i);
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

std::vector<ThingChange> diffThings(std::span<const Thing> a, std::span<const Thing> b)
{
    // in the order of A, then of B
    using Key = std::pair<std::string, std::string>;
    std::map<Key, Namesakes> namesakes;
    std::vector<Key> order;
    const auto take = [&](std::span<const Thing> things, std::vector<const Thing*> Namesakes::*side)
    {
        for (const Thing& thing : things)
        {
            const auto [found, is_new] = namesakes.try_emplace({thing.kind, thing.name});
            if (is_new)
                order.push_back(found->first);
            (found->second.*side).push_back(&thing);
        }
    };
    take(a, &Namesakes::a);
    take(b, &Namesakes::b);

    std::vector<ThingChange> changes;
    for (const Key& key : order)
    {
        Namesakes& things = namesakes[key];
        leaveOutEqual(things);
        alignNotes(things);
        for (size_t i = 0; i < std::max(things.a.size(), things.b.size()); ++i)
        {
            ThingChange change{key.first, key.second};
            change.note = (i < things.b.size() ? things.b : things.a)[i]->note;
            if (i >= things.b.size())
                change.how = ThingChange::How::removed;
            else if (i >= things.a.size())
                change.how = ThingChange::How::added;
            else
                change.facts = diffFacts(things.a[i]->facts, things.b[i]->facts);
            changes.push_back(std::move(change));
        }
    }
    return changes;
}

Result<PackDiff> diffPacks(const PackView& a, const PackView& b)
{
    PackDiff diff;
    diff.chunks = diffChunks(a, b);
    diff.settings = diffFacts(settingsOf(a), settingsOf(b));
    const auto sameBytes = [](const ChunkBytes& kind) { return kind.is_same; };
    if (std::all_of(diff.chunks.begin(), diff.chunks.end(), sameBytes))
        return diff;
    HEARTH_ASSIGN_OR_RETURN(const std::vector<Thing> things_a, thingsOf(a));
    HEARTH_ASSIGN_OR_RETURN(const std::vector<Thing> things_b, thingsOf(b));
    diff.things = diffThings(things_a, things_b);
    return diff;
}

} // namespace hearth::command
