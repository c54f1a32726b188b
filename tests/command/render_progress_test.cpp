// Tests the progress lines of rendering in logs, with a clock that the test sets.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/render_progress.h"

#include <gtest/gtest.h>

namespace hearth::command
{

namespace
{

using Lines = std::vector<std::string>;

struct Shown
{
    explicit Shown(ProgressStyle style)
        : progress(
              style, [this](const std::string& line) { lines.push_back(line); }, [this] { return now; })
    {
    }
    Lines lines;
    std::chrono::steady_clock::time_point now{};
    RenderProgress progress;
};

} // namespace

TEST(RenderProgress, hasALineAtTheStartEveryTenSecondsAndAtTheEnd)
{
    Shown shown(ProgressStyle::plain);
    shown.progress.show(0, 100);
    EXPECT_EQ(shown.lines, Lines{"drawing 100 images for the report"});
    shown.lines.clear();
    for (int second = 1; second <= 25; ++second)
    {
        shown.now += std::chrono::seconds(1);
        shown.progress.show(static_cast<size_t>(second) * 4, 100);
    }
    EXPECT_EQ(shown.lines, (Lines{"so far       10.00 s    40 of 100  images of the report",
                                  "so far       20.00 s    80 of 100  images of the report"}));
    shown.lines.clear();
    shown.progress.end();
    EXPECT_EQ(shown.lines, Lines{"images       25.00 s   100 of 100  drawn for the report"});
}

TEST(RenderProgress, saysNothingWhereNothingIsDrawnOrNobodyAsks)
{
    Shown idle(ProgressStyle::plain);
    idle.progress.end();
    EXPECT_EQ(idle.lines, Lines());
    Shown quiet(ProgressStyle::none);
    quiet.progress.show(0, 4);
    quiet.now += std::chrono::seconds(60);
    quiet.progress.show(4, 4);
    quiet.progress.end();
    EXPECT_EQ(quiet.lines, Lines());
}

} // namespace hearth::command
