// Tests streaming with a simulated device: resident pages lie in the pool as they were cooked, for any
// reading threads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/cut.h"
#include "runtime/pack/page_stream.h"
#include "tests/support/sanitized.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <condition_variable>
#include <deque>
#include <gtest/gtest.h>
#include <optional>
#include <tbb/global_control.h>
#include <thread>

namespace hearth::test
{

namespace
{

using formats::PackView;

// One task at a time: the cooker's tasks are not tested here, and the thread sanitizer cannot see TBB's own
// synchronisation.
const tbb::global_control one_task_at_a_time(tbb::global_control::max_allowed_parallelism, 1);

mesh::SourceMesh plain(mesh::SourceMesh mesh)
{
    return withMaterial(std::move(mesh), kInvalidIndex);
}

/// Reads pages on some threads, in the order of their scheduling.
class ReadingThreads
{
public:
    ReadingThreads(const PackView& view, uint32_t bad_page) : view_(view), bad_page_(bad_page)
    {
        for (int i = 0; i < 3; ++i)
            threads_.emplace_back([this] { work(); });
    }

    ~ReadingThreads()
    {
        {
            const std::lock_guard lock(mutex_);
            ends_ = true;
        }
        wake_.notify_all();
        for (std::thread& thread : threads_)
            thread.join();
    }

    pack::PageReader reader()
    {
        return [this](uint32_t page, std::span<std::byte> destination, pack::ReadDone done)
        {
            {
                const std::lock_guard lock(mutex_);
                reads_.push_back({page, destination, done});
            }
            wake_.notify_one();
        };
    }

private:
    struct Read
    {
        uint32_t page;
        std::span<std::byte> destination;
        pack::ReadDone done;
    };

    std::optional<Read> next()
    {
        std::unique_lock lock(mutex_);
        wake_.wait(lock, [this] { return ends_ || !reads_.empty(); });
        if (reads_.empty())
            return std::nullopt;
        const Read read = reads_.front();
        reads_.pop_front();
        return read;
    }

    void work()
    {
        while (const auto read = next())
            read->done(read->page != bad_page_ && view_.decodePage(read->page, read->destination).ok());
    }

    const PackView& view_;
    uint32_t bad_page_;
    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<Read> reads_;
    bool ends_ = false;
    std::vector<std::thread> threads_;
};

/// Simulated device with slots in plain memory. Frames run when they complete, in order, some frames late as
/// on a device: the data that they copy and read must still be there.
class FakeDevice
{
public:
    FakeDevice(const PackView& view, const pack::PageGraph& graph, uint32_t slot_count, uint32_t parts = 0,
               uint32_t part_slots = 0)
        : view_(view),
          graph_(graph),
          slot_count_(slot_count),
          parts_(parts),
          part_slots_(part_slots),
          pool_((size_t{slot_count} + parts * part_slots) * formats::kMaxPageBytes),
          staging_(size_t{6} * formats::kMaxPageBytes)
    {
        for (uint32_t page = 0; page < view.pages().size(); ++page)
        {
            auto bytes = view.decodePage(page);
            HEARTH_ASSERT(bytes.ok());
            expected_.push_back(std::move(*bytes));
        }
    }

    pack::PageStream makeStream(pack::PageReader read)
    {
        auto stream = pack::PageStream::create(
            view_, graph_.withSlotSize(formats::kMaxPageBytes),
            {.residency = {.budget_bytes =
                               graph_.pinnedBytes() + uint64_t{slot_count_} * formats::kMaxPageBytes,
                           .max_loads = 8},
             .slot_count = slot_count_,
             .movable_parts = parts_,
             .part_slots = part_slots_,
             .slot_bytes = formats::kMaxPageBytes,
             .read = std::move(read)},
            staging_);
        HEARTH_ASSERT(stream.ok());
        return std::move(*stream);
    }

    /// Submit frame `serial`, which copies the pages that have been read and draws the resident ones.
    void submit(uint64_t serial, const pack::StreamChanges& changes, const pack::PageStream& stream)
    {
        Frame frame{serial,
                    {changes.uploads.begin(), changes.uploads.end()},
                    {changes.moves.begin(), changes.moves.end()},
                    {}};
        for (uint32_t page = 0; page < view_.pages().size(); ++page)
            if (stream.residency().isResident(page) && !graph_.isPinned(page))
                frame.drawn.emplace_back(page, stream.pageSlot(page));
        frames_.push_back(std::move(frame));
    }

    void completeUpTo(uint64_t serial)
    {
        for (; !frames_.empty() && frames_.front().serial <= serial; frames_.pop_front())
        {
            for (const auto& [page, slot, staging_slot] : frames_.front().uploads)
                std::copy_n(getSlot(staging_, staging_slot), view_.pages()[page].size, getSlot(pool_, slot));
            for (const auto& [page, from_slot, slot] : frames_.front().moves)
                std::copy_n(getSlot(pool_, from_slot), view_.pages()[page].size, getSlot(pool_, slot));
            for (const auto& [page, slot] : frames_.front().drawn)
                EXPECT_TRUE(std::equal(expected_[page].begin(), expected_[page].end(), getSlot(pool_, slot)))
                    << page;
        }
    }

    /// Give the memory of a part to others, who overwrite it.
    void freePart(uint32_t part)
    {
        std::fill_n(getSlot(pool_, slot_count_ + (part - 1) * part_slots_),
                    size_t{part_slots_} * formats::kMaxPageBytes, std::byte{0xA5});
    }

private:
    const PackView& view_;
    const pack::PageGraph& graph_;
    struct Frame
    {
        uint64_t serial;
        std::vector<pack::PageUpload> uploads;
        std::vector<pack::PageMove> moves;
        std::vector<std::pair<uint32_t, uint32_t>> drawn; ///< page and slot
    };

    static std::vector<std::byte>::iterator getSlot(std::vector<std::byte>& memory, uint32_t slot)
    {
        return memory.begin() + static_cast<ptrdiff_t>(slot) * formats::kMaxPageBytes;
    }

    uint32_t slot_count_, parts_, part_slots_;
    std::vector<std::vector<std::byte>> expected_; ///< each page as it was cooked
    std::vector<std::byte> pool_, staging_;
    std::deque<Frame> frames_;
};

} // namespace

TEST(CompletionQueue, bringsEachCompletionOnceFromAnyThread)
{
    constexpr uint32_t kThreads = 4, kEach = 2000;
    pack::CompletionQueue queue(kThreads * kEach);
    std::vector<std::thread> threads;
    for (uint32_t t = 0; t < kThreads; ++t)
        threads.emplace_back(
            [&queue, t]
            {
                for (uint32_t i = 0; i < kEach; ++i)
                    queue.push({i * kThreads + t, i % 3 == 0});
            });
    std::vector<uint32_t> seen(size_t{kThreads} * kEach, 0);
    for (size_t taken = 0; taken < seen.size();)
    {
        const auto completions = queue.take();
        for (size_t i = 0; i < completions.size(); ++i)
        {
            ++seen[completions[i].page];
            EXPECT_EQ(completions[i].ok, completions[i].page / kThreads % 3 == 0);
            EXPECT_TRUE(i == 0 || completions[i - 1].page < completions[i].page);
        }
        taken += completions.size();
    }
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(seen, std::vector<uint32_t>(seen.size(), 1));
    EXPECT_TRUE(queue.take().empty());
}

TEST(ResidentGroups, areThoseOfTheWholeRuleAfterEachChange)
{
    TestScene scene;
    scene.addHierarchy(clusters::buildHierarchy(
        plain(shapes::rock(60, 0.3f)),
        std::vector{plain(shapes::rock(36, 0.3f)), plain(shapes::rock(20, 0.28f))}, {}));
    const PackView view = scene.build();
    std::mt19937 random(3);
    pack::ResidentGroups groups(view);
    std::vector<uint8_t> pages(view.pages().size(), 0), reported(view.groups().size(), 0);
    for (size_t i = 0; i < trials(400); ++i)
    {
        const auto page = static_cast<uint32_t>(random() % pages.size());
        pages[page] ^= 1;
        if (pages[page] != 0)
            groups.add(page);
        else
            groups.remove(page);
        for (const auto& [group, resident] : groups.changes())
        {
            EXPECT_NE(reported[group] != 0, resident) << "only changes are reported";
            reported[group] = resident ? 1 : 0;
        }
        groups.clearChanges();
        ASSERT_EQ(reported, pack::residentGroups(view, pages));
        for (uint32_t group = 0; group < reported.size(); ++group)
            ASSERT_EQ(groups.isResident(group), reported[group] != 0);
    }
}

TEST(PageStream, bringsEveryResidentPageToItsSlotWhateverThreadsReadIt)
{
    TestScene scene;
    scene.addMesh(plain(shapes::rock(96, 0.3f)));
    const PackView view = scene.build();
    const pack::PageGraph graph = pack::PageGraph::of(view);
    ASSERT_GT(graph.pageCount(), 20u);
    const uint32_t bad_page = graph.pageCount() / 2; // the coarser half of the pages does not need it
    // with fewer, none of the finest pages would fit with all that they need
    FakeDevice device(view, graph, graph.pageCount() * 2 / 3);
    ReadingThreads threads(view, bad_page);
    pack::PageStream stream = device.makeStream(threads.reader());
    std::mt19937 random(5);
    uint64_t failures = 0;
    uint64_t serial = 0;
    const auto frame = [&](uint32_t wanted)
    {
        ++serial;
        const uint64_t completed = serial < 3 ? 0 : serial - 3;
        device.completeUpTo(completed);
        const pack::StreamChanges changes = stream.beginFrame(serial, completed);
        failures += changes.failed.size();
        device.submit(serial, changes, stream);
        for (uint32_t i = 0; i < wanted; ++i)
            stream.request(static_cast<uint32_t>(random() % graph.pageCount()), uniform(random, 1, 16));
        stream.schedule(serial - 1);
        EXPECT_LE(stream.statistics().bytes_in_use, stream.statistics().budget_bytes);
    };
    // threads take their time: run frames until enough pages have come and gone
    constexpr uint64_t kEnough = uint64_t{kSanitized ? 20 : 100} * formats::kMaxPageBytes;
    while ((stream.statistics().bytes_streamed < kEnough || failures == 0) && serial < 50000 &&
           !testing::Test::HasFailure())
    {
        frame(3);
        std::this_thread::yield();
    }
    EXPECT_GE(stream.statistics().bytes_streamed, kEnough);
    while (stream.readsInFlight() > 0)
        frame(0);
    EXPECT_EQ(failures, 1u) << "the page that cannot be read is reported once";
    EXPECT_EQ(stream.statistics().failures, 1u);
}

/// Parts of a pool that are opened and closed at random, and freed when no frame reads them.
class RandomParts
{
public:
    static constexpr uint32_t kParts = 3, kSlots = 6;

    RandomParts(FakeDevice& device, pack::PageStream& stream, std::mt19937& random)
        : device_(device), stream_(stream), random_(random)
    {
    }

    /// Change parts in frame `serial`, which has been begun.
    void frame(uint64_t serial, uint64_t completed)
    {
        for (uint32_t part = 1; part <= kParts; ++part)
        {
            Part& state = parts_[part - 1];
            if (state.slots == 0 && random_() % 16 == 0)
            {
                state.slots = 1 + static_cast<uint32_t>(random_() % kSlots);
                stream_.openPart(part, state.slots);
            }
            else if (state.slots > 0 && !state.is_closing && random_() % 32 == 0)
            {
                stream_.closePart(part);
                state.is_closing = true;
            }
            else if (state.is_closing && state.last_serial == 0 && stream_.isPartFree(part))
                state.last_serial = serial - 1;
            else if (state.last_serial > 0 && state.last_serial <= completed)
            {
                device_.freePart(part);
                state = {};
                ++freed;
            }
        }
        uint32_t open = 0;
        for (const Part& part : parts_)
            open += part.is_closing ? 0 : part.slots;
        stream_.setDemandSlots(open);
    }

    size_t freed = 0;

private:
    struct Part
    {
        uint32_t slots = 0;
        bool is_closing = false;
        uint64_t last_serial = 0; ///< last frame that reads it; 0: not known yet
    };

    FakeDevice& device_;
    pack::PageStream& stream_;
    std::mt19937& random_;
    std::array<Part, kParts> parts_;
};

TEST(PageStream, losesNoPageWhilePartsOfThePoolComeAndGo)
{
    TestScene scene;
    scene.addMesh(plain(shapes::rock(72, 0.3f)));
    const PackView view = scene.build();
    const pack::PageGraph graph = pack::PageGraph::of(view);
    std::mt19937 random(9);
    size_t moves = 0, freed = 0, failures = 0;
    for (size_t history = 0; history < trials(8) && !testing::Test::HasFailure(); ++history)
    {
        FakeDevice device(view, graph, 2, RandomParts::kParts, RandomParts::kSlots);
        std::deque<std::tuple<uint32_t, std::span<std::byte>, pack::ReadDone>> reads;
        pack::PageStream stream =
            device.makeStream([&](uint32_t page, std::span<std::byte> destination, pack::ReadDone done)
                              { reads.emplace_back(page, destination, done); });
        RandomParts parts(device, stream, random);
        uint64_t completed = 0;
        std::vector<uint32_t> wanted;
        for (uint64_t serial = 1; serial < 400; ++serial)
        {
            completed = std::max(completed, serial - 1 - std::min<uint64_t>(random() % 4, serial - 1));
            device.completeUpTo(completed);
            const pack::StreamChanges changes = stream.beginFrame(serial, completed);
            moves += changes.moves.size();
            failures += changes.failed.size();
            device.submit(serial, changes, stream);
            parts.frame(serial, completed);
            if (serial % 16 == 1)
                wanted = {static_cast<uint32_t>(random() % graph.pageCount()),
                          static_cast<uint32_t>(random() % graph.pageCount())};
            for (const uint32_t page : wanted)
                stream.request(page, uniform(random, 1, 16));
            stream.schedule(serial);
            if (random() % 64 == 0)
                stream.retryFailed();
            for (size_t count = random() % (reads.size() + 1); count > 0; --count, reads.pop_front())
            {
                const auto& [page, destination, done] = reads.front();
                done(random() % 32 != 0 && view.decodePage(page, destination).ok());
            }
        }
        device.completeUpTo(400);
        freed += parts.freed;
    }
    EXPECT_GT(moves, trials(60));
    EXPECT_GT(freed, trials(30));
    EXPECT_GT(failures, kSanitized ? 0u : 5u);
}

TEST(PageStream, settlesWhenAFrameHasAllThatItWants)
{
    TestScene scene;
    scene.addMesh(plain(shapes::rock(72, 0.3f)));
    const PackView view = scene.build();
    const pack::PageGraph graph = pack::PageGraph::of(view);
    FakeDevice device(view, graph, graph.pageCount());
    pack::PageStream stream =
        device.makeStream([&](uint32_t page, std::span<std::byte> destination, pack::ReadDone done)
                          { done(view.decodePage(page, destination).ok()); });
    uint64_t serial = 0;
    const auto frame = [&](uint32_t last_page)
    {
        ++serial;
        device.completeUpTo(serial - 1);
        device.submit(serial, stream.beginFrame(serial, serial - 1), stream);
        for (uint32_t page = 0; page <= last_page; ++page)
            stream.request(page, 2);
        if (serial > 1)
            stream.schedule(serial - 1);
    };
    const auto settle = [&](uint32_t last_page)
    {
        const uint64_t first = serial + 1;
        while (stream.settledSerial() < first && serial < first + 100)
            frame(last_page);
        EXPECT_LT(serial, first + 100);
        for (uint32_t page = 0; page <= last_page; ++page)
            EXPECT_TRUE(stream.residency().isResident(page));
    };
    settle(graph.pageCount() / 2);
    const uint64_t streamed = stream.statistics().bytes_streamed;
    settle(graph.pageCount() / 2);
    EXPECT_EQ(stream.statistics().bytes_streamed, streamed);
    settle(graph.pageCount() - 1);
    EXPECT_EQ(stream.statistics().pages_resident, graph.pageCount());
    EXPECT_EQ(stream.readsInFlight(), 0u);
}

} // namespace hearth::test
