// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/graph/message.h"

#include <algorithm>

namespace hearth::graph
{

namespace
{

constexpr std::string_view kHint = "] hint: ";

} // namespace

Message parseMessage(std::string_view line)
{
    Message message;
    // the first severity is the message's own: its text may quote another message
    const auto findSeverity = [&](const std::string& severity)
    { return line.starts_with(severity + ": ") ? 0 : line.find(": " + severity + ": "); };
    const size_t error = findSeverity("error");
    const size_t warning = findSeverity("warning");
    const size_t end_of_place = std::min(error, warning);
    if (end_of_place == std::string_view::npos)
    {
        message.text = line;
        return message;
    }
    message.severity = error < warning ? "error" : "warning";
    const std::string_view place = line.substr(0, end_of_place);
    line.remove_prefix(end_of_place + (end_of_place == 0 ? 0 : 2) + message.severity.size() + 2);
    const size_t bar = place.find('|');
    message.file = place.substr(0, bar);
    message.pointer = bar == std::string_view::npos ? "" : place.substr(bar + 1);

    // the text may contain brackets: the code is in the last ones before the hint
    const size_t hint = line.rfind(kHint);
    if (hint != std::string_view::npos)
        message.hint = line.substr(hint + kHint.size());
    const size_t end = hint != std::string_view::npos ? hint : line.rfind(']');
    const size_t begin = end == std::string_view::npos ? end : line.rfind(" [", end);
    if (begin == std::string_view::npos)
    {
        message.text = line;
        return message;
    }
    message.text = line.substr(0, begin);
    message.code = line.substr(begin + 2, end - begin - 2);
    return message;
}

} // namespace hearth::graph
