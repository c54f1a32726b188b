// Compares the update of receivers by the first graphics device with its twin on the CPU, by bytes.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/gpu/receivers/receiver_pass.h"

#include "runtime/pack/receivers/receiver_light.h"
#include "runtime/viewer/vulkan_host.h"
#include "tests/cook/receivers/random_receivers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace hearth::test
{

namespace
{

std::vector<Float3> randomWeights(size_t lamps, uint32_t seed)
{
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0, 2);
    std::vector<Float3> weights(lamps, Float3{1, 1, 1});
    for (size_t lamp = 1; lamp < lamps; ++lamp)
        weights[lamp] = {unit(random), unit(random), unit(random) * 1e-3f};
    return weights;
}

class ReceiverPassTest : public testing::TestWithParam<gpu::ReceiverUpdate>
{
protected:
    void SetUp() override
    {
        auto host = viewer::VulkanHost::create({.device_name = "", .validate = true});
        ASSERT_TRUE(host.ok()) << formatMessage(host.error());
        host_ = std::move(*host);
        auto device = gpu::makeDevice(host_->description());
        ASSERT_TRUE(device.ok());
        device_ = std::move(*device);
    }
    void TearDown() override { EXPECT_TRUE(host_ == nullptr || host_->messages().empty()); }

    /// Return the words after updates, one frame each, with weights of their own.
    Result<std::vector<uint32_t>> update(const formats::ReceiverTables& tables,
                                         std::span<const std::vector<Float3>> weights,
                                         std::span<const uint32_t> groups, bool shows_drops = false)
    {
        HEARTH_ASSIGN_OR_RETURN(const gpu::ReceiverPass pass, gpu::ReceiverPass::create(device_, GetParam()));
        std::optional<gpu::ReceiverAtlas> scene;
        std::optional<gpu::Uploader> uploader;
        const auto frames = static_cast<uint32_t>(groups.size());
        HEARTH_TRY(host_->run(
            [&](VkCommandBuffer commands) -> Status
            {
                uploader.emplace(device_, commands);
                HEARTH_ASSIGN_OR_RETURN(scene, pass.upload(device_, tables, frames, *uploader));
                uploader->finish();
                for (uint32_t frame = 0; frame < frames; ++frame)
                    pass.record(device_, commands, *scene, frame, weights[frame], groups[frame], shows_drops);
                return success();
            }));
        HEARTH_ASSIGN_OR_RETURN(const std::vector<std::byte> bytes,
                                host_->readSampled(device_, scene->texels, sizeof(uint32_t)));
        std::vector<uint32_t> words(bytes.size() / sizeof(uint32_t));
        std::memcpy(words.data(), bytes.data(), bytes.size());
        return words;
    }

    std::unique_ptr<viewer::VulkanHost> host_;
    gpu::Device device_;
};

TEST_P(ReceiverPassTest, givesTheBytesOfTheCpu)
{
    const RandomReceivers random(150, 90, 13, 6);
    for (const auto codec : {formats::ReceiverCodec::rgb9e5, formats::ReceiverCodec::rgbm})
    {
        receivers::AtlasOptions options;
        options.codec = codec;
        const receivers::Atlas atlas = receivers::packAtlas(random.baked(), options);
        const std::vector<Float3> weights[] = {randomWeights(13, 1), randomWeights(13, 2),
                                               randomWeights(13, 3)};
        const uint32_t groups[] = {15, 9, 2}; // texels of group 2 keep the first weights
        std::vector<uint32_t> texels(size_t{150} * 90);
        for (size_t frame = 0; frame < 3; ++frame)
            pack::updateReceivers(atlas.tables(), weights[frame], groups[frame], texels);
        const auto words = update(atlas.tables(), weights, groups);
        ASSERT_TRUE(words.ok()) << formatMessage(words.error());
        EXPECT_EQ(*words, texels);
    }
}

TEST_P(ReceiverPassTest, showsTexelsThatDropLamps)
{
    const RandomReceivers random(64, 48, 9, 8);
    receivers::AtlasOptions options;
    options.select.max_colors = 3;
    const receivers::Atlas atlas = receivers::packAtlas(random.baked(), options);
    const std::vector<Float3> weights[] = {randomWeights(9, 1)};
    const uint32_t groups[] = {15};
    std::vector<uint32_t> expected(size_t{64} * 48);
    pack::updateReceivers(atlas.tables(), weights[0], 15, expected);
    size_t dropping = 0;
    for (const formats::ReceiverBlockRecord& block : atlas.blocks)
        for (uint32_t i = 0; i < block.texel_count; ++i)
            if (const uint32_t place = atlas.words[block.first_word + i]; (place >> 28 & 1) != 0)
            {
                uint32_t& word = expected[(place >> 14 & 16383) * size_t{64} + (place & 16383)];
                const Float3 light = shared::decodeSharedExponentWord(word);
                word = shared::encodeSharedExponentWord({std::max({light.x, light.y, light.z}), 0, 0});
                ++dropping;
            }
    EXPECT_GT(dropping, 500u);
    EXPECT_LT(dropping, expected.size());
    const auto words = update(atlas.tables(), weights, groups, true);
    ASSERT_TRUE(words.ok()) << formatMessage(words.error());
    EXPECT_EQ(*words, expected);
}

TEST_P(ReceiverPassTest, recordsNothingForNoGroup)
{
    const RandomReceivers random(16, 16, 4, 7);
    const receivers::Atlas atlas = receivers::packAtlas(random.baked(), {});
    const std::vector<Float3> weights[] = {randomWeights(4, 1)};
    const uint32_t groups[] = {0};
    const auto words = update(atlas.tables(), weights, groups);
    ASSERT_TRUE(words.ok()) << formatMessage(words.error());
    EXPECT_EQ(*words, std::vector<uint32_t>(256));
}

INSTANTIATE_TEST_SUITE_P(Ways, ReceiverPassTest,
                         testing::Values(gpu::ReceiverUpdate::compute, gpu::ReceiverUpdate::points),
                         [](const auto& way)
                         { return way.param == gpu::ReceiverUpdate::compute ? "compute" : "points"; });

} // namespace

} // namespace hearth::test
