// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "formats/base/issues.h"

#include "formats/base/result.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

namespace hearth
{

namespace
{

constexpr IssueInfo kIssues[] = {
#define HEARTH_ISSUE_INFO(name, code, kind, summary, hint)                                                   \
    {Issue::name, IssueClass::kind, #name, summary, hint},
    HEARTH_ISSUES(HEARTH_ISSUE_INFO)
#undef HEARTH_ISSUE_INFO
};

} // namespace

std::span<const IssueInfo> allIssues()
{
    return kIssues;
}

const IssueInfo& issueInfo(Issue issue)
{
    const auto* found = std::find_if(std::begin(kIssues), std::end(kIssues),
                                     [&](const IssueInfo& i) { return i.issue == issue; });
    HEARTH_ASSERT(found != std::end(kIssues));
    return *found;
}

std::string formatMessage(const Error& error)
{
    const IssueInfo& info = issueInfo(error.issue);
    const bool warning = info.kind == IssueClass::warning;
    std::string text = error.file;
    if (!error.where.empty())
        text += (text.empty() ? "" : "|") + error.where;
    text += text.empty() ? "" : ": ";
    text += warning ? "warning: " : "error: ";
    text += error.detail.empty() ? std::string(info.summary) : error.detail;
    text += warning ? " [W" : " [E";
    text += std::to_string(static_cast<unsigned>(error.issue)) + "]";
    if (!info.hint.empty())
        text += " hint: " + std::string(info.hint);
    // one message is one line, even if a hostile file puts control characters into a name
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
    std::replace_if(text.begin(), text.end(), is_control, ' ');
    return text;
}

int exitCode(const Error& error)
{
    switch (issueInfo(error.issue).kind)
    {
    case IssueClass::warning:
        return 0;
    case IssueClass::usage:
        return 2;
    case IssueClass::malformed:
        return 65;
    case IssueClass::missing:
        return 66;
    case IssueClass::internal:
        return 70;
    case IssueClass::cannotWrite:
        return 73;
    case IssueClass::io:
        return 74;
    case IssueClass::temporary:
        return 75;
    case IssueClass::config:
        return 78;
    }
    return 70;
}

void assertionFailed(const char* condition, const char* file, int line)
{
    std::fprintf(stderr, "%s:%d: internal error: contract broken: %s\n", file, line, condition);
    std::abort();
}

} // namespace hearth
