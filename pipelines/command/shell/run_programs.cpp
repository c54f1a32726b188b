// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/run_programs.h"

#include "cook/tools/child_processes.h"

namespace hearth::command
{

std::optional<graph::Failure> runPrograms(const std::vector<Program>& programs)
{
    tools::ChildProcesses children;
    for (const Program& program : programs)
    {
        std::vector<std::string> command{tools::programFolder() + "/hearth-" + program.name};
        command.insert(command.end(), program.arguments.begin(), program.arguments.end());
        if (const Result<size_t> child = children.start(command); !child.ok())
            return graph::makeFailure(child.error(), 0);
    }
    while (children.running() > 0)
    {
        const std::optional<tools::ChildOutcome> end = children.wait();
        if (!end)
            return graph::Failure{.exit_code = kInterrupted, .error = "interrupted"};
        graph::Action action;
        action.cooker = programs[end->id].name;
        action.subject = programs[end->id].subject;
        if (const auto failure = graph::makeFailure(action, *end, graph::splitLines(end->messages)))
            return failure;
    }
    return std::nullopt;
}

} // namespace hearth::command
