// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/render_progress.h"

#include <fmt/format.h>

namespace hearth::command
{

RenderProgress::RenderProgress(ProgressStyle style, PrintLine print, MonotonicClock clock)
    : style_(style), print_(std::move(print)), timer_(std::move(clock))
{
}

void RenderProgress::show(size_t drawn, size_t count)
{
    const bool is_first = count_ == 0;
    drawn_ = drawn;
    count_ = count;
    if (style_ == ProgressStyle::bar)
    {
        if (!bar_)
            bar_.emplace(style_, count);
        bar_->show(drawn, "images of the report");
    }
    if (style_ != ProgressStyle::plain)
        return;
    if (is_first)
        print_(fmt::format("drawing {} images for the report", count));
    else if (timer_.isDue())
        printLine("so far", fmt::format("{} of {}", drawn, count), "images of the report");
}

void RenderProgress::end()
{
    bar_.reset();
    if (style_ == ProgressStyle::plain && count_ > 0)
        printLine("images", fmt::format("{} of {}", drawn_, count_), "drawn for the report");
}

void RenderProgress::printLine(const char* word, const std::string& amount, const char* text) const
{
    print_(fmt::format("{:<10}{:>8.2f} s {:>12}  {}", word, timer_.elapsedSeconds(), amount, text));
}

} // namespace hearth::command
