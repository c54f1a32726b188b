// Option --jobs of cookers: limits the threads that TBB uses.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>
#include <optional>
#include <tbb/global_control.h>

namespace hearth::cli
{

/// Limits the threads of the process while it lives.
class ThreadLimit
{
public:
    /// jobs  0: as many threads as the machine has cores
    explicit ThreadLimit(size_t jobs)
    {
        if (jobs > 0)
            limit_.emplace(tbb::global_control::max_allowed_parallelism, jobs);
    }

private:
    std::optional<tbb::global_control> limit_;
};

} // namespace hearth::cli
