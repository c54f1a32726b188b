// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/cooker_outcome.h"

#include <algorithm>
#include <csignal>
#include <cstring>
#include <fmt/format.h>

namespace hearth::graph
{

namespace
{

/// True for the exit codes by which a cooker reports an error; any other nonzero code is a defect.
bool isErrorCode(int code)
{
    return code == 2 || code == 65 || code == 66 || code == 70 || code == 73 || code == 74 || code == 78;
}

/// Describe the crash of a child; its last line of output helps to find the defect.
Failure crashFailure(const Action& action, const tools::ChildOutcome& end,
                     const std::vector<std::string>& lines)
{
    std::string how = "hearth-" + action.cooker;
    if (end.signal == SIGKILL)
        how += " was killed: perhaps the memory is full";
    else if (end.signal == SIGBUS)
        how += " lost a file that it was reading: it was cut short meanwhile, or its disk has failed";
    else if (end.signal != 0)
        how += fmt::format(" was ended by signal {} ({})", end.signal, ::strsignal(end.signal));
    else
        how += fmt::format(" ended with code {} and no error message", end.exit_code);
    if (!lines.empty())
        how += ": " + lines.back();
    Failure failure = makeFailure({Issue::child_failed, action.subject, "", how}, action.source);
    failure.is_temporary = end.signal == SIGKILL;
    return failure;
}

} // namespace

Failure makeFailure(const Error& error, size_t source)
{
    return {exitCode(error), formatMessage(error), source, false, false};
}

std::optional<Failure> makeFailure(const Action& action, const tools::ChildOutcome& end,
                                   const std::vector<std::string>& lines)
{
    const auto error = std::find_if(lines.begin(), lines.end(), isError);
    if (end.signal == 0 && isErrorCode(end.exit_code) && error != lines.end())
        return Failure{end.exit_code, *error, action.source, true, false};
    if (end.signal != 0 || end.exit_code != 0)
        return crashFailure(action, end, lines);
    return std::nullopt;
}

std::vector<std::string> splitLines(const std::string& text)
{
    std::vector<std::string> lines;
    for (size_t at = 0; at < text.size();)
    {
        const size_t end = std::min(text.find('\n', at), text.size());
        if (end > at)
            lines.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return lines;
}

bool isError(const std::string& line)
{
    return line.find("error: ") != std::string::npos && line.find(" [E") != std::string::npos;
}

bool isWarning(const std::string& line)
{
    return line.find("warning: ") != std::string::npos && line.find(" [W") != std::string::npos;
}

} // namespace hearth::graph
