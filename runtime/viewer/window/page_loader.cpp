// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/page_loader.h"

#include <utility>

namespace hearth::viewer
{

PageLoader::PageLoader(Decode decode) : decode_(std::move(decode)), thread_([this] { work(); }) {}

PageLoader::~PageLoader()
{
    {
        const std::scoped_lock lock(mutex_);
        stopping_ = true;
    }
    changed_.notify_one();
    thread_.join();
}

pack::PageReader PageLoader::reader()
{
    return [this](uint32_t page, std::span<std::byte> destination, pack::ReadDone done)
    {
        {
            const std::scoped_lock lock(mutex_);
            queue_.push_back({page, destination, done});
        }
        changed_.notify_one();
    };
}

void PageLoader::work()
{
    for (;;)
    {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return stopping_ || !queue_.empty(); });
        if (stopping_)
            return;
        const Read read = queue_.front();
        queue_.pop_front();
        lock.unlock();
        read.done(decode_(read.page, read.destination));
    }
}

} // namespace hearth::viewer
