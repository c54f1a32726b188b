// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/depfile.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

namespace hearth::command
{

namespace
{

std::string escapeMakePath(const std::string& path)
{
    std::string text;
    size_t backslashes = 0; // directly before the character
    for (const char c : path)
    {
        if (c == ' ' || c == '\t')
            text += std::string(backslashes, '\\') + '\\';
        else if (c == '#' || c == ':')
            text += '\\';
        else if (c == '$')
            text += '$';
        text += c;
        backslashes = c == '\\' ? backslashes + 1 : 0;
    }
    return text;
}

/// Set of files by canonical path, so that each is listed once, whatever its spelling.
class UniqueFiles
{
public:
    void add(const std::string& path)
    {
        std::error_code error;
        const std::filesystem::path real = std::filesystem::canonical(path, error);
        if (known_.insert(error ? path : real.string()).second)
            paths_.push_back(path);
    }
    /// Return the files that were added since the last call.
    std::vector<std::string> takeNew() { return std::exchange(paths_, {}); }

private:
    std::set<std::string> known_;
    std::vector<std::string> paths_;
};

} // namespace

Result<std::string> depfileText(const std::string& output, const std::vector<std::string>& named,
                                const std::vector<std::string>& found)
{
    std::string rule = escapeMakePath(output) + ":";
    std::string empty_rules;
    for (const std::vector<std::string>* paths : {&named, &found})
        for (const std::string& path : *paths)
        {
            rule += " \\\n  " + escapeMakePath(path);
            if (paths == &found)
                empty_rules += "\n" + escapeMakePath(path) + ":\n";
        }
    const auto has_line_break = [](const std::string& path) { return path.find('\n') != std::string::npos; };
    for (const std::vector<std::string>& paths : {std::vector{output}, named, found})
        if (const auto bad = std::find_if(paths.begin(), paths.end(), has_line_break); bad != paths.end())
            return Error{Issue::usage, "--depfile", "",
                         "cannot tell make of a name with a line break: " + *bad};
    return rule + "\n" + empty_rules;
}

Result<std::string> makeDepfile(const graph::Graph& graph, const graph::Executor& executor,
                                const std::string& output)
{
    UniqueFiles files;
    for (const graph::Action& action : graph.actions)
        for (const graph::Input& input : action.inputs)
            if (input.action == graph::kNoAction)
                files.add(input.path);
    const std::vector<std::string> named = files.takeNew();
    for (size_t i = 0; i < graph.actions.size(); ++i)
        for (const std::string& path : executor.probedFiles(i))
            if (std::error_code error; std::filesystem::exists(path, error))
                files.add(path);
    return depfileText(output, named, files.takeNew());
}

} // namespace hearth::command
