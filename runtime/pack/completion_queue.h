// Brings the ends of page reads from whatever thread they happen on to the one that draws.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <mutex>
#include <span>
#include <vector>

namespace hearth::pack
{

struct Completion
{
    uint32_t page = 0;
    bool ok = false;
};

/// A lock is held for a push or a swap of two vectors, never while anything is read or decoded.
class CompletionQueue
{
public:
    /// most  completions that are in the queue at once; nothing is allocated after this
    explicit CompletionQueue(size_t most);

    /// From any thread. What was written before is seen by the thread that takes the completion.
    void push(Completion completion);

    /// From one thread: what has been pushed since, by rising page, so that the order in which threads came does not
    /// show. Holds until the next call.
    std::span<const Completion> take();

private:
    std::mutex mutex_;
    std::vector<Completion> pushed_; ///< guarded by mutex_
    std::vector<Completion> taken_;
};

} // namespace hearth::pack
