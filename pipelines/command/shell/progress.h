// How far a cook is, on stderr: a bar at the bottom of a terminal, or lines (progress_lines.h).
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
    plain, ///< lines, as ProgressLines has them
    bar,   ///< one line that changes
};

/// "auto": a bar where stderr is a terminal that can move its cursor, else plain lines. "bar", "plain", "none".
ProgressStyle progressStyle(const std::string& name);

/// The bar: how many of how many actions have ended, and which was last at work. Nothing for the other styles.
class ProgressBar
{
public:
    ProgressBar(ProgressStyle style, size_t count);
    /// Takes the bar away.
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void started(const std::string& what);
    void ended();
    /// How many have ended, where that is counted elsewhere.
    void show(size_t ended, const std::string& what);

private:
    void draw();

    bool is_shown_;
    size_t count_;
    size_t ended_ = 0;
    std::string what_;
    std::chrono::steady_clock::time_point last_drawn_{};
};

/// Take a bar that is shown away before a message is printed; it comes back with the next step.
void clearBar();

/// "[######    ]  31/812  clusters rock.glb", cut to `columns`.
std::string barText(size_t ended, size_t count, const std::string& what, size_t columns);

} // namespace hearth::command
