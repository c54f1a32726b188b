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

const char* changeName(EntryChange::ChangeType type)
{
    switch (type)
    {
    case EntryChange::ChangeType::added:
        return "added";
    case EntryChange::ChangeType::removed:
        return "removed";
    case EntryChange::ChangeType::changed:
        break;
    }
    return "changed";
}

std::string orNothing(const std::string& value)
{
    return value.empty() ? "nothing" : value;
}

std::string propertyLine(const PropertyChange& property, bool shows_hashes)
{
    if (property.is_hash && !shows_hashes)
        return fmt::format("    {}: {}\n", property.name,
                           property.a.empty()   ? "nothing -> some"
                           : property.b.empty() ? "some -> nothing"
                                                : "other content");
    return fmt::format("    {}: {} -> {}\n", property.name, orNothing(property.a), orNothing(property.b));
}

std::string entryLine(const EntryChange& change)
{
    const std::string name = change.name.empty() ? "" : " " + change.name;
    const std::string note = change.note.empty() ? "" : " (" + change.note + ")";
    return fmt::format("{:<8} {}{}{}\n", changeName(change.type), change.kind, name, note);
}

std::string chunkLine(const ChunkBytes& kind)
{
    return fmt::format("    {}: {} -> {}{}\n", kind.kind, readableSize(kind.a), readableSize(kind.b),
                       kind.a == kind.b ? ", other bytes" : "");
}

/// Numbers of changed, added and removed entries, of one kind or of all.
struct ChangeCounts
{
    size_t changed = 0;
    size_t added = 0;
    size_t removed = 0;

    void add(EntryChange::ChangeType type)
    {
        ++(type == EntryChange::ChangeType::added     ? added
           : type == EntryChange::ChangeType::removed ? removed
                                                      : changed);
    }
};

std::string countsText(const ChangeCounts& counts)
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
    ChangeCounts all;
    std::vector<std::pair<std::string, ChangeCounts>> kinds; // in the order of their first entries
    for (const EntryChange& change : diff.entries)
    {
        auto kind = std::find_if(kinds.begin(), kinds.end(),
                                 [&](const auto& known) { return known.first == change.kind; });
        if (kind == kinds.end())
            kind = kinds.insert(kinds.end(), {change.kind, {}});
        kind->second.add(change.type);
        all.add(change.type);
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

Json propertiesJson(const std::vector<PropertyChange>& properties)
{
    Json list = Json::array();
    for (const PropertyChange& property : properties)
        list.push_back({{"what", property.name}, {"a", property.a}, {"b", property.b}});
    return list;
}

/// Describe the figures of hearth-compare; absent numbers are 0.
std::string imageDiffText(const ImageFigures& image)
{
    if (image.json.empty())
        return "";
    const Json figures = Json::parse(image.json).value_or(Json());
    const auto number = [&](const char* pointer)
    {
        const Json* figure = figures.resolve(pointer);
        return figure == nullptr ? 0.0 : figure->get<double>();
    };
    return fmt::format(
        "image  {}: FLIP {:.4f} in the mean, {:.4f} for 99 % of the pixels; RMS {:.2f} of 255; {} "
        "of {} pixels differ\n",
        image.heat_map, number("/flip/mean"), number("/flip/percentile_99"), number("/rms"),
        number("/different_pixels"), number("/width") * number("/height"));
}

} // namespace

std::string diffText(const PackDiff& diff, const ImageFigures& image, bool shows_hashes)
{
    if (diff.isSame())
        return "the same\n" + imageDiffText(image);
    std::string text = totalsText(diff) + imageDiffText(image);
    if (!diff.settings.empty())
        text += "\nsettings\n";
    for (const PropertyChange& setting : diff.settings)
        text += propertyLine(setting, shows_hashes);
    if (!diff.entries.empty())
        text += '\n';
    for (const EntryChange& change : diff.entries)
    {
        text += entryLine(change);
        for (const PropertyChange& property : change.properties)
            text += propertyLine(property, shows_hashes);
    }
    return text;
}

std::string diffJson(const PackDiff& diff, const std::string& file_a, const std::string& file_b,
                     const ImageFigures& image)
{
    Json json{{"schema", "hearth.diff/1"},
              {"a", file_a},
              {"b", file_b},
              {"same", diff.isSame()},
              {"same_by_meaning", diff.isSameByMeaning()},
              {"changes", Json::array()},
              {"settings", propertiesJson(diff.settings)},
              {"chunks", Json::array()}};
    for (const EntryChange& change : diff.entries)
    {
        json["changes"].push_back({{"kind", change.kind},
                                   {"name", change.name},
                                   {"change", changeName(change.type)},
                                   {"facts", propertiesJson(change.properties)}});
        if (!change.note.empty())
            json["changes"].back()["note"] = change.note;
    }
    for (const ChunkBytes& kind : diff.chunks)
        json["chunks"].push_back(
            {{"kind", kind.kind}, {"stored_a", kind.a}, {"stored_b", kind.b}, {"same", kind.is_same}});
    if (!image.json.empty())
        json["image"] = {{"heat_map", image.heat_map}, {"figures", Json::parse(image.json).value_or(Json())}};
    return json.dump(2) + "\n";
}

} // namespace hearth::command
