// One memory budget: what is seen decides whether geometry or textures have it, and no frame shows that
// it moves.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/textures/streamed_textures.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <algorithm>
#include <deque>
#include <random>

namespace hearth::test
{

namespace
{

using namespace formats;

/// Rocks of many triangles without textures, and beside them a wall of rectangles with a texture each.
class MemoryExchangeDraw : public GpuTest
{
protected:
    void SetUp() override
    {
        GpuTest::SetUp();
        if (IsSkipped())
            return;
        const uint32_t stone = test_.addMaterial(plainMaterial());
        for (uint32_t i = 0; i < 3; ++i)
            test_.addInstance(test_.addMesh(withMaterial(shapes::rock(52, 0.3f, 1 + i), stone)),
                              translated({2.2f * static_cast<float>(i), 0, 60}));
        for (uint32_t row = 0; row < 3; ++row)
            for (uint32_t column = 0; column < 3; ++column)
                addPainting(row, column);
        pack_.emplace(test_.build());
        whole_ = upload(*pack_);
        targets_.emplace(makeTargets(kOptions.width, kOptions.height));
    }

    void addPainting(uint32_t row, uint32_t column)
    {
        constexpr uint32_t kSide = 256;
        std::vector<uint32_t> texels;
        for (uint32_t side = kSide; side > 0; side /= 2)
            for (uint32_t i = 0; i < side * side; ++i)
                texels.push_back(0xFF000000u | (random_() & 0xFFFFFFu));
        MaterialRecord material = plainMaterial();
        material.flags = kMaterialUnlit | kMaterialDoubleSided;
        material.base_color = {1, 1, 1, 1};
        material.base_color_texture =
            makeTextureRef(test_.addImage(TexelFormat::rgba8_srgb, kSide, kSide, texels));
        const uint32_t mesh = test_.addMesh(withMaterial(makeQuad(2, 2), test_.addMaterial(material)));
        test_.addInstance(mesh,
                          translated({2.1f * static_cast<float>(column), 2.1f * static_cast<float>(row), 0}));
    }

    void stream(uint64_t budget)
    {
        reads_.clear();
        budget_ = budget;
        const auto read = [this](uint32_t page, std::span<std::byte> destination, pack::ReadDone done) {
            reads_.push_back({page, destination, done});
        };
        streamed_ =
            upload(*pack_, {.frames_in_flight = 3, .memory_budget = budget, .stream = {.read = read}});
        serial_ = completed_ = 0;
    }

    /// Begin a frame, while up to two before it are said to run. Returns whether pages move.
    bool beginFrame()
    {
        ++serial_;
        completed_ = std::max(completed_, serial_ - 1 - std::min<uint64_t>(random_() % 3, serial_ - 1));
        const std::vector<uint32_t> before = slots();
        streamed_->stream->beginFrame(serial_, completed_);
        const std::vector<uint32_t> after = slots();
        uint32_t moved = 0;
        for (size_t page = 0; page < before.size(); ++page)
            if (before[page] != after[page] && before[page] != kInvalidIndex && after[page] != kInvalidIndex)
                ++moved;
        moved_pages_ += moved;
        return moved > 0;
    }

    /// End a frame that has been recorded.
    void endFrame()
    {
        std::shuffle(reads_.begin(), reads_.end(), random_);
        for (size_t count = random_() % (reads_.size() + 1); count > 0; --count, reads_.pop_back())
            reads_.back().done(pack_->decodePage(reads_.back().page, reads_.back().destination).ok());
        const gpu::TextureStatistics textures = streamed_->textures->statistics();
        EXPECT_LE(streamed_->buffers.pool.bytes() + textures.bytes_on_device, budget_);
        EXPECT_LE(statistics().budget_bytes + textures.budget_bytes, budget_);
    }

    void prefetch(const shared::Camera& camera)
    {
        const auto record = [&](VkCommandBuffer commands)
        {
            renderer().recordPrefetch(commands, *streamed_, *targets_,
                                      makeView(*streamed_, camera, kOptions));
            return success();
        };
        EXPECT_TRUE(host().run(record).ok());
        endFrame();
    }

    Image drawFrame(const shared::Camera& camera)
    {
        Image image = draw(*streamed_, camera, kOptions);
        endFrame();
        return image;
    }

    std::vector<uint32_t> slots() const
    {
        std::vector<uint32_t> slots;
        for (uint32_t page = 0; page < pack_->pages().size(); ++page)
            slots.push_back(streamed_->stream->pages().pageSlot(page));
        return slots;
    }

    const pack::StreamStatistics& statistics() const { return streamed_->stream->statistics(); }

    /// Run frames until nothing changes any more. Once geometry is settled, and while its share holds
    /// what the view wants, frames that move pages must show the triangles of full residency.
    void settle(const shared::Camera& camera, bool fits)
    {
        const uint64_t first = serial_ + 1;
        const Image expected = draw(*whole_, camera, kOptions);
        bool has_room = true;
        while (serial_ < first + 1500 && streamed_->stream->settledSerial() < first)
        {
            const bool is_there =
                streamed_->stream->pages().settledSerial() >= first && statistics().error_scale == 1;
            const bool moves = beginFrame();
            const pack::Residency& pages = streamed_->stream->pages().residency();
            has_room = has_room && pages.graph().pinnedBytes() + pages.wantedBytes() <= pages.budgetBytes();
            after_moves_ = moves ? 3 : after_moves_ - std::min(after_moves_, 1u);
            if (!is_there || !has_room || after_moves_ == 0)
            {
                prefetch(camera);
                continue;
            }
            EXPECT_EQ(drawFrame(camera).seen(), expected.seen()) << serial_;
            ++compared_frames_;
        }
        EXPECT_LT(serial_, first + 1500);
        if (!fits)
            return;
        EXPECT_EQ(statistics().error_scale, 1);
        EXPECT_EQ(streamed_->textures->statistics().error_scale, 1);
        beginFrame();
        const Image image = drawFrame(camera);
        EXPECT_EQ(image.seen(), expected.seen());
        EXPECT_TRUE(image.color == expected.color);
    }

    /// Return the bytes that a view wants beside what is always resident: of pages, and of mips.
    std::array<uint64_t, 2> measure(const shared::Camera& camera)
    {
        stream(uint64_t{1} << 30);
        settle(camera, true);
        return {streamed_->stream->pages().residency().wantedBytes(),
                streamed_->textures->stream().residency().wantedBytes()};
    }

    uint64_t pinnedBytes() const
    {
        return streamed_->stream->pages().residency().graph().pinnedBytes() +
               streamed_->textures->stream().graph().nodes().pinnedBytes();
    }

    struct Read
    {
        uint32_t page;
        std::span<std::byte> destination;
        pack::ReadDone done;
    };

    inline static const DrawOptions kOptions{.width = 320, .height = 240, .error_pixels = 0.125f};
    inline static const shared::Camera kRocks{.position = {2.2f, 0, 63.2f}, .target = {2.2f, 0, 60}};
    inline static const shared::Camera kWall{.position = {2.1f, 2.1f, 5}, .target = {2.1f, 2.1f, 0}};
    /// The back of the wall, with the rocks far behind it.
    inline static const shared::Camera kBoth{.position = {2.1f, 2.1f, -5}, .target = {2.1f, 2.1f, 0}};
    std::mt19937 random_{7};
    TestScene test_;
    std::optional<PackView> pack_;
    std::deque<Read> reads_;
    std::unique_ptr<gpu::Scene> whole_, streamed_;
    uint64_t budget_ = 0, serial_ = 0, completed_ = 0;
    uint32_t moved_pages_ = 0, after_moves_ = 0, compared_frames_ = 0;
    std::optional<gpu::FrameTargets> targets_;
};

TEST_F(MemoryExchangeDraw, aViewOfTrianglesOrOfTexelsHasMoreThanHalf)
{
    const auto rocks = measure(kRocks), wall = measure(kWall), both = measure(kBoth);
    const uint64_t most = std::max({rocks[0] + rocks[1], wall[0] + wall[1], both[0] + both[1]});
    const uint64_t rest = most * 5 / 4;
    ASSERT_GT(rocks[0], rest * 9 / 20) << "half of the budget would do for any view";
    ASSERT_GT(wall[1], rest / 2);
    stream(pinnedBytes() + rest);
    ASSERT_NE(streamed_->stream->exchange(), nullptr);
    for (const shared::Camera* view : {&kBoth, &kRocks, &kWall, &kBoth})
        settle(*view, true);
    EXPECT_GT(moved_pages_, 0u);
    EXPECT_GT(compared_frames_, 0u);
}

} // namespace

} // namespace hearth::test
