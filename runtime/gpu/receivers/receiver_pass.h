// Updates receivers, texels of an atlas and faces of bricks: baked light under the weights that its lamps
// have in a frame. runtime/pack/receivers has the twin on the CPU, and the schedule of the updates.
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

/// Tables of receivers on the device.
struct ReceiverBuffers
{
    formats::ReceiverAtlasRecord record{};
    Buffer blocks, words;
    Buffer weights; ///< mapped: for each frame in flight, four floats for each lamp
};

/// Atlas of a pack on the device. `arena` is the first member: buffers and images go before it.
struct ReceiverAtlas
{
    explicit ReceiverAtlas(const Device& device) : arena(device) {}

    MemoryArena arena;
    ReceiverBuffers buffers;
    Image texels; ///< R32_UINT words of E5B9G9R9, irradiance / scale; readable by shaders between updates
    UniqueImageView colors;        ///< of the texels as E5B9G9R9, for `sampler`
    UniqueSampler sampler;         ///< bilinear
    UniqueFramebuffer framebuffer; ///< of the texels, for ReceiverUpdate::points
    UniqueDescriptorPool pool;
    VkDescriptorSet set = VK_NULL_HANDLE;
};

/// Faces of bricks as receivers on the device. Their light is in a buffer of the bricks.
struct ReceiverFaces
{
    explicit ReceiverFaces(const Device& device) : arena(device) {}

    MemoryArena arena;
    ReceiverBuffers buffers;
    uint32_t first_word = 0; ///< of the light: that of the first face
    UniqueDescriptorPool pool;
    VkDescriptorSet set = VK_NULL_HANDLE;
};

class ReceiverPass
{
public:
    /// errors: device_failed.
    static Result<ReceiverPass> create(const Device& device, ReceiverUpdate update);

    /// Create the pipeline for faces, of which there is one way alone, unless it is there.
    /// errors: device_failed.
    Status prepareFaces(const Device& device);

    /// Upload an atlas of a checked pack. All texels begin without light.
    /// frames  in flight, at least 1
    /// errors: device_limit (an atlas larger than what points can be drawn to), device_failed.
    Result<ReceiverAtlas> upload(const Device& device, const formats::ReceiverTables& tables, uint32_t frames,
                                 Uploader& uploader) const;

    /// Upload the faces of a checked pack, after prepareFaces.
    /// light       buffer of the faces' light, which must outlive them
    /// first_word  of it: that of face 0
    /// errors: device_failed.
    Result<ReceiverFaces> upload(const Device& device, const formats::ReceiverTables& tables, uint32_t frames,
                                 const Buffer& light, uint32_t first_word, Uploader& uploader) const;

    /// Record the update of some groups; nothing if there is none. Outside a render pass. Clobbers the
    /// compute or the graphics state.
    /// frame    slot of the frame, below the number of frames in flight; no other one is written
    /// weights  [lamp_count]
    /// groups   by bits: of ReceiverSchedule::nextGroups()
    /// shows_drops  texels with shared::kReceiverDrops are red
    void record(const Device& device, VkCommandBuffer commands, const ReceiverAtlas& atlas, uint32_t frame,
                std::span<const Float3> weights, uint32_t groups, bool shows_drops = false) const;

    /// Record the update of faces likewise, which passes over bricks and then fragments may read.
    /// is_shown  fragments of earlier frames have read the light
    void record(const Device& device, VkCommandBuffer commands, const ReceiverFaces& faces, uint32_t frame,
                std::span<const Float3> weights, uint32_t groups, bool is_shown) const;

private:
    Status createPoints(const Device& device, std::span<const NumberedSet> sets);
    Status createFramebuffer(const Device& device, ReceiverAtlas& atlas) const;
    void beginUpdate(const Device& device, VkCommandBuffer commands, const ReceiverAtlas& atlas) const;
    void recordBlocks(const Device& device, VkCommandBuffer commands, const ReceiverAtlas& atlas,
                      const shared::ReceiversPush& push, uint32_t count) const;

    ReceiverUpdate update_ = ReceiverUpdate::compute;
    UniqueRenderPass render_pass_; ///< of points
    ComputePipeline pipeline_;     ///< the layouts of either way
    ComputePipeline faces_;        ///< of prepareFaces
};

} // namespace hearth::gpu
