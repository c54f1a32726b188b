// Updates an atlas of receivers: baked light under the weights that its lamps have in a frame.
// runtime/pack/receivers has the twin on the CPU, and the schedule of the updates.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/receivers.h"
#include "runtime/gpu/vulkan/pipelines.h"
#include "runtime/gpu/vulkan/uploader.h"

namespace hearth::gpu
{

/// Way to write texels: both give the same bytes.
enum class ReceiverUpdate : uint8_t
{
    compute, ///< a thread a texel
    points,  ///< a drawn point a texel, for devices with slow compute shaders
};

/// Atlas of a pack on the device. `arena` is the first member: buffers and images go before it.
struct ReceiverAtlas
{
    explicit ReceiverAtlas(const Device& device) : arena(device) {}

    MemoryArena arena;
    formats::ReceiverAtlasRecord record{};
    Buffer blocks, words;
    Buffer weights; ///< mapped: for each frame in flight, four floats for each lamp
    Image texels;   ///< R32_UINT words of E5B9G9R9, irradiance / scale; readable by shaders between updates
    UniqueImageView colors;        ///< of the texels as E5B9G9R9, for `sampler`
    UniqueSampler sampler;         ///< bilinear
    UniqueFramebuffer framebuffer; ///< of the texels, for ReceiverUpdate::points
    UniqueDescriptorPool pool;
    VkDescriptorSet set = VK_NULL_HANDLE;
};

class ReceiverPass
{
public:
    /// errors: device_failed.
    static Result<ReceiverPass> create(const Device& device, ReceiverUpdate update);

    /// Upload an atlas of a checked pack. All texels begin without light.
    /// frames  in flight, at least 1
    /// errors: device_limit (an atlas larger than what points can be drawn to), device_failed.
    Result<ReceiverAtlas> upload(const Device& device, const formats::ReceiverTables& tables, uint32_t frames,
                                 Uploader& uploader) const;

    /// Record the update of some groups; nothing if there is none. Outside a render pass. Clobbers the
    /// compute or the graphics state.
    /// frame    slot of the frame, below the number of frames in flight; no other one is written
    /// weights  [lamp_count]
    /// groups   by bits: of ReceiverSchedule::nextGroups()
    void record(const Device& device, VkCommandBuffer commands, const ReceiverAtlas& atlas, uint32_t frame,
                std::span<const Float3> weights, uint32_t groups) const;

private:
    Status createPoints(const Device& device, std::span<const NumberedSet> sets);
    Status createFramebuffer(const Device& device, ReceiverAtlas& atlas) const;
    void beginUpdate(const Device& device, VkCommandBuffer commands, const ReceiverAtlas& atlas) const;
    void recordBlocks(const Device& device, VkCommandBuffer commands, const ReceiverAtlas& atlas,
                      const shared::ReceiversPush& push, uint32_t count) const;

    ReceiverUpdate update_ = ReceiverUpdate::compute;
    UniqueRenderPass render_pass_; ///< of points
    ComputePipeline pipeline_;     ///< the layouts of either way
};

} // namespace hearth::gpu
