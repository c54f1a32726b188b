// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/reason_groups.h"

#include "pipelines/command/shell/name_list.h"

#include <algorithm>
#include <fmt/format.h>

namespace hearth::command
{

namespace
{

/// Remove the action's own source from a cause: "its content has changed" from "a.glb: its content has
/// changed", "what import made of it: ..." from "what import made of a.glb: ...".
std::string withoutSubject(const std::string& cause, const std::string& subject)
{
    const std::string own = subject + ": ";
    const size_t at = cause.find(own);
    if (at == 0)
        return cause.substr(own.size());
    const bool is_of_it = at != std::string::npos && cause.substr(0, at).ends_with(" made of ");
    return is_of_it ? cause.substr(0, at) + "it: " + cause.substr(at + own.size()) : cause;
}

} // namespace

void ReasonGroups::add(const graph::Action& action, const std::string& ending,
                       const std::vector<std::string>& causes)
{
    std::string reason = ending;
    std::string first_reason = ending;
    for (const std::string& cause : causes)
    {
        const char* between = &cause == &causes.front() ? ": " : "; ";
        reason += between + withoutSubject(cause, action.subject);
        first_reason += between + cause;
    }
    auto group = std::find_if(groups_.begin(), groups_.end(),
                              [&](const Group& known)
                              { return known.cooker == action.cooker && known.reason == reason; });
    if (group == groups_.end())
        group = groups_.insert(groups_.end(), {action.cooker, reason, first_reason, {}});
    group->subjects.push_back(action.subject);
}

std::string ReasonGroups::text() const
{
    std::string text;
    for (const Group& group : groups_)
        text += group.subjects.size() == 1
                    ? fmt::format("  {:<11}{}{}\n", group.cooker, group.subjects.front(), group.first_reason)
                    : fmt::format("  {:<11}{} sources ({}){}\n", group.cooker, group.subjects.size(),
                                  namesText(group.subjects), group.reason);
    return text;
}

} // namespace hearth::command
