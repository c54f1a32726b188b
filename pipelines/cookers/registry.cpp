// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/cookers/registry.h"

#include <algorithm>

namespace hearth::cookers
{

// Each is defined in the file of its name.
Cooker describeImport();
Cooker describeClusters();
Cooker describeTextures();
Cooker describeEstimates();
Cooker describeBudget();
Cooker describeTexels();
Cooker describeSkinning();
Cooker describeWrap();
Cooker describeProxy();
Cooker describeNeighbours();
Cooker describeVisibility();
Cooker describeSpecular();
Cooker describeProbe();
Cooker describeBricks();
Cooker describeReceivers();
Cooker describeReflections();
Cooker describeLink();

namespace
{

using settings::Scope;
using settings::Setting;
using settings::Values;

std::vector<Cooker> makeCookers()
{
    std::vector<Cooker> cookers{describeImport(),      describeClusters(),   describeTextures(),
                                describeEstimates(),   describeBudget(),     describeTexels(),
                                describeSkinning(),    describeWrap(),       describeProxy(),
                                describeNeighbours(),  describeVisibility(), describeSpecular(),
                                describeProbe(),       describeBricks(),     describeReceivers(),
                                describeReflections(), describeLink()};
    for (Cooker& cooker : cookers)
        for (Setting& setting : cooker.settings)
            setting.scope = cooker.scope;
    return cookers;
}

std::vector<Setting> makeProfileSettings()
{
    std::vector<Setting> settings;
    for (const Scope scope : {Scope::source, Scope::pack})
        for (const Cooker& cooker : allCookers())
            if (cooker.scope == scope)
                settings.insert(settings.end(), cooker.settings.begin(), cooker.settings.end());
    return settings;
}

} // namespace

std::span<const Cooker> allCookers()
{
    static const std::vector<Cooker> cookers = makeCookers();
    return cookers;
}

const Cooker* findCooker(std::string_view name)
{
    const std::span<const Cooker> cookers = allCookers();
    const auto found = std::find_if(cookers.begin(), cookers.end(),
                                    [&](const Cooker& cooker) { return cooker.name == name; });
    return found == cookers.end() ? nullptr : &*found;
}

std::span<const Setting> profileSettings()
{
    static const std::vector<Setting> settings = makeProfileSettings();
    return settings;
}

bool isEnabled(const Cooker& cooker, const Values& of_pack, std::span<const Values> of_sources)
{
    if (cooker.switched_by.empty())
        return true;
    const Setting* setting = settings::findSetting(profileSettings(), cooker.switched_by);
    HEARTH_ASSERT(setting != nullptr);
    const auto isNotOff = [&](const Values& values)
    {
        if (cooker.runsFor != nullptr)
            return cooker.runsFor(values);
        const settings::Value* const value = settings::findValue(values, setting->key);
        return value == nullptr ? setting->default_text != "off"
                                : value->text != "\"off\"" && value->text != "[]";
    };
    return setting->scope == Scope::pack ? isNotOff(of_pack) : std::ranges::any_of(of_sources, isNotOff);
}

Status checkSourceSettings(const Values& values)
{
    for (const Cooker& cooker : allCookers())
    {
        const bool runs = cooker.scope == Scope::source && isEnabled(cooker, {}, {&values, 1});
        if (!runs || cooker.makeArguments == nullptr)
            continue;
        if (const Result<Arguments> arguments = cooker.makeArguments(values); !arguments.ok())
            return arguments.error();
    }
    return success();
}

} // namespace hearth::cookers
