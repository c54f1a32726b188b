// Shows the progress of a cook on stderr: a bar at the bottom of a terminal, or lines (progress_lines.h).
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace hearth::command
{

enum class ProgressStyle : uint8_t
{
    none,
    plain, ///< lines, see ProgressLines
    bar,   ///< one line that is drawn again and again
};

/// Parse "auto", "bar", "plain" or "none". "auto" is a bar if stderr is a terminal that can move its cursor,
/// else plain lines.
ProgressStyle progressStyle(const std::string& name);

/// Progress bar: the number of ended actions of all, and the action that started last. Draws nothing in other
/// styles.
class ProgressBar
{
public:
    ProgressBar(ProgressStyle style, size_t count);
    /// Erases the bar.
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void started(const std::string& what);
    void ended();
    /// Set the number of ended actions, if the caller counts them.
    void show(size_t ended, const std::string& what);

private:
    void draw();

    bool is_shown_;
    size_t count_;
    size_t ended_ = 0;
    std::string what_;
    std::chrono::steady_clock::time_point last_drawn_{};
};

/// Erase the bar before a message is printed. The next step draws it again.
void clearBar();

/// Return "[######    ]  31/812  clusters rock.glb", cut to `columns`.
std::string barText(size_t ended, size_t count, const std::string& what, size_t columns);

} // namespace hearth::command
