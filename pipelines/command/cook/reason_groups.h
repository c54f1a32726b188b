// Groups actions by the reason why they run, for one line per reason.
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
    /// Add an action.
    /// ending  text behind the subject, with a blank before it; may be empty
    /// causes  reasons why the action runs. A cause that names the action's own source equals the same cause
    ///         of another source
    void add(const graph::Action& action, const std::string& ending, const std::vector<std::string>& causes);

    /// Return a line for each combination of cooker, ending and causes, in the order of their first actions:
    /// "  import     a.glb: a.glb: its content has changed", for several
    /// "  import     12 sources (a.glb, b.glb, c.glb and 9 more): its content has changed".
    std::string text() const;

private:
    struct Group
    {
        std::string cooker;
        std::string reason;       ///< ending, and causes behind ": ", without the name of a source
        std::string first_reason; ///< the same in the words of the first source
        std::vector<std::string> subjects;
    };
    std::vector<Group> groups_;
};

} // namespace hearth::command
