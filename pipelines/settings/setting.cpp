// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/settings/setting.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hearth::settings
{

const Setting* findSetting(std::span<const Setting> settings, std::string_view key)
{
    const auto found = std::find_if(settings.begin(), settings.end(),
                                    [&](const Setting& setting) { return setting.key == key; });
    return found == settings.end() ? nullptr : &*found;
}

std::string_view settingGroup(std::string_view key)
{
    return key.substr(0, key.find('.'));
}

std::string rangeText(const Setting& setting)
{
    const char* const number = setting.kind == Kind::whole ? "a whole number" : "a number";
    switch (setting.kind)
    {
    case Kind::flag:
        return "true or false";
    case Kind::whole:
    case Kind::number:
        if (!setting.choices.empty())
            return fmt::format("{}", fmt::join(setting.choices, " or "));
        if (setting.is_above_low)
            return fmt::format("{} above {:g}", number, setting.low);
        if (setting.high == kMaxWholeNumber)
            return fmt::format("{} from {:g} on", number, setting.low);
        return fmt::format("{} from {:g} to {:g}", number, setting.low, setting.high);
    case Kind::choice:
        return fmt::format("one of {}", fmt::join(setting.choices, ", "));
    case Kind::text:
        return "a text that is not empty";
    case Kind::texts:
        return "an array of texts";
    case Kind::size:
        return "a size, as 512M or 20G";
    case Kind::tables:
        return "an array of at least one table";
    }
    return "";
}

} // namespace hearth::settings
