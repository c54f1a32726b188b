// Asynchronous page reads on a thread of their own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "runtime/pack/page_stream.h"

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <span>
#include <thread>

namespace hearth::viewer
{

/// Loader for one stream, which outlives it. After its destruction all reads have ended or are cancelled.
class PageLoader
{
public:
    /// Decodes a page into memory of its size; false if it cannot be read. Called on the loader's thread.
    using Decode = std::function<bool(uint32_t page, std::span<std::byte> destination)>;

    explicit PageLoader(Decode decode);
    ~PageLoader();
    PageLoader(const PageLoader&) = delete;
    PageLoader& operator=(const PageLoader&) = delete;

    /// The reader refers to the loader.
    pack::PageReader reader();

private:
    struct Read
    {
        uint32_t page;
        std::span<std::byte> destination;
        pack::ReadDone done;
    };
    void work();

    Decode decode_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Read> queue_; ///< in request order
    bool stopping_ = false;
    std::thread thread_; ///< last member: starts after everything else is initialized
};

} // namespace hearth::viewer
