// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/list_settings.h"

#include "cook/json/json.h"
#include "pipelines/cookers/registry.h"
#include "pipelines/profiles/command_settings.h"

#include <algorithm>
#include <fmt/format.h>

namespace hearth::command
{

namespace
{

using profiles::Configuration;
using settings::Setting;
using settings::Value;

constexpr const char* kSchema = "hearth.settings/1";
constexpr std::string_view kDefaultOrigin = "default";

struct Row
{
    const Setting* setting = nullptr;
    std::optional<Value> value; ///< nullopt: the default applies
};

std::vector<Row> makeRows(const Configuration& configuration, const std::string& source)
{
    std::vector<Row> rows;
    for (const Setting& setting : profiles::commandSettings())
    {
        const Value* value = configuration.command(setting.key);
        rows.push_back({&setting, value == nullptr ? std::nullopt : std::optional(*value)});
    }
    const settings::Values of_pack = configuration.valuesOfPack();
    const settings::Values of_source = source.empty() ? of_pack : configuration.valuesOfSource(source);
    for (const Setting& setting : cookers::profileSettings())
    {
        const settings::Values& values = setting.scope == settings::Scope::source ? of_source : of_pack;
        const auto found = values.find(setting.key);
        rows.push_back({&setting, found == values.end() ? std::nullopt : std::optional(found->second)});
    }
    return rows;
}

std::string valueText(const Row& row)
{
    return row.value                           ? row.value->text
           : row.setting->default_text.empty() ? "(none)"
                                               : fmt::format("({})", row.setting->default_text);
}

} // namespace

std::string settingsText(const Configuration& configuration, const std::string& source, bool shows_origin)
{
    const std::vector<Row> rows = makeRows(configuration, source);
    size_t key_width = 0;
    size_t value_width = 0;
    // columns do not grow for longer values
    constexpr size_t kMaxValueWidth = 40;
    for (const Row& row : rows)
    {
        key_width = std::max(key_width, row.setting->key.size());
        value_width = std::max(value_width, std::min(valueText(row).size(), kMaxValueWidth));
    }
    std::string text;
    for (const Row& row : rows)
    {
        std::string line = fmt::format("{:<{}}  {}", row.setting->key, key_width, valueText(row));
        if (shows_origin)
            line = fmt::format("{:<{}}  {}", line, key_width + 2 + value_width,
                               row.value ? std::string_view(row.value->origin) : kDefaultOrigin);
        text += line + '\n';
    }
    return text;
}

std::string settingsJson(const Configuration& configuration, const std::string& source)
{
    Json json{{"schema", kSchema}, {"files", Json::array()}, {"profile", nullptr}};
    for (const profiles::ConfigFile& file : configuration.files())
        json["files"].push_back(file.path);
    if (!configuration.profileName().empty())
        json["profile"] = configuration.profileName();
    if (!source.empty())
        json["source"] = source;
    json["settings"] = Json::array();
    for (const Row& row : makeRows(configuration, source))
    {
        Json entry{{"key", row.setting->key}};
        entry["value"] = row.value ? settings::toJson(*row.value) : Json();
        if (!row.value && !row.setting->default_text.empty())
            entry["default"] = row.setting->default_text;
        entry["origin"] = row.value ? row.value->origin : std::string(kDefaultOrigin);
        json["settings"].push_back(std::move(entry));
    }
    return json.dump(2) + "\n";
}

} // namespace hearth::command
