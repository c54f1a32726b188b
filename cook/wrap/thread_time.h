// Processor time of a thread.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <ctime>

namespace hearth::wrap
{

/// Return the processor time that the calling thread has used, in seconds.
inline double threadSeconds()
{
    timespec time{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace hearth::wrap
