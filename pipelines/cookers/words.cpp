// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/words.h"

namespace hearth::cookers
{

using settings::Value;
using settings::Values;

void addOption(const Values& values, std::string_view key, const std::string& option, Arguments& arguments)
{
    const Value* value = settings::findValue(values, key);
    if (value == nullptr)
        return;
    const bool is_text = value->text.starts_with('"') || value->text.starts_with('[');
    // texts lose their quotation marks; numbers have none
    for (const std::string& text : is_text ? settings::valueTexts(*value) : std::vector{value->text})
        arguments.words.insert(arguments.words.end(), {option, text});
}

void addFlag(const Values& values, std::string_view key, const std::string& option, Arguments& arguments)
{
    if (settings::isOn(values, key))
        arguments.words.push_back(option);
}

void addAssignment(const Values& values, std::string_view key, Arguments& arguments)
{
    if (const Value* value = settings::findValue(values, key); value != nullptr)
        arguments.words.insert(arguments.words.end(), {"--set", std::string(key) + "=" + value->text});
}

void addAssignments(const Values& values, std::string_view group, Arguments& arguments)
{
    for (const auto& [key, value] : values)
        if (settings::settingGroup(key) == group)
            arguments.words.insert(arguments.words.end(), {"--set", key + "=" + value.text});
}

} // namespace hearth::cookers
