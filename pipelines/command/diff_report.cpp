// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "pipelines/command/pack_diff.h"
#include "pipelines/command/terminal.h"

#include <algorithm>
#include <fmt/format.h>

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

std::string factLine(const FactChange& fact)
{
    return fmt::format("    {}: {} -> {}\n", fact.what, orNothing(fact.a), orNothing(fact.b));
}

std::string thingLine(const ThingChange& change)
{
    const std::string name = change.name.empty() ? "" : " " + change.name;
    return fmt::format("{:<8} {}{}\n", nameOf(change.how), change.kind, name);
}

std::string chunkLine(const ChunkBytes& kind)
{
    return fmt::format("    {}: {} -> {}{}\n", kind.kind, readableSize(kind.a), readableSize(kind.b),
                       kind.a == kind.b ? ", other bytes" : "");
}

size_t countOf(const PackDiff& diff, ThingChange::How how)
{
    return static_cast<size_t>(std::count_if(diff.things.begin(), diff.things.end(),
                                             [&](const ThingChange& change) { return change.how == how; }));
}

Json factsJson(const std::vector<FactChange>& facts)
{
    Json list = Json::array();
    for (const FactChange& fact : facts)
        list.push_back({{"what", fact.what}, {"a", fact.a}, {"b", fact.b}});
    return list;
}

/// In words; numbers that are not there are 0.
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

std::string diffText(const PackDiff& diff, const PictureFigures& picture)
{
    std::string text = pictureText(picture);
    if (diff.isSame())
        return text + "the same\n";
    for (const ThingChange& change : diff.things)
    {
        text += thingLine(change);
        for (const FactChange& fact : change.facts)
            text += factLine(fact);
    }
    if (!diff.settings.empty())
        text += "settings\n";
    for (const FactChange& setting : diff.settings)
        text += factLine(setting);
    text += "bytes\n";
    for (const ChunkBytes& kind : diff.chunks)
        if (!kind.is_same)
            text += chunkLine(kind);
    if (diff.isSameByMeaning())
        return text + "the same by meaning, in other bytes\n";
    return text + fmt::format("{} changed, {} added, {} removed\n", countOf(diff, ThingChange::How::changed),
                              countOf(diff, ThingChange::How::added),
                              countOf(diff, ThingChange::How::removed));
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
        json["changes"].push_back({{"kind", change.kind},
                                   {"name", change.name},
                                   {"change", nameOf(change.how)},
                                   {"facts", factsJson(change.facts)}});
    for (const ChunkBytes& kind : diff.chunks)
        json["chunks"].push_back(
            {{"kind", kind.kind}, {"stored_a", kind.a}, {"stored_b", kind.b}, {"same", kind.is_same}});
    if (!picture.json.empty())
        json["picture"] = {{"heat_map", picture.heat_map},
                           {"figures", Json::parse(picture.json).value_or(Json())}};
    return json.dump(2) + "\n";
}

} // namespace hearth::command
