// The pack on the device: streamed within a budget, drawn with shadows and lamps into an image of its own.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "gpu.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

namespace game
{

/// Reads pages on a thread of its own; or at once, so that each run of a recording draws the same pictures.
class PageReader
{
public:
    PageReader(const hearth::Pack& pack, bool at_once);
    ~PageReader();
    /// The reader as Hearth calls it; `user` is the reader.
    static void read(void* user, uint32_t page, void* destination, size_t size, hearth_page_read read);

private:
    struct Request
    {
        uint32_t page;
        void* destination;
        size_t size;
        hearth_page_read read;
    };
    void decode(const Request& request) const;
    void work();

    const hearth::Pack& pack_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Request> requests_;
    bool is_ending_ = false;
    std::thread thread_; ///< last: it uses all the others
};

class World
{
public:
    /// is_replay  the pictures depend on no timing
    World(Gpu& gpu, const hearth::Pack& pack, uint32_t width, uint32_t height, bool is_replay);
    /// Record a frame into the images.
    void record(VkCommandBuffer commands, const hearth_frame& frame);
    /// Read the pages that a view needs before it is shown.
    void prefetch(const hearth_frame& frame);

    const hearth_targets_info& images() const { return images_; }
    hearth_stream_counters counters() const;

private:
    void check(hearth_result result) const { game::check(result, renderer_.lastError()); }

    Gpu& gpu_;
    hearth::Renderer renderer_;
    PageReader reader_;
    hearth::Scene scene_;
    hearth::Targets targets_;
    hearth_targets_info images_ = HEARTH_TARGETS_INFO_INIT;
};

} // namespace game
