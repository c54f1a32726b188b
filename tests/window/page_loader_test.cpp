// Tests the asynchronous page loader.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/viewer/window/page_loader.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace hearth::test
{

namespace
{

// One task at a time: the cooker's tasks are not tested here, and the thread sanitizer cannot see TBB's own
// synchronisation.
const tbb::global_control one_task_at_a_time(tbb::global_control::max_allowed_parallelism, 1);

formats::PackView makePack(TestScene& scene)
{
    scene.addInstance(scene.addMesh(withMaterial(shapes::rock(40, 0.2f), kInvalidIndex)), {});
    return scene.build();
}

class LoadedPages : public testing::Test
{
protected:
    LoadedPages()
    {
        for (const formats::PageRecord& page : pack_.pages())
            memory_.emplace_back(page.size);
    }

    /// Read all pages; returns the success of each.
    std::vector<bool> readAll()
    {
        pack::CompletionQueue queue(memory_.size());
        viewer::PageLoader loader(decode_);
        const pack::PageReader reader = loader.reader();
        for (uint32_t page = 0; page < memory_.size(); ++page)
            reader(page, memory_[page], pack::ReadDone(queue, page));
        std::vector<bool> ok(memory_.size());
        for (size_t ended = 0; ended < memory_.size(); std::this_thread::yield())
            for (const pack::Completion& completion : queue.take())
            {
                ok[completion.page] = completion.ok;
                ++ended;
            }
        return ok;
    }

    TestScene test_;
    formats::PackView pack_ = makePack(test_);
    viewer::PageLoader::Decode decode_ = [this](uint32_t page, std::span<std::byte> destination)
    { return pack_.decodePage(page, destination).ok(); };
    std::vector<std::vector<std::byte>> memory_;
};

} // namespace

TEST_F(LoadedPages, areThoseOfThePack)
{
    ASSERT_GT(memory_.size(), 2u);
    EXPECT_EQ(readAll(), std::vector<bool>(memory_.size(), true));
    for (uint32_t page = 0; page < memory_.size(); ++page)
        EXPECT_EQ(memory_[page], *pack_.decodePage(page));
}

TEST_F(LoadedPages, thatCannotBeReadAreTold)
{
    memory_[1].pop_back(); // not the page's size: rejected
    std::vector<bool> expected(memory_.size(), true);
    expected[1] = false;
    EXPECT_EQ(readAll(), expected);
}

TEST_F(LoadedPages, areLeftWhenTheLoaderEnds)
{
    for (int i = 0; i < 50; ++i)
    {
        pack::CompletionQueue queue(memory_.size());
        std::vector<std::vector<std::byte>> memory = memory_;
        {
            viewer::PageLoader loader(decode_);
            for (uint32_t page = 0; page < memory.size(); ++page)
                loader.reader()(page, memory[page], pack::ReadDone(queue, page));
        }
        // nothing writes to the freed memory; the sanitizers would report it
        EXPECT_LE(queue.take().size(), memory.size());
    }
}

} // namespace hearth::test
