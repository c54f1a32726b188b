// Progress while the pictures of a report are drawn, which may take longer than the cook.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/shell/progress.h"
#include "pipelines/command/shell/progress_lines.h"

#include <cstddef>
#include <optional>

namespace hearth::command
{

/// A bar, or lines: one at the start, one every ten seconds, and one at the end. Nothing where nothing is
/// drawn.
class PictureProgress
{
public:
    /// print  gets each line, without its end
    PictureProgress(ProgressStyle style, PrintLine print,
                    MonotonicClock clock = std::chrono::steady_clock::now);

    /// To be called before the first picture, and once a second or more often while they are drawn.
    /// drawn  of `count` pictures
    void show(size_t drawn, size_t count);

    /// No more are drawn.
    void end();

private:
    void printLine(const char* word, const std::string& amount, const char* text) const;

    ProgressStyle style_;
    PrintLine print_;
    LineTimer timer_;
    std::optional<ProgressBar> bar_; ///< as soon as the first is drawn
    size_t drawn_ = 0;
    size_t count_ = 0; ///< 0: none is drawn
};

} // namespace hearth::command
