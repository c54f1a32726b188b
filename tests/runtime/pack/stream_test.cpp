// Tests streamed scenes: every frame equals the image of an all-resident scene with the same cut, within the
// budget and for any order or failure of reads; and it converges to the all-resident image.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/cut.h"
#include "tests/reference/culling/cut_checker.h"
#include "tests/runtime/gpu/cull_twin.h"
#include "tests/support/gpu_fixture.h"
#include "tests/support/shapes.h"
#include "tests/support/test_scene.h"

#include <cmath>
#include <map>
#include <set>

namespace hearth::test
{

namespace
{

using namespace shared;

constexpr uint32_t kWithoutOcclusion = kCullInstances | kCullFrustum | kCullCone;

/// Reader whose reads complete when the test says so.
class FakeDisk
{
public:
    explicit FakeDisk(const formats::PackView& pack) : pack_(pack) {}

    uint32_t failures_of_64 = 0;  ///< failing reads
    std::set<uint32_t> bad_pages; ///< pages whose reads always fail
    uint32_t most_frames = 1;     ///< maximum duration of a read, >= 1

    pack::PageReader reader(std::mt19937& random)
    {
        return [this, &random](uint32_t page, std::span<std::byte> destination, pack::ReadDone done)
        {
            ++read_counts[page];
            reads_.push_back({page, destination, done, 1 + random() % most_frames});
        };
    }

    /// Complete the reads that are due, in any order.
    void frame(std::mt19937& random)
    {
        std::shuffle(reads_.begin(), reads_.end(), random);
        std::vector<Read> waiting;
        for (Read& read : reads_)
            if (read.frames > 1)
                waiting.push_back({read.page, read.destination, read.done, read.frames - 1});
            else
                end(read, random);
        reads_ = std::move(waiting);
    }

    /// Drop all reads in flight; none of them completes.
    void forget() { reads_.clear(); }

    std::map<uint32_t, uint32_t> read_counts;

private:
    struct Read
    {
        uint32_t page;
        std::span<std::byte> destination;
        pack::ReadDone done;
        uint64_t frames;
    };

    void end(const Read& read, std::mt19937& random) const
    {
        const bool ok = bad_pages.count(read.page) == 0 && random() % 64 >= failures_of_64;
        if (ok)
        {
            const Status decoded = pack_.decodePage(read.page, read.destination);
            HEARTH_ASSERT(decoded.ok());
        }
        else
            std::fill(read.destination.begin(), read.destination.end(), std::byte{0xA5});
        read.done(ok);
    }

    const formats::PackView& pack_;
    std::vector<Read> reads_;
};

/// Fill with rocks of many pages, one with authored LODs, and a two-sided terrain, at random places.
void fillScene(TestScene& scene, std::mt19937& random)
{
    formats::MaterialRecord two_sided = plainMaterial();
    two_sided.flags = formats::kMaterialDoubleSided;
    const uint32_t plain = scene.addMaterial(plainMaterial());
    const uint32_t sheet = scene.addMaterial(two_sided);
    const uint32_t meshes[] = {
        scene.addMesh(withMaterial(shapes::rock(72, 0.3f), plain)),
        scene.addMesh(withMaterial(shapes::terrain(96), sheet)),
        scene.addHierarchy(clusters::buildHierarchy(withMaterial(shapes::rock(60, 0.3f), plain),
                                                    std::vector{withMaterial(shapes::rock(36, 0.3f), plain),
                                                                withMaterial(shapes::rock(20, 0.28f), plain)},
                                                    {}))};
    scene.addInstance(meshes[0], Affine3{});
    for (size_t i = 1; i < 6; ++i)
        scene.addInstance(meshes[i % 3], randomAffine(random, 3));
}

Camera lookingAtOrigin(Float3 position)
{
    return {.position = position, .target = {0, 0, 0}, .y_fov_rad = 0.9f, .z_near = 0.05f};
}

uint64_t allBytes(const formats::PackView& pack)
{
    uint64_t bytes = 0;
    for (const formats::PageRecord& page : pack.pages())
        bytes += page.size;
    return bytes;
}

class StreamTest : public GpuTest
{
protected:
    void SetUp() override
    {
        GpuTest::SetUp();
        fillScene(test_, random_);
        pack_.emplace(test_.build());
        disk_.emplace(*pack_);
        whole_ = upload(*pack_);
        const auto layout = gpu::makeSceneLayout(*pack_);
        ASSERT_TRUE(layout.ok());
        layout_ = *layout;
    }

    void stream(uint64_t budget_bytes, uint32_t max_loads = 32)
    {
        disk_->forget(); // reads of another scene
        streamed_ = upload(*pack_, {.frames_in_flight = 3,
                                    .memory_budget = budget_bytes,
                                    .stream = {.read = disk_->reader(random_), .max_loads = max_loads}});
        EXPECT_LE(streamed_->buffers.pool.bytes(), budget_bytes);
    }

    /// Draw one frame; the stream is told that the last `late` frames are still running.
    Image frame(const Camera& camera, const DrawOptions& options, uint64_t late = 0)
    {
        ++serial_;
        completed_ = std::max(completed_, serial_ - 1 - std::min(late, serial_ - 1));
        streamed_->stream->beginFrame(serial_, completed_);
        const auto failed = streamed_->stream->failed();
        failed_.insert(failed_.end(), failed.begin(), failed.end());
        Image image = draw(*streamed_, camera, options);
        disk_->frame(random_);
        const pack::StreamStatistics& statistics = streamed_->stream->statistics();
        EXPECT_LE(statistics.bytes_in_use, statistics.budget_bytes);
        EXPECT_LE(statistics.bytes_resident, statistics.bytes_in_use);
        return image;
    }

    /// Draw frames until one has all that it requested; returns their number, or `most`.
    uint32_t settle(const Camera& camera, const DrawOptions& options, uint32_t most = 400)
    {
        const uint64_t first = serial_ + 1;
        uint32_t frames = 0;
        while (frames < most && streamed_->stream->settledSerial() < first)
        {
            frame(camera, options);
            ++frames;
        }
        return frames;
    }

    std::vector<uint8_t> residentGroups() const
    {
        std::vector<uint8_t> pages;
        for (uint32_t page = 0; page < pack_->pages().size(); ++page)
            pages.push_back(streamed_->stream->pages().residency().isResident(page) ? 1 : 0);
        return pack::residentGroups(*pack_, pages);
    }

    /// Draw the all-resident scene with tables that mark only these groups as resident.
    Image drawWhole(const std::vector<uint8_t>& resident_groups, const Camera& camera,
                    const DrawOptions& options)
    {
        std::vector<Group> groups(pack_->groups().size());
        std::memcpy(static_cast<void*>(groups.data()), pack_->groups().data(), pack_->groups().size_bytes());
        for (size_t group = 0; group < groups.size(); ++group)
            groups[group].absent = resident_groups[group] == 0 ? 1 : 0;
        const gpu::Device& device = renderer().device();
        const Status written = host().run(
            [&](VkCommandBuffer commands)
            {
                constexpr size_t kMaxGroups = 1024; // one command takes at most 64 KiB
                for (size_t first = 0; first < groups.size(); first += kMaxGroups)
                    device.vk.vkCmdUpdateBuffer(
                        commands, whole_->buffers.groups.handle.get(), first * sizeof(Group),
                        std::min(kMaxGroups, groups.size() - first) * sizeof(Group), &groups[first]);
                gpu::barrier(device, commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_ACCESS_TRANSFER_WRITE_BIT,
                             VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_ACCESS_SHADER_READ_BIT);
                return success();
            });
        HEARTH_ASSERT(written.ok());
        return draw(*whole_, camera, options);
    }

    DrawOptions scaled(DrawOptions options) const
    {
        const float scale = streamed_->stream->statistics().error_scale;
        if (scale > 1)
            options.error_pixels = std::max(options.error_pixels, kMinRequestThreshold) * scale;
        return options;
    }

    /// Expect that the frame equals the twin's and the all-resident scene's with the same cut, and is a whole
    /// surface.
    void expectWhole(const Image& image, const Camera& camera, const DrawOptions& options)
    {
        const std::vector<uint8_t> resident = residentGroups();
        FrameView view = makeView(*streamed_, camera, scaled(options));
        const Twin twin = makeTwin(*pack_, layout_, view, {}, {}, resident);
        ASSERT_EQ(image.list.slots.size(), twin.visible.size());
        EXPECT_EQ(std::memcmp(image.list.slots.data(), twin.visible.data(),
                              twin.visible.size() * sizeof(VisibleCluster)),
                  0);
        view.flags = 0;
        expectCovering(makeTwin(*pack_, layout_, view, {}, {}, resident));
        const Image whole = drawWhole(resident, camera, scaled(options));
        EXPECT_EQ(image.visibility, whole.visibility);
        EXPECT_EQ(image.color, whole.color);
    }

    /// Expect that all clusters of the twin, instance by instance, cover each surface once and are resident.
    void expectCovering(const Twin& twin) const
    {
        std::vector<std::vector<uint32_t>> cuts(pack_->instances().size());
        for (const VisibleCluster& slot : twin.visible)
        {
            cuts[slot.instance].push_back(slot.cluster);
            EXPECT_TRUE(
                streamed_->stream->pages().residency().isResident(pack_->clusters()[slot.cluster].page));
        }
        for (size_t i = 0; i < cuts.size(); ++i)
            EXPECT_TRUE(reference::checkCoverage(*pack_, pack_->instances()[i].mesh, cuts[i]).ok());
    }

    std::mt19937 random_{31};
    TestScene test_;
    std::optional<formats::PackView> pack_;
    std::optional<FakeDisk> disk_;
    gpu::SceneLayout layout_;
    std::unique_ptr<gpu::Scene> whole_, streamed_;
    uint64_t serial_ = 0, completed_ = 0;
    std::vector<uint32_t> failed_;
};

} // namespace

TEST_F(StreamTest, endsAsIfAllWereResident)
{
    stream(4 * allBytes(*pack_));
    disk_->most_frames = 4;
    const Camera camera = lookingAtOrigin({4, 2, 5});
    for (const float error_pixels : {8.0f, 0.5f, 0.0f})
    {
        const DrawOptions options{.width = 320, .height = 240, .error_pixels = error_pixels};
        EXPECT_LT(settle(camera, options), 60u);
        EXPECT_EQ(streamed_->stream->statistics().error_scale, 1);
        const Image streamed = frame(camera, options);
        const Image whole = draw(*whole_, camera, options);
        EXPECT_EQ(streamed.visibility, whole.visibility);
        EXPECT_EQ(streamed.color, whole.color);
        EXPECT_EQ(streamed.list.slots.size(), whole.list.slots.size());
    }
    EXPECT_GT(streamed_->stream->statistics().bytes_streamed, allBytes(*pack_) / 4);
}

TEST_F(StreamTest, everyFrameIsWholeWhateverReadsDo)
{
    uint32_t moved = 0, failures = 0;
    float most_scale = 1;
    for (int run = 0; run < 9; ++run)
    {
        disk_->failures_of_64 = run % 3 == 2 ? 8 : 0;
        disk_->most_frames = 1 + static_cast<uint32_t>(run % 4);
        const double share = 0.2 + 0.1 * (run % 10);
        stream(static_cast<uint64_t>(share * static_cast<double>(allBytes(*pack_))), 1 + random_() % 32);
        serial_ = completed_ = 0;
        failed_.clear();
        Camera camera = randomCamera(random_, 4);
        for (int i = 0; i < 24 && !HasFailure(); ++i)
        {
            if (i % 8 == 0)
                camera = randomCamera(random_, 4);
            camera.position.x += 0.05f;
            if (i == 16)
                streamed_->stream->retryFailed();
            const DrawOptions options{.width = 96,
                                      .height = 64,
                                      .error_pixels = i % 5 == 4 ? 0.0f : 1.0f,
                                      .flags = kWithoutOcclusion};
            const uint64_t late = random_() % 3;
            const Image image = frame(camera, options, late);
            expectWhole(image, camera, options);
            most_scale = std::max(most_scale, streamed_->stream->statistics().error_scale);
        }
        moved += streamed_->stream->statistics().bytes_streamed > 0 ? 1u : 0u;
        failures += static_cast<uint32_t>(failed_.size());
        EXPECT_EQ(failed_.size(), streamed_->stream->statistics().failures) << "each is reported once";
    }
    EXPECT_EQ(moved, 9u);
    EXPECT_GT(failures, 10u) << "or failures are not tested";
    EXPECT_GT(most_scale, 1.0f) << "or too small a budget is not tested";
}

TEST_F(StreamTest, occlusionCullingChangesNoImageOfAStreamedScene)
{
    stream(allBytes(*pack_) / 2);
    gpu::FrameTargets targets = makeTargets(160, 120);
    Camera camera = lookingAtOrigin({4, 2, 5});
    for (int i = 0; i < 20 && !HasFailure(); ++i)
    {
        camera.position.x -= 0.3f;
        streamed_->stream->beginFrame(serial_ + 1, serial_);
        ++serial_;
        const Image image = draw(*streamed_, targets, camera, {});
        disk_->frame(random_);
        const Image whole = drawWhole(residentGroups(), camera, scaled({.flags = 0}));
        EXPECT_EQ(image.seen(), whole.seen());
        EXPECT_EQ(image.color, whole.color);
    }
}

TEST_F(StreamTest, requestsEqualTheirTwinBitForBit)
{
    stream(allBytes(*pack_));
    uint32_t requested = 0, absent = 0, textured = 0;
    for (int i = 0; i < 40; ++i)
    {
        const Camera camera = randomCamera(random_, 4);
        const auto flags = static_cast<uint32_t>(i % 3 == 0 ? random_() & kCullEverything : kCullEverything);
        std::vector<LodKnot> curve;
        if (i % 4 == 1)
            curve = {{0.5f, 0.7f}, {4, 1.3f}, {8, 0.2f}};
        const DrawOptions options{.width = 64,
                                  .height = 48,
                                  .error_pixels = i % 6 == 0 ? 0.0f : std::exp2(uniform(random_, -2, 4)),
                                  .flags = flags,
                                  .lod_curve = curve};
        frame(camera, options);
        const auto requests = read<uint32_t>(streamed_->frame().page_requests,
                                             pack_->pages().size() + pack_->materials().size() + 1);
        const auto twin = makeRequestTwin(*pack_, layout_, makeView(*streamed_, camera, scaled(options)));
        EXPECT_EQ(requests, twin);
        for (size_t row = pack_->pages().size(); row < requests.size(); ++row)
            textured += requests[row] != 0 ? 1u : 0u;
        for (uint32_t page = 0; page < pack_->pages().size(); ++page)
        {
            requested += requests[page] != 0 ? 1u : 0u;
            absent +=
                requests[page] != 0 && !streamed_->stream->pages().residency().isResident(page) ? 1u : 0u;
        }
    }
    EXPECT_GT(requested, 200u);
    EXPECT_GT(absent, 20u);
    EXPECT_GT(textured, 20u);
}

TEST_F(StreamTest, aPageThatCannotBeReadLeavesACoarserImageAndOneReport)
{
    const Camera camera = lookingAtOrigin({3, 1, 3});
    const DrawOptions options{.width = 160, .height = 120, .error_pixels = 0.5f, .flags = kWithoutOcclusion};
    stream(4 * allBytes(*pack_));
    const auto bad = static_cast<uint32_t>(pack_->meshes()[0].pages.first + 3);
    disk_->bad_pages = {bad};
    EXPECT_LT(settle(camera, options), 40u) << "what cannot be had is not waited for";
    EXPECT_EQ(failed_, std::vector<uint32_t>{bad});
    EXPECT_EQ(disk_->read_counts[bad], 1u);
    const Image coarser = frame(camera, options);
    expectWhole(coarser, camera, options);
    std::vector<uint8_t> all(pack_->groups().size(), 1);
    EXPECT_NE(coarser.seen(), drawWhole(all, camera, options).seen());

    disk_->bad_pages.clear();
    streamed_->stream->retryFailed();
    frame(camera, options);
    EXPECT_LT(settle(camera, options), 40u);
    EXPECT_EQ(frame(camera, options).seen(), drawWhole(all, camera, options).seen());
    EXPECT_EQ(failed_.size(), 1u);
}

TEST_F(StreamTest, aBudgetBelowThePinnedPagesIsRefused)
{
    Status status = host().run(
        [&](VkCommandBuffer commands) -> Status
        {
            auto scene = renderer().upload(*pack_, commands,
                                           {.memory_budget = 16, .stream = {.read = disk_->reader(random_)}});
            EXPECT_FALSE(scene.ok());
            return scene.ok() ? success() : Status(scene.error());
        });
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().issue, Issue::streaming_budget);
}

} // namespace hearth::test
