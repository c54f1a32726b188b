// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/picture/programs.h"

#include "cook/tools/child_processes.h"

#include <fstream>
#include <sstream>

namespace hearth::picture
{

std::string readBytes(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    std::stringstream content;
    content << file.rdbuf();
    return content.str();
}

Status runProgram(const std::vector<std::string>& command)
{
    tools::ChildProcesses children;
    HEARTH_TRY(children.start(command));
    const std::optional<tools::ChildOutcome> end = children.wait();
    if (!end)
        return Error{Issue::child_failed, command[0], "", "interrupted"};
    if (end->exit_code != 0 || end->signal != 0)
        return Error{Issue::child_failed, command[0], "",
                     "ended with " + std::to_string(end->signal != 0 ? end->signal : end->exit_code) + ": " +
                         end->messages};
    return success();
}

} // namespace hearth::picture
