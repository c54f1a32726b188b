// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/messages.h"

#include "cook/json/json.h"
#include "pipelines/command/shell/progress.h"
#include "pipelines/command/shell/terminal.h"

#include <cstdio>
#include <fmt/format.h>

namespace hearth::command
{

namespace
{

constexpr std::string_view kError = "error: ";
constexpr std::string_view kWarning = "warning: ";
constexpr std::string_view kHint = " hint: ";

MessageFormat& form()
{
    static MessageFormat form = MessageFormat::text;
    return form;
}

size_t& printedCount()
{
    static size_t count = 0;
    return count;
}

/// Return the position of "error: " or "warning: ", at the start or behind ": "; npos: there is none.
size_t severityAt(std::string_view line, std::string_view severity)
{
    if (line.starts_with(severity))
        return 0;
    const size_t at = line.find(": " + std::string(severity));
    return at == std::string_view::npos ? at : at + 2;
}

bool isCode(std::string_view text)
{
    return text.size() >= 2 && (text[0] == 'E' || text[0] == 'W') &&
           text.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

std::string messageJson(const MessageParts& parts)
{
    Json json{{"severity", parts.severity}};
    for (const auto& [name, text] :
         {std::pair("code", &parts.code), std::pair("file", &parts.file), std::pair("where", &parts.where),
          std::pair("text", &parts.text), std::pair("hint", &parts.hint)})
        if (!text->empty())
            json[name] = *text;
    return json.dump();
}

std::string colored(const std::string& line)
{
    for (const auto& [severity, color] : {std::pair(kError, "31"), std::pair(kWarning, "33")})
        if (const size_t at = severityAt(line, severity); at != std::string::npos)
            return fmt::format("{}\033[1;{}m{}\033[0m{}", line.substr(0, at), color,
                               severity.substr(0, severity.size() - 1),
                               line.substr(at + severity.size() - 1));
    return line;
}

} // namespace

void setMessageFormat(MessageFormat chosen)
{
    form() = chosen;
}

MessageFormat messageFormat()
{
    return form();
}

MessageParts splitMessage(std::string_view line)
{
    MessageParts parts;
    const size_t error = severityAt(line, kError);
    const size_t warning = severityAt(line, kWarning);
    // the first counts: a text may quote another message
    const bool is_error = error <= warning;
    const size_t at = is_error ? error : warning;
    if (at == std::string_view::npos)
    {
        parts.severity = "note";
        parts.text = line;
        return parts;
    }
    parts.severity = is_error ? "error" : "warning";
    std::string_view rest = line.substr(at + (is_error ? kError : kWarning).size());
    if (at >= 2)
    {
        const std::string_view place = line.substr(0, at - 2);
        const size_t bar = place.find('|');
        parts.file = place.substr(0, bar);
        parts.where = bar == std::string_view::npos ? "" : place.substr(bar + 1);
    }
    // the code " [E1203]" is the last of its kind: the text may have brackets, too
    const size_t open = rest.rfind(" [");
    const size_t close = open == std::string_view::npos ? open : rest.find(']', open);
    if (close != std::string_view::npos && isCode(rest.substr(open + 2, close - open - 2)))
    {
        parts.code = rest.substr(open + 2, close - open - 2);
        if (rest.substr(close + 1).starts_with(kHint))
            parts.hint = rest.substr(close + 1 + kHint.size());
        rest = rest.substr(0, open);
    }
    parts.text = rest;
    return parts;
}

void printMessage(const std::string& line)
{
    clearBar();
    const std::string text = form() == MessageFormat::json ? messageJson(splitMessage(line))
                             : isStderrColored()           ? colored(line)
                                                           : line;
    std::fprintf(stderr, "%s\n", text.c_str());
    ++printedCount();
}

int printError(const Error& error)
{
    printMessage(formatMessage(error));
    return exitCode(error);
}

size_t countPrinted()
{
    return printedCount();
}

} // namespace hearth::command
