// Makes descriptions of settings, so that tables of them read as sentences.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/settings/setting.h"

#include <string>
#include <string_view>
#include <vector>

namespace hearth::settings
{

/// Make a setting that is true or false, false by default.
/// option  option of hearth cook that sets it
Setting flagSetting(std::string key, std::string_view what, std::string_view option);

/// Make a setting that switches a cooker: on, off, or auto, the default, which leaves it to the scene. Its
/// option alone means on.
Setting switchSetting(std::string key, std::string_view what, std::string_view option);

/// Make a setting with a number from `low` to `high`.
Setting numberSetting(std::string key, std::string_view what, std::string_view default_text, double low,
                      double high);
Setting wholeNumberSetting(std::string key, std::string_view what, std::string_view default_text, double low,
                           double high);

/// Make a setting with one of several words; with Kind::whole one of several numbers.
Setting choiceSetting(std::string key, std::string_view what, std::string_view default_text,
                      std::vector<std::string_view> choices, Kind kind = Kind::choice);

/// Make a setting with an array of tables, each with these members.
Setting tablesSetting(std::string key, std::string_view what, std::string_view default_text,
                      std::vector<Setting> members);

// Each returns the setting with one member changed.
Setting asRequired(Setting setting);
Setting excludingLow(Setting setting);
Setting withOption(Setting setting, std::string_view option, std::string_view value_name);
Setting withSaving(std::string_view advice, Setting setting);

} // namespace hearth::settings
