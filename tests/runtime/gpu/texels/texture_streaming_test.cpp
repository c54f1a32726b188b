// Streamed textures end as if all mips were resident, within any budget, whatever the device and reads do.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/textures/streamed_textures.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <bit>
#include <deque>
#include <random>

namespace hearth::test
{

namespace
{

using namespace formats;

constexpr uint32_t kRows = 5, kColumns = 4;

/// Return a block of ASTC with one colour: random bits are mostly no block.
std::array<std::byte, 16> makeAstcBlock(std::mt19937& random)
{
    std::array<std::byte, 16> block;
    for (size_t i = 0; i < block.size(); ++i)
        block[i] = static_cast<std::byte>(i == 0 ? 0xFCu : i == 1 ? 0xFDu : i < 8 ? 0xFFu : random() & 0xFFu);
    return block;
}

/// Wall of quads with a texture each, of several formats and sizes: also of those that a device decodes,
/// ASTC and ETC2 on desktops.
class TextureStreaming : public GpuTest
{
protected:
    void SetUp() override
    {
        GpuTest::SetUp();
        if (IsSkipped())
            return;
        for (uint32_t row = 0; row < kRows; ++row)
            for (uint32_t column = 0; column < kColumns; ++column)
                addQuad(row, column);
        pack_.emplace(test_.build());
        const auto sizes = gpu::measureTextures(renderer().device(), *pack_,
                                                std::vector<bool>(pack_->images().size(), true), true);
        ASSERT_TRUE(sizes.ok());
        for (const std::vector<uint64_t>& image : *sizes)
            for (const uint64_t bytes : image)
                all_bytes_ += bytes;
        for (const PageRecord& page : pack_->pages())
            all_bytes_ += 2 * page.size;
    }

    void addQuad(uint32_t row, uint32_t column)
    {
        constexpr TexelFormat kFormats[] = {TexelFormat::bc7_srgb, TexelFormat::rgba8_srgb,
                                            TexelFormat::bc1_rgb_srgb, TexelFormat::etc2_rgb8_srgb,
                                            astcFormat(TexelFormat::astc_srgb, 9)};
        ImageRecord image{};
        // halved exactly down to the tail: else samplers choose other mips by the rounded size of an image
        // without its finest
        image.width = 128u << ((row + column) % 3);
        image.height = 128 * (1 + column);
        image.format = static_cast<uint32_t>(kFormats[row]);
        image.mip_count = static_cast<uint32_t>(std::bit_width(std::max(image.width, image.height)));
        std::vector<std::byte> mips(static_cast<size_t>(mipOffset(image, image.mip_count)));
        for (std::byte& byte : mips)
            byte = static_cast<std::byte>(random_() & 0xFFu);
        if (findTexelFormat(image.format)->family == TexelFamily::astc)
            for (size_t at = 0; at < mips.size(); at += 16)
                std::ranges::copy(makeAstcBlock(random_), mips.begin() + static_cast<ptrdiff_t>(at));
        MaterialRecord material = plainMaterial();
        material.flags = kMaterialUnlit | kMaterialDoubleSided;
        material.base_color = {1, 1, 1, 1};
        material.base_color_texture = makeTextureRef(test_.addImage(image, mips));
        const uint32_t mesh = test_.addMesh(withMaterial(makeQuad(2, 2), test_.addMaterial(material)));
        Affine3 place{};
        place.m[0][3] = 2.2f * static_cast<float>(column);
        place.m[1][3] = 2.2f * static_cast<float>(row);
        test_.addInstance(mesh, place);
    }

    pack::PageReader reader()
    {
        return [this](uint32_t page, std::span<std::byte> destination, pack::ReadDone done) {
            reads_.push_back({page, destination, done});
        };
    }

    void endReads()
    {
        std::shuffle(reads_.begin(), reads_.end(), random_);
        const size_t count = random_() % (reads_.size() + 1);
        for (size_t i = 0; i < count; ++i)
        {
            const Read& read = reads_[i];
            const bool fails = random_() % 64 < failures_of_64_;
            read.done(!fails && pack_->decodePage(read.page, read.destination).ok());
        }
        reads_.erase(reads_.begin(), reads_.begin() + static_cast<ptrdiff_t>(count));
    }

    void stream(uint64_t budget)
    {
        reads_.clear();
        streamed_ =
            upload(*pack_, {.frames_in_flight = 3, .memory_budget = budget, .stream = {.read = reader()}});
        serial_ = completed_ = 0;
    }

    Image frame(const shared::Camera& camera)
    {
        ++serial_;
        completed_ = std::max(completed_, serial_ - 1 - std::min<uint64_t>(random_() % 3, serial_ - 1));
        streamed_->stream->beginFrame(serial_, completed_);
        Image image = draw(*streamed_, camera, kOptions);
        endReads();
        const gpu::TextureStatistics statistics = streamed_->textures->statistics();
        EXPECT_LE(statistics.bytes_on_device, statistics.bytes_in_use);
        EXPECT_LE(statistics.bytes_in_use, statistics.budget_bytes);
        return image;
    }

    uint32_t settle(const shared::Camera& camera)
    {
        const uint64_t first = serial_ + 1;
        uint32_t frames = 0;
        for (; frames < 600 && streamed_->stream->settledSerial() < first; ++frames)
            frame(camera);
        return frames;
    }

    struct Read
    {
        uint32_t page;
        std::span<std::byte> destination;
        pack::ReadDone done;
    };

    inline static const DrawOptions kOptions{.width = 160, .height = 120};
    std::mt19937 random_{5};
    TestScene test_;
    std::optional<PackView> pack_;
    std::deque<Read> reads_;
    std::unique_ptr<gpu::Scene> streamed_;
    uint64_t all_bytes_ = 0, serial_ = 0, completed_ = 0;
    uint32_t failures_of_64_ = 0;
};

/// Cameras that see the whole wall, a part of it, and one quad, from near and aslant.
const shared::Camera kCameras[] = {
    {.position = {3.3f, 2.2f, 20}, .target = {3.3f, 2.2f, 0}},
    {.position = {1, 1, 2}, .target = {1, 1, 0}},
    {.position = {6.6f, 4, 0.6f}, .target = {6.4f, 4.2f, 0}},
    {.position = {-3, 2, 1}, .target = {3, 2.2f, 0}},
    {.position = {3.3f, 7.7f, 2}, .target = {3.3f, 7.7f, 0}},
};

TEST_F(TextureStreaming, endsAsIfAllMipsWereResident)
{
    const auto whole = upload(*pack_);
    stream(2 * all_bytes_);
    uint64_t streamed = 0;
    for (const shared::Camera& camera : kCameras)
    {
        EXPECT_LT(settle(camera), 600u);
        const gpu::TextureStatistics statistics = streamed_->textures->statistics();
        EXPECT_EQ(statistics.error_scale, 1);
        streamed = statistics.bytes_streamed;
        const Image image = frame(camera), expected = draw(*whole, camera, kOptions);
        EXPECT_EQ(image.visibility, expected.visibility);
        EXPECT_EQ(image.color, expected.color);
    }
    EXPECT_GT(streamed, all_bytes_ / 8) << "or nothing was streamed";
    EXPECT_LT(streamed, all_bytes_) << "the first views want few texels";
}

TEST_F(TextureStreaming, staysWithinAnyBudgetAndSettles)
{
    const auto whole = upload(*pack_);
    for (const uint64_t share : {3u, 16u})
    {
        stream(all_bytes_ / share);
        uint32_t different = 0;
        for (const shared::Camera& camera : kCameras)
        {
            EXPECT_LT(settle(camera), 600u);
            const Image settled = frame(camera);
            EXPECT_EQ(frame(camera).color, settled.color) << "it stays as it is";
            different += settled.color != draw(*whole, camera, kOptions).color ? 1u : 0u;
        }
        EXPECT_EQ(streamed_->textures->statistics().failures, 0u);
        if (share == 16)
        {
            EXPECT_GT(different, 0u) << "or the budget was never too small";
        }
    }
}

TEST_F(TextureStreaming, aMipThatCannotBeReadLeavesTheTextureBlurred)
{
    stream(2 * all_bytes_);
    failures_of_64_ = 40;
    settle(kCameras[1]);
    settle(kCameras[0]);
    EXPECT_GT(streamed_->textures->statistics().failures, 0u);
    failures_of_64_ = 0;
    streamed_->stream->retryFailed();
    for (int i = 0; i < 5; ++i)
        frame(kCameras[1]);
    EXPECT_LT(settle(kCameras[1]), 600u);
    EXPECT_EQ(frame(kCameras[1]).color, draw(*upload(*pack_), kCameras[1], kOptions).color);
}

} // namespace

} // namespace hearth::test
