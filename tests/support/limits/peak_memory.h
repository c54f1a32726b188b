// Measures how much memory a piece of work takes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace hearth::test
{

/// Return by how many MiB `work` raises the peak of resident memory, 254 at most; nullopt if it returns false
/// or crashes. It runs in a child process, so that nothing before it counts.
inline std::optional<int> measurePeak_mib(const std::function<bool()>& work)
{
    constexpr long kMaxMib = 254;
    constexpr int kFailed = 255;
    const pid_t child = ::fork();
    if (child == 0)
    {
        const auto peak_kib = []
        {
            rusage usage{};
            ::getrusage(RUSAGE_SELF, &usage);
            return usage.ru_maxrss;
        };
        const long before = peak_kib();
        const bool is_done = work();
        ::_exit(is_done ? static_cast<int>(std::min(kMaxMib, (peak_kib() - before) / 1024)) : kFailed);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    if (!WIFEXITED(status) || WEXITSTATUS(status) == kFailed)
        return std::nullopt;
    return WEXITSTATUS(status);
}

} // namespace hearth::test
