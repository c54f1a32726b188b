// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "pipelines/command/inspect/pack_diff.h"
#include "pipelines/command/shell/terminal.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace hearth::command
{

namespace
{

const char* nameOf(ThingChange::How how)
{
    switch (how)
    {
    case ThingChange::How::added:
        return "added";
    case ThingChange::How::removed:
        return "removed";
    case ThingChange::How::changed:
        break;
    }
    return "changed";
}

std::string orNothing(const std::string& value)
{
    return value.empty() ? "nothing" : value;
}

std::string factLine(const FactChange& fact, bool shows_hashes)
{
    if (fact.is_hash && !shows_hashes)
        return fmt::format("    {}: {}\n", fact.what,
                           fact.a.empty()   ? "nothing -> some"
                           : fact.b.empty() ? "some -> nothing"
                                            : "other content");
    return fmt::format("    {}: {} -> {}\n", fact.what, orNothing(fact.a), orNothing(fact.b));
}

std::string thingLine(const ThingChange& change)
{
    const std::string name = change.name.empty() ? "" : " " + change.name;
    const std::string note = change.note.empty() ? "" : " (" + change.note + ")";
    return fmt::format("{:<8} {}{}{}\n", nameOf(change.how), change.kind, name, note);
}

std::string chunkLine(const ChunkBytes& kind)
{
    return fmt::format("    {}: {} -> {}{}\n", kind.kind, readableSize(kind.a), readableSize(kind.b),
                       kind.a == kind.b ? ", other bytes" : "");
}

/// Numbers of changed, added and removed entries, of one kind or of all.
struct Counts
{
    size_t changed = 0;
    size_t added = 0;
    size_t removed = 0;

    void add(ThingChange::How how)
    {
        ++(how == ThingChange::How::added ? added : how == ThingChange::How::removed ? removed : changed);
    }
};

std::string countsText(const Counts& counts)
{
    return fmt::format("{} changed, {} added, {} removed", counts.changed, counts.added, counts.removed);
}

/// Format "1.2 MiB -> 1.3 MiB (+8.3 %)".
std::string sizesText(uint64_t a, uint64_t b)
{
    const double change = a == 0 ? 0 : 100 * (static_cast<double>(b) / static_cast<double>(a) - 1);
    return fmt::format("{} -> {} ({:+.1f} %)", readableSize(a), readableSize(b), change);
}

/// Return the totals: differences by kind of entry, and bytes by type of chunk.
std::string totalsText(const PackDiff& diff)
{
    Counts all;
    std::vector<std::pair<std::string, Counts>> kinds; // in the order of their first entries
    for (const ThingChange& change : diff.things)
    {
        auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [&](const auto& known) { return known.first == change.kind; });
        if (kind == kinds.end())
            kind = kinds.insert(kinds.end(), {change.kind, {}});
        kind->second.add(change.how);
        all.add(change.how);
    }
    std::string text =
        diff.isSameByMeaning() ? "the same by meaning, in other bytes\n" : countsText(all) + "\n";
    for (const auto& [kind, counts] : kinds)
        text += fmt::format("    {}: {}\n", kind, countsText(counts));
    if (!diff.settings.empty())
        text += fmt::format("    settings: {} changed\n", diff.settings.size());
    const auto sum = [&](uint64_t ChunkBytes::*bytes)
    {
        return std::accumulate(diff.chunks.begin(), diff.chunks.end(), uint64_t{0},
                               [&](uint64_t all_bytes, const ChunkBytes& kind)
                               { return all_bytes + kind.*bytes; });
    };
    text += fmt::format("bytes    {}\n", sizesText(sum(&ChunkBytes::a), sum(&ChunkBytes::b)));
    for (const ChunkBytes& kind : diff.chunks)
        if (!kind.is_same)
            text += chunkLine(kind);
    return text;
}

Json factsJson(const std::vector<FactChange>& facts)
{
    Json list = Json::array();
    for (const FactChange& fact : facts)
        list.push_back({{"what", fact.what}, {"a", fact.a}, {"b", fact.b}});
    return list;
}

/// Describe the figures of hearth-compare; absent numbers are 0.
std::string pictureText(const PictureFigures& picture)
{
    if (picture.json.empty())
        return "";
    const Json figures = Json::parse(picture.json).value_or(Json());
    const auto number = [&](const char* pointer)
    {
        const Json* figure = figures.resolve(pointer);
        return figure == nullptr ? 0.0 : figure->get<double>();
    };
    return fmt::format(
        "picture  {}: FLIP {:.4f} in the mean, {:.4f} for 99 % of the pixels; RMS {:.2f} of 255; {} "
        "of {} pixels differ\n",
        picture.heat_map, number("/flip/mean"), number("/flip/percentile_99"), number("/rms"),
        number("/different_pixels"), number("/width") * number("/height"));
}

} // namespace

std::string diffText(const PackDiff& diff, const PictureFigures& picture, bool shows_hashes)
{
    if (diff.isSame())
        return "the same\n" + pictureText(picture);
    std::string text = totalsText(diff) + pictureText(picture);
    if (!diff.settings.empty())
        text += "\nsettings\n";
    for (const FactChange& setting : diff.settings)
        text += factLine(setting, shows_hashes);
    if (!diff.things.empty())
        text += '\n';
    for (const ThingChange& change : diff.things)
    {
        text += thingLine(change);
        for (const FactChange& fact : change.facts)
            text += factLine(fact, shows_hashes);
    }
    return text;
}

std::string diffJson(const PackDiff& diff, const std::string& file_a, const std::string& file_b,
                     const PictureFigures& picture)
{
    Json json{{"schema", "hearth.diff/1"},
              {"a", file_a},
              {"b", file_b},
              {"same", diff.isSame()},
              {"same_by_meaning", diff.isSameByMeaning()},
              {"changes", Json::array()},
              {"settings", factsJson(diff.settings)},
              {"chunks", Json::array()}};
    for (const ThingChange& change : diff.things)
    {
        json["changes"].push_back({{"kind", change.kind},
                                   {"name", change.name},
                                   {"change", nameOf(change.how)},
                                   {"facts", factsJson(change.facts)}});
        if (!change.note.empty())
            json["changes"].back()["note"] = change.note;
    }
    for (const ChunkBytes& kind : diff.chunks)
        json["chunks"].push_back(
            {{"kind", kind.kind}, {"stored_a", kind.a}, {"stored_b", kind.b}, {"same", kind.is_same}});
    if (!picture.json.empty())
        json["picture"] = {{"heat_map", picture.heat_map},
                           {"figures", Json::parse(picture.json).value_or(Json())}};
    return json.dump(2) + "\n";
}

} // namespace hearth::command
