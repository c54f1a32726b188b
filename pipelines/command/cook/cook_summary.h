// Summary at the end of a cook's messages: repeats what could be overlooked among hundreds of lines.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace hearth::command
{

/// Failures of a cook, and numbers of its warnings by code.
class CookSummary
{
public:
    /// Count a warning line.
    /// is_folded  not printed, because the previous cook has printed it: it belongs to an unchanged source
    void addWarning(const std::string& line, bool is_folded);

    /// Add an error line that has just been printed.
    void addFailure(const std::string& line);

    /// Return the lines of the summary: all failures again, unless nothing was printed after them; then the
    /// number of warnings by code, printed and folded ones apart. Empty if there is nothing to say.
    std::vector<std::string> lines() const;

private:
    using Counts = std::map<std::string, size_t>; ///< count by code, "W1302"

    Counts printed_;
    Counts folded_;
    std::vector<std::string> failures_;
    size_t lines_at_first_failure_ = 0; ///< number of lines printed until then, including that failure
};

} // namespace hearth::command
