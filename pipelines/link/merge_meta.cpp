// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/link/merge_meta.h"

#include "cook/json/json.h"

namespace hearth::link
{

namespace
{

const Json& memberOrNull(const Json& object, const char* key)
{
    static const Json nothing;
    const Json* found = object.find(key);
    return found == nullptr ? nothing : *found;
}

/// Return the name of the asset itself: import lists it first.
Json assetName(const Json& import_meta)
{
    const Json& sources = memberOrNull(import_meta, "sources");
    if (!sources.is_array() || sources.empty() || !sources[0].is_object())
        return "";
    return memberOrNull(sources[0], "name");
}

void appendAll(Json& list, const Json& items)
{
    if (items.is_array())
        for (const Json& item : items)
            list.push_back(item);
}

void appendMessages(Json& list, const Json& messages, const Json& asset)
{
    if (!messages.is_array())
        return;
    for (const Json& message : messages)
    {
        if (!message.is_object())
            continue;
        Json named{{"source", asset}};
        named.update(message);
        list.push_back(std::move(named));
    }
}

void addCounts(Json& sums, const Json& counts)
{
    if (!counts.is_object())
        return;
    for (const auto& [key, value] : counts.items())
    {
        if (!value.is_number_unsigned())
            continue;
        const uint64_t before = sums.contains(key) ? sums[key].get<uint64_t>() : 0;
        sums[key] = before + value.get<uint64_t>();
    }
}

uint64_t omittedMessageCount(const Json& meta)
{
    const Json& count = memberOrNull(meta, "messages_left_out");
    return count.is_number_unsigned() ? count.get<uint64_t>() : 0;
}

void mergePart(Json& merged, const Json& meta, const Json& asset)
{
    const Json& settings = memberOrNull(meta, "settings");
    if (settings.is_object())
        merged["settings"].update(settings);
    appendMessages(merged["messages"], memberOrNull(meta, "messages"), asset);
    merged["messages_left_out"] = merged["messages_left_out"].get<uint64_t>() + omittedMessageCount(meta);
    appendAll(merged["dropped"], memberOrNull(meta, "dropped"));
}

} // namespace

Result<std::string> mergeMeta(std::span<const PartMetas> sources, std::span<const std::string_view> of_pack,
                              std::span<const std::string> skipped, uint64_t texture_budget,
                              const std::string& name)
{
    Json merged{{"schema", "hearth.meta/1"}, {"tool", {{"name", "hearth"}, {"version", HEARTH_VERSION}}},
                {"sources", Json::array()},  {"settings", Json::object()},
                {"counts", Json::object()},  {"clips", Json::array()},
                {"messages", Json::array()}, {"messages_left_out", uint64_t{0}},
                {"dropped", Json::array()}};
    for (const PartMetas& source : sources)
    {
        Json asset = "";
        for (const std::string_view text : {source.import_meta, source.clusters_meta, source.textures_meta})
        {
            if (text.empty())
                continue;
            const Json meta = Json::parse(text).value_or(Json());
            if (!meta.is_object())
                return Error{Issue::meaning_value, name, "chunk META 0", "is not a JSON object"};
            if (text.data() == source.import_meta.data())
            {
                asset = assetName(meta);
                appendAll(merged["sources"], memberOrNull(meta, "sources"));
                addCounts(merged["counts"], memberOrNull(meta, "counts"));
                appendAll(merged["clips"], memberOrNull(meta, "clips"));
            }
            mergePart(merged, meta, asset);
        }
    }
    for (const std::string_view text : of_pack)
        mergePart(merged, Json::parse(text).value_or(Json()), "");
    if (texture_budget != 0)
        merged["settings"]["texture_budget"] = texture_budget;
    for (const std::string& text : skipped)
    {
        Json failure = Json::parse(text).value_or(Json());
        if (!failure.is_object())
            return Error{Issue::meaning_value, name, "--skipped", "is not a JSON object"};
        merged["skipped"].push_back(std::move(failure));
    }
    return merged.dump(1, '\t');
}

bool hasSettings(std::string_view meta, const char* part)
{
    const Json parsed = Json::parse(meta).value_or(Json());
    return memberOrNull(memberOrNull(parsed, "settings"), part).is_object();
}

std::string readAssetName(std::string_view import_meta)
{
    const Json name = assetName(Json::parse(import_meta).value_or(Json()));
    if (!name.is_string())
        return "";
    const std::string file = name.get<std::string>();
    const size_t dot = file.rfind('.');
    return dot == 0 ? file : file.substr(0, dot);
}

} // namespace hearth::link
