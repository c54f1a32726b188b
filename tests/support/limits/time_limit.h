// Ends a test program that waits for ever.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <unistd.h>

namespace hearth::test
{

/// Ends the process by SIGALRM unless it is destroyed in time. One may exist at a time.
class TimeLimit
{
public:
    explicit TimeLimit(unsigned seconds) { ::alarm(seconds); }
    TimeLimit(const TimeLimit&) = delete;
    TimeLimit& operator=(const TimeLimit&) = delete;
    ~TimeLimit() { ::alarm(0); }
};

} // namespace hearth::test
