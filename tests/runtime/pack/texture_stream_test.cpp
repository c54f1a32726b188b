// Tests the streaming of mips with a simulated device: images hold the texels of the pack, and their bytes
// never exceed the budget, whatever reads and frames do.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/texture_stream.h"
#include "tests/support/sanitized.h"
#include "tests/support/small_pack.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <gtest/gtest.h>
#include <map>
#include <random>

namespace hearth::test
{

namespace
{

using namespace formats;
using pack::TextureMip;

/// Image on the simulated device: its texels, from a mip of the pack's image on.
struct DeviceImage
{
    uint32_t first_mip = 0;
    std::vector<std::byte> texels;
    std::vector<bool> is_filled; ///< by byte
};

PackModel makePack(std::mt19937& random, uint32_t image_count)
{
    PackModel model = smallPack();
    model.materials.clear();
    model.material_layers.clear();
    model.images.clear();
    model.image_data.clear();
    constexpr TexelFormat kFormats[] = {TexelFormat::rgba8_unorm, TexelFormat::astc_unorm,
                                        TexelFormat::bc1_rgb_unorm, TexelFormat::eac_r11_unorm,
                                        TexelFormat::r8_unorm};
    for (uint32_t i = 0; i < image_count; ++i)
    {
        ImageRecord image{};
        image.width = static_cast<uint32_t>(1 + random() % 600);
        image.height = static_cast<uint32_t>(1 + random() % 300);
        image.format = static_cast<uint32_t>(kFormats[random() % std::size(kFormats)]);
        image.mip_count = static_cast<uint32_t>(std::bit_width(std::max(image.width, image.height)));
        std::vector<std::byte>& texels =
            model.image_data.emplace_back(static_cast<size_t>(mipOffset(image, image.mip_count)));
        for (std::byte& byte : texels)
            byte = static_cast<std::byte>(random() % 7);
        model.images.push_back(image);
    }
    model.sealImages();
    return model;
}

/// Return the view of a pack in memory, which outlives it.
PackView readView(const AlignedBytes& bytes)
{
    return PackView::read(ContainerReader::fromBytes(bytes.span(), "t", Check::everything).value()).value();
}

/// Bytes that the simulated device needs: more than the texels have, and not in proportion.
uint64_t deviceBytes(const ImageRecord& image, uint32_t first_mip)
{
    const uint64_t bytes = mipOffset(image, image.mip_count) - mipOffset(image, first_mip);
    return (bytes + 4095) / 4096 * 4096;
}

/// Device, reader and frames of one history.
class Machine
{
public:
    Machine(const PackView& view, std::mt19937& random, double budget_share, uint32_t max_loads)
        : view_(view), random_(random), staging_(size_t{2} * max_loads * kMaxPieceBytes)
    {
        std::vector<std::vector<uint64_t>> sizes;
        uint64_t all = 0, pinned = 0;
        for (const ImageRecord& image : view.images())
        {
            std::vector<uint64_t>& own = sizes.emplace_back();
            if (firstTailMip(image) == 0)
                continue;
            for (uint32_t mip = 0; mip <= firstTailMip(image); ++mip)
                own.push_back(deviceBytes(image, mip));
            for (const uint64_t bytes : own)
                all += bytes;
            pinned += own.back();
        }
        budget_ = pinned + static_cast<uint64_t>(budget_share * static_cast<double>(all - pinned));
        auto stream = pack::TextureStream::create(
            view, pack::TextureGraph(sizes),
            {.budget_bytes = budget_,
             .max_loads = max_loads,
             .slot_bytes = kMaxPieceBytes,
             .read =
                 [this](uint32_t page, std::span<std::byte> destination, pack::ReadDone done) {
                     reads_.push_back(
                         {page, destination, done, static_cast<uint32_t>(1 + random_() % most_frames)});
                 }},
            staging_);
        HEARTH_ASSERT(stream.ok());
        stream_.emplace(std::move(*stream));
        for (uint32_t i = 0; i < view.images().size(); ++i)
            if (!sizes[i].empty())
                current_[i] = filledImage(i, static_cast<uint32_t>(sizes[i].size()) - 1);
    }

    /// Run a frame in which each image is wanted at so many pixels a UV unit (log2; negative: not at all).
    void frame(const std::vector<float>& pixels_log2)
    {
        const uint64_t late = random_() % 3;
        ++serial_;
        completed_ = std::max(completed_, serial_ - 1 - std::min(late, serial_ - 1));
        std::erase_if(retired_, [&](const auto& retired) { return retired.second <= completed_; });
        endReads();
        const pack::TextureChanges changes = stream_->beginFrame(serial_, completed_);
        for (const TextureMip& mip : changes.failed)
        {
            incoming_.erase(mip.image);
            ++failures;
        }
        apply(changes);
        for (uint32_t i = 0; i < pixels_log2.size(); ++i)
            if (pixels_log2[i] >= 0 && current_.contains(i))
                stream_->request(makeUse(i), pixels_log2[i]);
        stream_->schedule(serial_);
        check();
    }

    pack::TextureUse makeUse(uint32_t image) const
    {
        TextureRef texture{};
        texture.image = image;
        texture.uv_transform[0] = texture.uv_transform[4] = 1;
        return pack::makeTextureUse(view_, texture);
    }

    const pack::TextureStream& stream() const { return *stream_; }
    void retryFailed() { stream_->retryFailed(); }
    uint64_t serial() const { return serial_; }

    uint32_t most_frames = 3;
    uint32_t failures_of_64 = 0;
    uint32_t failures = 0, evictions = 0, publications = 0;

private:
    struct Read
    {
        uint32_t page;
        std::span<std::byte> destination;
        pack::ReadDone done;
        uint32_t frames;
    };

    DeviceImage filledImage(uint32_t image, uint32_t first_mip) const
    {
        const std::vector<std::byte> all = texelsFrom(image, first_mip);
        return {first_mip, all, std::vector<bool>(all.size(), true)};
    }

    std::vector<std::byte> texelsFrom(uint32_t image, uint32_t first_mip) const
    {
        const ChunkData data = view_.imageData(image).value();
        const auto first = static_cast<size_t>(mipOffset(view_.images()[image], first_mip));
        return {data.bytes().begin() + static_cast<ptrdiff_t>(first), data.bytes().end()};
    }

    void endReads()
    {
        for (size_t i = 0; i < reads_.size();)
        {
            Read read = reads_[i];
            if (--reads_[i].frames > 0)
            {
                ++i;
                continue;
            }
            reads_.erase(reads_.begin() + static_cast<ptrdiff_t>(i));
            const bool fails = random_() % 64 < failures_of_64;
            read.done(!fails && view_.decodePage(read.page, read.destination).ok());
        }
    }

    void apply(const pack::TextureChanges& changes)
    {
        for (const TextureMip& mip : changes.evicted)
        {
            ++evictions;
            DeviceImage& old = current_.at(mip.image);
            ASSERT_EQ(old.first_mip, mip.mip) << "finer mips go first";
            DeviceImage smaller = emptyImage(mip.image, mip.mip + 1);
            copy(old, smaller);
            // an image that frames in flight still read is taken again
            std::erase_if(retired_,
                          [&](const auto& retired) {
                              return retired.first == TextureMip{mip.image, mip.mip + 1};
                          });
            retire(mip.image, std::move(smaller));
        }
        for (const pack::PieceUpload& upload : changes.uploads)
        {
            auto [place, is_new] =
                incoming_.try_emplace(upload.mip.image, emptyImage(upload.mip.image, upload.mip.mip));
            ASSERT_EQ(place->second.first_mip, upload.mip.mip);
            const TexturePiece piece = listTexturePieces(view_.images()[upload.mip.image])[upload.piece];
            const size_t to = static_cast<size_t>(
                piece.offset - mipOffset(view_.images()[upload.mip.image], upload.mip.mip));
            const auto from =
                std::span(staging_).subspan(size_t{upload.staging_slot} * kMaxPieceBytes, piece.size);
            std::ranges::copy(from, place->second.texels.begin() + static_cast<ptrdiff_t>(to));
            std::fill_n(place->second.is_filled.begin() + static_cast<ptrdiff_t>(to), piece.size, true);
        }
        for (const TextureMip& mip : changes.published)
        {
            ++publications;
            DeviceImage fresh = std::move(incoming_.at(mip.image));
            incoming_.erase(mip.image);
            ASSERT_EQ(fresh.first_mip + 1, current_.at(mip.image).first_mip) << "coarser mips come first";
            copy(current_.at(mip.image), fresh);
            retire(mip.image, std::move(fresh));
        }
    }

    DeviceImage emptyImage(uint32_t image, uint32_t first_mip) const
    {
        const size_t size = texelsFrom(image, first_mip).size();
        return {first_mip, std::vector<std::byte>(size), std::vector<bool>(size, false)};
    }

    /// Copy the mips that both have: the last bytes.
    static void copy(const DeviceImage& from, DeviceImage& to)
    {
        const size_t size = std::min(from.texels.size(), to.texels.size());
        std::copy(from.texels.end() - static_cast<ptrdiff_t>(size), from.texels.end(),
                  to.texels.end() - static_cast<ptrdiff_t>(size));
        std::fill(to.is_filled.end() - static_cast<ptrdiff_t>(size), to.is_filled.end(), true);
    }

    void retire(uint32_t image, DeviceImage fresh)
    {
        retired_.push_back({{image, current_.at(image).first_mip}, serial_});
        current_.at(image) = std::move(fresh);
    }

    void check() const
    {
        uint64_t bytes = 0;
        for (const auto& [image, held] : current_)
        {
            bytes += deviceBytes(view_.images()[image], held.first_mip);
            EXPECT_EQ(held.first_mip, stream_->residentMip(image));
            EXPECT_TRUE(std::ranges::all_of(held.is_filled, std::identity{}));
            EXPECT_TRUE(held.texels == texelsFrom(image, held.first_mip));
        }
        for (const auto& [image, held] : incoming_)
            bytes += deviceBytes(view_.images()[image], held.first_mip);
        for (const auto& [mip, serial] : retired_)
            bytes += deviceBytes(view_.images()[mip.image], mip.mip);
        EXPECT_LE(bytes, stream_->residency().bytesInUse());
        EXPECT_LE(stream_->residency().bytesInUse(), budget_);
    }

    const PackView& view_;
    std::mt19937& random_;
    std::vector<std::byte> staging_;
    uint64_t budget_ = 0;
    std::optional<pack::TextureStream> stream_;
    std::map<uint32_t, DeviceImage> current_, incoming_;
    std::vector<std::pair<TextureMip, uint64_t>> retired_; ///< with the last frame that reads it
    std::vector<Read> reads_;
    uint64_t serial_ = 0, completed_ = 0;
};

/// Finest mip that a view wants: the texels of the next coarser would cover more than a pixel.
uint32_t wantedMip(const Machine& machine, uint32_t image, float pixels_log2)
{
    uint32_t mip = machine.stream().graph().mipCount(image) - 1;
    while (mip > 0 && pixels_log2 > machine.makeUse(image).texels_log2 - static_cast<float>(mip))
        --mip;
    return mip;
}

std::vector<float> randomRequests(const PackView& view, std::mt19937& random)
{
    std::vector<float> pixels;
    for (size_t i = 0; i < view.images().size(); ++i)
        pixels.push_back(random() % 3 == 0 ? -1.0f : static_cast<float>(random() % 120) / 10);
    return pixels;
}

TEST(TextureStream, imagesAreThePacksWhateverHappens)
{
    constexpr uint32_t kHistories = kSanitized ? 12 : 60;
    uint32_t failures = 0, evictions = 0, publications = 0;
    for (uint32_t seed = 0; seed < kHistories; ++seed)
    {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const PackModel model = makePack(random, 1 + random() % 8);
        const AlignedBytes bytes = model.bytes();
        const PackView view = readView(bytes);
        Machine machine(view, random, static_cast<double>(random() % 12) / 10, 1 + random() % 8);
        machine.failures_of_64 = seed % 3 == 0 ? 6 : 0;
        std::vector<float> requests = randomRequests(view, random);
        for (int i = 0; i < 60 && !testing::Test::HasFailure(); ++i)
        {
            if (random() % 12 == 0)
                requests = randomRequests(view, random);
            if (random() % 20 == 0)
                machine.retryFailed();
            machine.frame(requests);
        }
        failures += machine.failures;
        evictions += machine.evictions;
        publications += machine.publications;
    }
    EXPECT_GE(failures, kHistories / 4) << "or failures are not tested";
    EXPECT_GT(evictions, kHistories) << "or evictions are not tested";
    EXPECT_GT(publications, 4 * kHistories);
}

TEST(TextureStream, settlesWithWhatIsWanted)
{
    for (uint32_t seed = 0; seed < trials(30); ++seed)
    {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const PackModel model = makePack(random, 1 + random() % 8);
        const AlignedBytes bytes = model.bytes();
        const PackView view = readView(bytes);
        Machine machine(view, random, 1, 4);
        for (int turn = 0; turn < 3; ++turn)
        {
            const std::vector<float> requests = randomRequests(view, random);
            const uint64_t first = machine.serial() + 1;
            for (int i = 0; i < 400 && machine.stream().settledSerial() < first; ++i)
                machine.frame(requests);
            ASSERT_GE(machine.stream().settledSerial(), first);
            for (uint32_t image = 0; image < requests.size(); ++image)
            {
                if (requests[image] < 0 || machine.stream().graph().mipCount(image) == 0)
                    continue;
                EXPECT_LE(machine.stream().residentMip(image), wantedMip(machine, image, requests[image]));
            }
        }
        EXPECT_EQ(machine.evictions, 0u) << "all fits";
    }
}

PackModel makeSquares(std::initializer_list<uint32_t> sides)
{
    PackModel model = smallPack();
    model.materials.clear();
    model.material_layers.clear();
    model.images.clear();
    model.image_data.clear();
    for (const uint32_t side : sides)
    {
        ImageRecord image{};
        image.width = image.height = side;
        image.format = static_cast<uint32_t>(TexelFormat::rgba8_unorm);
        image.mip_count = static_cast<uint32_t>(std::bit_width(side));
        model.image_data.emplace_back(static_cast<size_t>(mipOffset(image, image.mip_count)));
        model.images.push_back(image);
    }
    model.sealImages();
    return model;
}

TEST(TextureStream, anImageThatCannotFitBlursNoOther)
{
    const PackModel model = makeSquares({512, 128});
    const AlignedBytes bytes = model.bytes();
    const PackView view = readView(bytes);
    std::mt19937 random(1);
    Machine machine(view, random, 0.7, 4);
    for (int i = 0; i < 80; ++i)
        machine.frame({20, 20}); // a million pixels a UV unit
    EXPECT_EQ(machine.stream().errorScale(), 1);
    EXPECT_EQ(machine.stream().residentMip(0), 1u);
    EXPECT_EQ(machine.stream().residentMip(1), 0u);
}

/// The budget holds one of the two large images in full, and the small one.
TEST(TextureStream, aMipWithoutRoomLeavesOutNoMipOfOtherImages)
{
    const PackModel model = makeSquares({256, 256, 128});
    const AlignedBytes bytes = model.bytes();
    const PackView view = readView(bytes);
    std::mt19937 random(1);
    Machine machine(view, random, 0.68, 4);
    for (int i = 0; i < 120; ++i)
        machine.frame({7.75f, 7.5f, 6.25f}); // each wants its finest mip
    EXPECT_EQ(machine.stream().residentMip(0), 0u);
    EXPECT_EQ(machine.stream().residentMip(1), 1u);
    EXPECT_EQ(machine.stream().residentMip(2), 0u);
    EXPECT_FLOAT_EQ(machine.stream().errorScale(), std::exp2(0.5f)) << "pixels a texel of the second";
    EXPECT_GE(machine.stream().settledSerial(), machine.serial() - 1);
    const uint32_t evictions = machine.evictions;
    for (int i = 0; i < 40; ++i)
        machine.frame({7.5f, 7.75f, 6.25f});
    EXPECT_EQ(machine.stream().residentMip(0), 0u) << "little more is no reason to replace it";
    EXPECT_EQ(machine.evictions, evictions);
}

TEST(TextureStream, aCutToAnotherViewIsSharpWhateverWasSeenBefore)
{
    const PackModel model = makeSquares({256, 256, 256, 256});
    const AlignedBytes bytes = model.bytes();
    const PackView view = readView(bytes);
    std::mt19937 random(2);
    Machine machine(view, random, 0.35, 4);
    for (const int frames : {3, 9, 17, 40})
    {
        for (int i = 0; i < frames; ++i)
            machine.frame({8, 8, 8, 8});
        EXPECT_GT(machine.stream().errorScale(), 1);
        const uint64_t first = machine.serial() + 1;
        for (int i = 0; i < 200 && machine.stream().settledSerial() < first; ++i)
            machine.frame({8, -1, -1, -1});
        EXPECT_EQ(machine.stream().errorScale(), 1) << frames;
        EXPECT_EQ(machine.stream().residentMip(0), 0u) << frames;
    }
}

TEST(TextureStream, aUseCountsTheAxisWithFewerTexels)
{
    PackModel model = smallPack();
    model.images[0].width = 512;
    model.images[0].height = 128;
    model.image_data[0].assign(static_cast<size_t>(mipOffset(model.images[0], model.images[0].mip_count)),
                               std::byte{1});
    const AlignedBytes bytes = model.bytes();
    const PackView view = readView(bytes);
    const auto texels = [&](std::array<float, 6> m)
    {
        TextureRef texture{};
        std::ranges::copy(m, texture.uv_transform);
        return pack::makeTextureUse(view, texture).texels_log2;
    };
    EXPECT_FLOAT_EQ(texels({1, 0, 0, 0, 1, 0}), 7);
    EXPECT_FLOAT_EQ(texels({2, 0, 5, 0, 4, 1}), 8);
    EXPECT_NEAR(texels({std::sqrt(8.0f), -std::sqrt(8.0f), 0, std::sqrt(8.0f), std::sqrt(8.0f), 0}), 9, 1e-5)
        << "a turn";
    EXPECT_FLOAT_EQ(texels({64, 0, 0, 0, 1, 0}), 10) << "an eighth of the other axis";
}

} // namespace

} // namespace hearth::test
