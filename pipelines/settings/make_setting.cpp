// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/settings/make_setting.h"

namespace hearth::settings
{

Setting flagSetting(std::string key, std::string_view what, std::string_view option)
{
    Setting setting{std::move(key), Kind::flag, what, "false"};
    setting.option = option;
    return setting;
}

Setting switchSetting(std::string key, std::string_view what, std::string_view option)
{
    Setting setting = choiceSetting(std::move(key), what, "auto", {"auto", "on", "off"});
    setting.bare_choice = "on";
    setting.option = option;
    return setting;
}

Setting numberSetting(std::string key, std::string_view what, std::string_view default_text, double low,
                      double high)
{
    Setting setting{std::move(key), Kind::number, what, default_text};
    setting.low = low;
    setting.high = high;
    return setting;
}

Setting wholeNumberSetting(std::string key, std::string_view what, std::string_view default_text, double low,
                           double high)
{
    Setting setting = numberSetting(std::move(key), what, default_text, low, high);
    setting.kind = Kind::whole;
    return setting;
}

Setting choiceSetting(std::string key, std::string_view what, std::string_view default_text,
                      std::vector<std::string_view> choices, Kind kind)
{
    Setting setting{std::move(key), kind, what, default_text};
    setting.choices = std::move(choices);
    return setting;
}

Setting tablesSetting(std::string key, std::string_view what, std::string_view default_text,
                      std::vector<Setting> members)
{
    Setting setting{std::move(key), Kind::tables, what, default_text};
    setting.members = std::move(members);
    return setting;
}

Setting asRequired(Setting setting)
{
    setting.is_required = true;
    return setting;
}

Setting excludingLow(Setting setting)
{
    setting.is_above_low = true;
    return setting;
}

Setting withOption(Setting setting, std::string_view option, std::string_view value_name)
{
    setting.option = option;
    setting.value_name = value_name;
    return setting;
}

Setting withSaving(std::string_view advice, Setting setting)
{
    setting.saving = advice;
    return setting;
}

} // namespace hearth::settings
