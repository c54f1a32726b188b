// Actions and why they run, those with the same reason as one line.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/action.h"

#include <string>
#include <vector>

namespace hearth::command
{

class ReasonGroups
{
public:
    /// ending  stands behind the subject, with a blank before it; empty: nothing does
    /// causes  why the action runs; one that names the action's own source is the same as that of another
    ///         source
    void add(const graph::Action& action, const std::string& ending, const std::vector<std::string>& causes);

    /// A line for the actions of one cooker with the same ending and causes, in the order in which the first
    /// of them came:
    /// "  import     a.glb: a.glb: its content has changed", of several
    /// "  import     12 sources (a.glb, b.glb, c.glb and 9 more): its content has changed".
    std::string text() const;

private:
    struct Group
    {
        std::string cooker;
        std::string reason;     ///< the ending, and the causes behind ": ", without the name of a source
        std::string own_reason; ///< the same in the words of the first source
        std::vector<std::string> subjects;
    };
    std::vector<Group> groups_;
};

} // namespace hearth::command
