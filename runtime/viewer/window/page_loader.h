// Reads pages beside the frames, on a thread of its own.
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

/// For one stream, which outlives it: once it is gone, all reads have ended or never will.
class PageLoader
{
public:
    /// Decodes a page into memory of its size; false where it cannot be read. Called on the loader's thread.
    using Decode = std::function<bool(uint32_t page, std::span<std::byte> destination)>;

    explicit PageLoader(Decode decode);
    ~PageLoader();
    PageLoader(const PageLoader&) = delete;
    PageLoader& operator=(const PageLoader&) = delete;

    /// Refers to the loader.
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
    std::deque<Read> waiting_; ///< in the order in which they were asked for
    bool ending_ = false;
    std::thread thread_; ///< last: it starts with everything else in place
};

} // namespace hearth::viewer
