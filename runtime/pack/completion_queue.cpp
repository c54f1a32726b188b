// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/completion_queue.h"

#include <algorithm>
#include <utility>

namespace hearth::pack
{

CompletionQueue::CompletionQueue(size_t max_size, std::function<void(uint32_t page)> finish)
    : finish_(std::move(finish))
{
    pushed_.reserve(max_size);
    taken_.reserve(max_size);
}

void CompletionQueue::push(Completion completion)
{
    if (completion.ok && finish_ != nullptr)
        finish_(completion.page);
    const std::lock_guard lock(mutex_);
    pushed_.push_back(completion);
}

std::span<const Completion> CompletionQueue::take()
{
    taken_.clear();
    {
        const std::lock_guard lock(mutex_);
        taken_.swap(pushed_);
    }
    std::sort(taken_.begin(), taken_.end(),
              [](const Completion& a, const Completion& b) { return a.page < b.page; });
    return taken_;
}

} // namespace hearth::pack
