// hearth diff: compares two packs by their meaning.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/command/inspect/pack_entries.h"

#include <span>
#include <string>
#include <vector>

namespace hearth::command
{

/// Property of one entry in both packs; empty in a pack that lacks it.
struct PropertyChange
{
    std::string name;
    std::string a;
    std::string b;
    bool is_hash = false; ///< as Property::is_hash
};

/// Difference of one entry between packs A and B.
struct EntryChange
{
    enum class ChangeType
    {
        added, ///< only in B
        removed,
        changed,
    };
    std::string kind;
    std::string name;
    ChangeType type = ChangeType::changed;
    std::vector<PropertyChange> properties{}; ///< differing properties, if it is changed
    std::string note{};                       ///< as PackEntry::note; from B if the entry is in B
};

/// Stored bytes of all chunks of one type.
struct ChunkBytes
{
    std::string kind; ///< "PAGE"
    uint64_t a = 0;   ///< bytes in the file
    uint64_t b = 0;
    bool is_same = false; ///< byte for byte
};

struct PackDiff
{
    std::vector<EntryChange> entries;
    std::vector<PropertyChange> settings; ///< by JSON pointer into META
    std::vector<ChunkBytes> chunks;       ///< all types, in the order of A's file

    bool isSameByMeaning() const { return entries.empty() && settings.empty(); }
    bool isSame() const;
};

/// Compare entries, which correspond if their kind and name are equal. If several have the same name, equal
/// entries are paired first, then entries with the same note, then the rest in order.
std::vector<EntryChange> diffEntries(std::span<const PackEntry> a, std::span<const PackEntry> b);

/// Compare two packs. errors: those of listEntries
Result<PackDiff> diffPacks(const formats::PackView& a, const formats::PackView& b);

/// Figures of hearth-compare for the rendered images of both packs.
struct ImageFigures
{
    std::string heat_map; ///< path of the heat map
    std::string json;     ///< schema hearth.compare/1; empty: no image was requested
};

/// Return the differences as text for people: first the numbers of entries that differ and the bytes of both
/// packs, then the entries.
/// shows_hashes  print the hashes of contents; else only that they differ
std::string diffText(const PackDiff& diff, const ImageFigures& image = {}, bool shows_hashes = false);

/// Return the differences as JSON, schema "hearth.diff/1".
std::string diffJson(const PackDiff& diff, const std::string& file_a, const std::string& file_b,
                     const ImageFigures& image = {});

} // namespace hearth::command
