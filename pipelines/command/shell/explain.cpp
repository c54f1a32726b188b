// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/explain.h"

#include <charconv>
#include <fmt/format.h>

namespace hearth::command
{

namespace
{

std::string issueCode(const IssueInfo& info)
{
    return fmt::format("{}{}", info.kind == IssueClass::warning ? 'W' : 'E',
                       static_cast<unsigned>(info.issue));
}

std::string issueText(const IssueInfo& info)
{
    std::string text = fmt::format("{} {}\n  {}\n", issueCode(info), info.name, info.summary);
    if (!info.hint.empty())
        text += fmt::format("  What to do: {}.\n", info.hint);
    if (info.kind == IssueClass::warning)
        return text + "  A warning: the work goes on, and the pack's report lists it.\n";
    return text +
           fmt::format("  An error: exit code {}, and no output.\n", exitCode({info.issue, "", "", ""}));
}

} // namespace

Result<std::string> explain(std::string_view code)
{
    if (code.empty())
    {
        std::string list;
        for (const IssueInfo& info : allIssues())
            list += fmt::format("{:<6} {}\n", issueCode(info), info.summary);
        return list;
    }
    std::string_view digits = code;
    if (digits.front() == 'E' || digits.front() == 'W' || digits.front() == 'e' || digits.front() == 'w')
        digits.remove_prefix(1);
    unsigned number = 0;
    const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), number);
    if (parsed.ec == std::errc() && parsed.ptr == digits.data() + digits.size())
        for (const IssueInfo& info : allIssues())
            if (static_cast<unsigned>(info.issue) == number)
                return issueText(info);
    return Error{Issue::usage, "hearth explain", "",
                 fmt::format("there is no issue {}; 'hearth explain' lists all", code)};
}

std::string exitCodeTable()
{
    return "Exit codes:\n"
           "    0  all went well\n"
           "    1  some sources failed for different reasons, the pack lacks some, a check found damage, or "
           "packs differ\n"
           "    2  the command line is wrong\n"
           "   65  an input's content is wrong\n"
           "   66  an input is missing or cannot be read\n"
           "   70  a defect of Hearth\n"
           "   73  an output cannot be written\n"
           "   74  reading or writing failed half way\n"
           "   75  temporary: another try may go better\n"
           "   78  a profile or another file of settings is wrong\n"
           "  130  interrupted\n";
}

} // namespace hearth::command
