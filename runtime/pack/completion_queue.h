// Queue of finished page reads: any thread pushes, the render thread takes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstdint>
#include <functional>
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

/// Thread-safe queue. The lock is held for a push or a swap of two vectors, never during a read or decode.
class CompletionQueue
{
public:
    /// max_size  maximum of queued completions; later calls allocate nothing
    /// finish    called by push with the page of a read that succeeded, before its completion is queued and
    ///           without the lock; null: nothing is left to do
    explicit CompletionQueue(size_t max_size, std::function<void(uint32_t page)> finish = nullptr);

    /// Push a completion, from any thread. Writes before the push are visible to the thread that takes it.
    void push(Completion completion);

    /// Take the completions pushed since the last call, from one thread. They are sorted by page, so that
    /// thread timing does not affect the result. The span is valid until the next call.
    std::span<const Completion> take();

private:
    std::function<void(uint32_t page)> finish_;
    std::mutex mutex_;
    std::vector<Completion> pushed_; ///< guarded by mutex_
    std::vector<Completion> taken_;
};

} // namespace hearth::pack
