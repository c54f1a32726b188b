// hearth diff: what differs between two packs, by what it means.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/pack/pack_view.h"
#include "pipelines/command/inspect/pack_entries.h"

#include <span>
#include <string>
#include <vector>

namespace hearth::command
{

/// A fact of one thing in both packs; empty where one does not have it.
struct FactChange
{
    std::string what;
    std::string a;
    std::string b;
    bool is_hash = false; ///< as Fact::is_hash
};

struct ThingChange
{
    enum class How
    {
        added, ///< it is in B alone
        removed,
        changed,
    };
    std::string kind;
    std::string name;
    How how = How::changed;
    std::vector<FactChange> facts{}; ///< that differ, where it is changed
    std::string note{};              ///< as Thing::note; of B, where it is there
};

/// All chunks of one type.
struct ChunkBytes
{
    std::string kind; ///< "PAGE"
    uint64_t a = 0;   ///< as they lie in the file
    uint64_t b = 0;
    bool is_same = false; ///< byte for byte
};

struct PackDiff
{
    std::vector<ThingChange> things;
    std::vector<FactChange> settings; ///< by JSON pointer into META
    std::vector<ChunkBytes> chunks;   ///< all kinds, in the order of A's file

    bool isSameByMeaning() const { return things.empty() && settings.empty(); }
    bool isSame() const;
};

/// Things are the same where kind and name are. Where several have one name, equal ones are paired first, then those of one
/// note, then the rest in their order.
std::vector<ThingChange> diffThings(std::span<const Thing> a, std::span<const Thing> b);

/// errors: those of thingsOf
Result<PackDiff> diffPacks(const formats::PackView& a, const formats::PackView& b);

/// What hearth-compare says of a picture of both.
struct PictureFigures
{
    std::string heat_map; ///< the file
    std::string json;     ///< schema hearth.compare/1; empty: no picture was asked for
};

/// For people: how many things differ and the bytes of both first, then the things.
/// shows_hashes  of contents; else only that they differ
std::string diffText(const PackDiff& diff, const PictureFigures& picture = {}, bool shows_hashes = false);

/// Schema "hearth.diff/1".
std::string diffJson(const PackDiff& diff, const std::string& file_a, const std::string& file_b,
                     const PictureFigures& picture = {});

} // namespace hearth::command
