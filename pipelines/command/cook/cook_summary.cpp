// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/cook_summary.h"

#include "formats/base/issues.h"
#include "pipelines/command/shell/messages.h"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>

namespace hearth::command
{

namespace
{

size_t sumCounts(const std::map<std::string, size_t>& counts)
{
    return std::accumulate(counts.begin(), counts.end(), size_t{0},
                           [](size_t sum, const auto& count) { return sum + count.second; });
}

/// Return the meaning of a code: "an image is missing; a placeholder is drawn" for "W1302"; empty for an
/// unknown code.
std::string_view issueSummary(const std::string& code)
{
    const auto issues = allIssues();
    const auto found = std::find_if(
        issues.begin(), issues.end(),
        [&](const IssueInfo& info) { return fmt::format("W{}", static_cast<unsigned>(info.issue)) == code; });
    return found == issues.end() ? "" : found->summary;
}

std::string printedText(const std::map<std::string, size_t>& counts)
{
    std::string text;
    for (const auto& [code, count] : counts)
        text += fmt::format("{}{} {} ({})", text.empty() ? "" : ", ", count, code, issueSummary(code));
    return text;
}

std::string foldedText(const std::map<std::string, size_t>& counts)
{
    std::string text;
    for (const auto& [code, count] : counts)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, code);
    return text;
}

std::string warningsWord(size_t count)
{
    return count == 1 ? "1 warning" : fmt::format("{} warnings", count);
}

} // namespace

void CookSummary::addWarning(const std::string& line, bool is_folded)
{
    ++(is_folded ? folded_ : printed_)[splitMessage(line).code];
}

void CookSummary::addFailure(const std::string& line)
{
    if (failures_.empty())
        lines_at_first_failure_ = countPrinted();
    failures_.push_back(line);
}

std::vector<std::string> CookSummary::lines() const
{
    std::vector<std::string> lines;
    const size_t printed_since = countPrinted() - lines_at_first_failure_;
    if (!failures_.empty() && printed_since >= failures_.size())
    {
        lines.push_back(failures_.size() == 1 ? "the failure again:" : "all failures again:");
        lines.insert(lines.end(), failures_.begin(), failures_.end());
    }
    if (const size_t count = sumCounts(printed_); count > 0)
        lines.push_back(fmt::format("{}: {}", warningsWord(count), printedText(printed_)));
    if (const size_t count = sumCounts(folded_); count > 0)
        lines.push_back(
            fmt::format("{} of unchanged sources, as in the cook before: {}; hearth cook -v lists them",
                        warningsWord(count), foldedText(folded_)));
    return lines;
}

} // namespace hearth::command
