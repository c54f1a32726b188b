// The end of a cook's messages: what must not be overlooked among hundreds of lines, once more.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace hearth::command
{

class CookSummary
{
public:
    /// Count a line that warns.
    /// is_folded  the cook before has told it, and this one does not: an unchanged source has it still
    void addWarning(const std::string& line, bool is_folded);

    /// Note an error line that has just been told.
    void addFailure(const std::string& line);

    /// The lines for the end: all failures again, unless they are the last that was told; then how many
    /// warnings there are of each code, those that were told and those that were folded. Empty where nothing
    /// is to be said.
    std::vector<std::string> lines() const;

private:
    using Counts = std::map<std::string, size_t>; ///< by code, "W1302"

    Counts told_;
    Counts folded_;
    std::vector<std::string> failures_;
    size_t lines_at_first_failure_ = 0; ///< told before it, and with it
};

} // namespace hearth::command
