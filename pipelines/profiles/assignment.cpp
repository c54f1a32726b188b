// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/profiles/assignment.h"

#include "formats/base/nearest_match.h"
#include "pipelines/cookers/registry.h"

#include <fmt/format.h>

namespace hearth::profiles
{

using namespace settings;

Result<std::pair<std::string, Value>> parseAssignment(const std::string& text)
{
    const std::string key = text.substr(0, text.find('='));
    const Setting* setting = findSetting(cookers::profileSettings(), key);
    if (setting == nullptr)
    {
        std::vector<std::string> known;
        for (const Setting& one : cookers::profileSettings())
            known.push_back(one.key);
        const std::string nearest = nearestMatch(key, known);
        return Error{Issue::profile_key, "--set " + text, "",
                     nearest.empty() ? "this key is not known"
                                     : fmt::format("this key is not known: did you mean '{}'?", nearest)};
    }
    if (key.size() == text.size())
        return Error{Issue::profile_value, "--set " + text, "", "write KEY=VALUE"};
    HEARTH_ASSIGN_OR_RETURN(Value value,
                            parseAssignedValue(*setting, text.substr(key.size() + 1), "--set " + text));
    return std::pair(key, std::move(value));
}

} // namespace hearth::profiles
