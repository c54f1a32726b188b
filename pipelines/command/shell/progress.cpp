// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/shell/progress.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <string_view>
#include <sys/ioctl.h>
#include <unistd.h>

namespace hearth::command
{

namespace
{

// Least time between two drawings: more often is not visible, and loads remote terminals.
constexpr std::chrono::milliseconds kMinRedrawInterval{50};
constexpr size_t kBarWidth = 24;

/// Return the state of the bar: global, because a process has one stderr.
bool& barShown()
{
    static bool shown = false;
    return shown;
}

size_t terminalColumns()
{
    winsize size{};
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

bool isTerminal()
{
    const char* terminal = std::getenv("TERM");
    const char* automatic = std::getenv("CI");
    return ::isatty(STDERR_FILENO) == 1 && terminal != nullptr && std::string_view(terminal) != "dumb" &&
           (automatic == nullptr || *automatic == '\0');
}

} // namespace

ProgressStyle progressStyle(const std::string& name)
{
    if (name == "bar")
        return ProgressStyle::bar;
    if (name == "none")
        return ProgressStyle::none;
    return name == "auto" && isTerminal() ? ProgressStyle::bar : ProgressStyle::plain;
}

std::string barText(size_t ended, size_t count, const std::string& what, size_t columns)
{
    const size_t filled = count == 0 ? kBarWidth : kBarWidth * ended / count;
    std::string text = fmt::format("[{:<{}}] {:>{}}/{}  ", std::string(filled, '#'), kBarWidth, ended,
                                   std::to_string(count).size(), count);
    // the last column stays free, because some terminals wrap there
    const size_t room = columns > text.size() + 1 ? columns - text.size() - 1 : 0;
    text += what.substr(0, room);
    return text.substr(0, columns > 0 ? columns - 1 : 0);
}

ProgressBar::ProgressBar(ProgressStyle style, size_t count)
    : is_shown_(style == ProgressStyle::bar), count_(count)
{
}

ProgressBar::~ProgressBar()
{
    clearBar();
}

void ProgressBar::started(const std::string& what)
{
    what_ = what;
    draw();
}

void ProgressBar::ended()
{
    ++ended_;
    draw();
}

void ProgressBar::show(size_t ended, const std::string& what)
{
    ended_ = ended;
    what_ = what;
    draw();
}

void ProgressBar::draw()
{
    const auto now = std::chrono::steady_clock::now();
    if (!is_shown_ || (barShown() && now - last_drawn_ < kMinRedrawInterval))
        return;
    last_drawn_ = now;
    barShown() = true;
    std::fprintf(stderr, "\r\033[K%s", barText(ended_, count_, what_, terminalColumns()).c_str());
    std::fflush(stderr);
}

void clearBar()
{
    if (!barShown())
        return;
    barShown() = false;
    std::fputs("\r\033[K", stderr);
}

} // namespace hearth::command
