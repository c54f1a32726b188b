// Progress while the images of a report are rendered, which may take longer than the cook.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/command/shell/progress.h"
#include "pipelines/command/shell/progress_lines.h"

#include <cstddef>
#include <optional>

namespace hearth::command
{

/// Progress bar, or lines: one at the start, one every ten seconds, and one at the end. Prints nothing if
/// nothing is rendered.
class RenderProgress
{
public:
    /// print  receives each line, without its line break
    RenderProgress(ProgressStyle style, PrintLine print,
                   MonotonicClock clock = std::chrono::steady_clock::now);

    /// Show the progress. Call it before the first image, and once a second or more often while images are
    /// rendered.
    /// drawn  number of finished images, of `count`
    void show(size_t drawn, size_t count);

    /// Finish: no more images are rendered.
    void end();

private:
    void printLine(const char* word, const std::string& amount, const char* text) const;

    ProgressStyle style_;
    PrintLine print_;
    LineTimer timer_;
    std::optional<ProgressBar> bar_; ///< from the first call of show() on
    size_t drawn_ = 0;
    size_t count_ = 0; ///< 0: no image is rendered
};

} // namespace hearth::command
