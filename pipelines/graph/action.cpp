// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/action.h"

namespace hearth::graph
{

std::vector<std::string> commandLine(const Action& action, const std::string& programs,
                                     const ActionPaths& paths)
{
    std::vector<std::string> command{programs + "/hearth-" + action.cooker};
    for (const Word& word : action.words)
        command.push_back(word.kind == Word::Kind::text    ? word.text
                          : word.kind == Word::Kind::input ? word.text + paths.inputs[word.index]
                                                           : word.text + paths.outputs[word.index]);
    return command;
}

} // namespace hearth::graph
