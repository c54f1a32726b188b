// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/budget/texture_budget.h"

#include "cook/json/json.h"

#include <fmt/format.h>
#include <limits>
#include <map>
#include <utility>

namespace hearth::budget
{

namespace
{

/// Identity of a texture of the pack.
std::string textureKey(const TextureFormats& image)
{
    std::string key = image.content;
    for (const std::string& name : image.names)
        key += " " + name;
    return key;
}

} // namespace

Result<SourceTextures> parseEstimates(const std::string& text, const std::string& file)
{
    const std::optional<Json> json = Json::parse(text);
    SourceTextures images;
    // the JSON reader throws where a member is missing or of another type
    try
    {
        if (!json)
            return Error{Issue::json_syntax, file, "", ""};
        for (const Json& image : json->at("images"))
        {
            TextureFormats& formats = images.emplace_back();
            formats.content = image.at("content").get<std::string>();
            for (const Json& format : image.at("formats"))
            {
                if (!format.at("bytes").is_number_unsigned())
                    return Error{Issue::json_syntax, file, "/images", "bytes are no whole number"};
                formats.names.push_back(format.at("format").get<std::string>());
                formats.options.push_back(
                    {format.at("bytes").get<uint64_t>(), format.at("cost").get<double>()});
            }
            if (formats.names.empty())
                return Error{Issue::json_syntax, file, "/images", "an image has no format"};
        }
    }
    catch (const JsonError&)
    {
        return Error{Issue::json_syntax, file, "/images", ""};
    }
    return images;
}

TextureShare shareTextures(std::span<const SourceTextures> sources, uint64_t budget)
{
    std::map<std::string, size_t> texture_of_key;
    std::vector<BudgetOptions> textures;
    std::vector<std::vector<size_t>> texture_of_image(sources.size());
    for (size_t source = 0; source < sources.size(); ++source)
        for (const TextureFormats& image : sources[source])
        {
            const auto [place, is_new] = texture_of_key.try_emplace(textureKey(image), textures.size());
            texture_of_image[source].push_back(place->second);
            if (is_new)
                textures.push_back(image.options);
            else // seen in several sources
                for (size_t i = 0; i < image.options.size(); ++i)
                    textures[place->second][i].cost += image.options[i].cost;
        }
    const BudgetShare share = shareBudget(textures, budget);
    TextureShare result{.formats = std::vector<std::vector<std::string>>(sources.size()),
                        .texture_count = textures.size(),
                        .budget = budget,
                        .bytes = share.bytes,
                        .min_bytes = shareBudget(textures, 0).bytes,
                        .max_bytes = shareBudget(textures, std::numeric_limits<uint64_t>::max()).bytes,
                        .is_held = share.is_held};
    for (size_t source = 0; source < sources.size(); ++source)
        for (size_t i = 0; i < sources[source].size(); ++i)
            result.formats[source].push_back(
                sources[source][i].names[share.chosen[texture_of_image[source][i]]]);
    return result;
}

std::string listText(const TextureShare& share)
{
    std::string text;
    for (const std::vector<std::string>& formats : share.formats)
    {
        for (size_t i = 0; i < formats.size(); ++i)
            text += fmt::format("{}{}={}", i == 0 ? "" : " ", i, formats[i]);
        text += "\n";
    }
    return text;
}

std::string shareJson(const TextureShare& share)
{
    return Json{{"schema", "hearth.budget/1"},  {"textures", share.texture_count},
                {"budget", share.budget},       {"bytes", share.bytes},
                {"min_bytes", share.min_bytes}, {"max_bytes", share.max_bytes},
                {"holds_budget", share.is_held}}
               .dump(2) +
           "\n";
}

} // namespace hearth::budget
