// Updates an atlas of receivers: baked light under the weights that its lamps have in a frame.
// runtime/pack/receivers has the twin on the CPU, and the schedule of the updates.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/records/receivers.h"
#include "runtime/gpu/vulkan/pipelines.h"
#include "runtime/gpu/vulkan/uploader.h"

namespace hearth::gpu
{

/// Atlas of a pack on the device. `arena` is the first member: buffers and images go before it.
struct ReceiverAtlas
{
    explicit ReceiverAtlas(const Device& device) : arena(device) {}

    MemoryArena arena;
    formats::ReceiverAtlasRecord record{};
    Buffer blocks, words;
    Buffer weights; ///< mapped: for each frame in flight, four floats for each lamp
    Image texels;   ///< R32_UINT words of E5B9G9R9, irradiance / scale; readable by shaders between updates
    UniqueImageView colors; ///< of the texels as E5B9G9R9, for `sampler`
    UniqueSampler sampler;  ///< bilinear
    UniqueDescriptorPool pool;
    VkDescriptorSet set = VK_NULL_HANDLE;
};

class ReceiverPass
{
public:
    /// errors: device_failed.
    static Result<ReceiverPass> create(const Device& device);

    /// Upload an atlas of a checked pack. All texels begin without light.
    /// frames  in flight, at least 1
    /// errors: device_failed.
    Result<ReceiverAtlas> upload(const Device& device, const formats::ReceiverTables& tables, uint32_t frames,
                                 Uploader& uploader) const;

    /// Record the update of some groups; nothing if there is none. Outside a render pass. Clobbers the
    /// compute state.
    /// frame    slot of the frame, below the number of frames in flight; no other one is written
    /// weights  [lamp_count]
    /// groups   by bits: of ReceiverSchedule::nextGroups()
    void record(const Device& device, VkCommandBuffer commands, const ReceiverAtlas& atlas, uint32_t frame,
                std::span<const Float3> weights, uint32_t groups) const;

private:
    ComputePipeline pipeline_;
};

} // namespace hearth::gpu
